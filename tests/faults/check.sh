# check.sh -- what `fmdsub check` says of loops and mass, in words and as an object: the same figures.
. tests/tools/lib.sh

fact() { # KEY, the last one of that name in the object
    sed -n 's/^.*"'"$1"'":[[:space:]]*\([^,]*\),*$/\1/p' "$work/object" | tail -n 1
}

"$FMDSUB" check decks/bricard.yaml >"$work/words" 2>"$work/err"
expect "check: words" 0 $? "$work/err"
"$FMDSUB" check -f json decks/bricard.yaml >"$work/object" 2>"$work/err"
expect "check: object" 0 $? "$work/err"
expect "check: equations and rank of Bricard's loop" "5 4" \
    "$(sed -n 's/^loops: .* \([0-9]*\) equations, rank \([0-9]*\)$/\1 \2/p' "$work/words")" "$work/words"
expect "check: the same in the object" "5 4" "$(sed -n '/"components"/,$p' "$work/object" |
    sed -n 's/^.*"equations":[[:space:]]*\([0-9]*\),$/\1/p') $(fact rank)" "$work/object"
expect "check: joints whose reactions are not unique" "pin1 pin2 pin3 pin5 pin6" \
    "$(sed -n 's/^ *\(pin[0-9]\) .*of the tree; reactions not unique$/\1/p' "$work/words" | sort | tr '\n' ' ' | sed 's/ $//')"
expect "check: mass" "5 kg, centre at (0.6, -0.6, 0.5) m" "$(sed -n 's/^mass: //p' "$work/words")"
expect "check: centre in the object" "[0.6, -0.6, 0.5]" "$(sed -n 's/^.*"centre":[[:space:]]*\(\[.*\]\),$/\1/p' "$work/object" | sed 's/0000000000*1//g')"

# A wish alone is the same as in a map.
sed 's/^initial:.*/initial: static/' decks/cantilever.yaml >"$work/alone.yaml"
for deck in decks/cantilever.yaml "$work/alone.yaml"; do
    "$FMDSUB" run -q --until 0.01 "$deck" >"$work/$(basename "$deck" .yaml).csv" 2>"$work/err"
done
same "initial: static, alone and in a map" "$work/cantilever.csv" "$work/alone.csv"
