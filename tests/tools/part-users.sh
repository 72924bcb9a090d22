# part-users.sh -- scenes as users bring them (tests/decks-by-users): each is accepted, runs, and gives the numbers that its
# comment finds by hand.
#
# A figure is a line `#= t column by-hand limit`.  A line `#known: DEFECT what` says that the deck fails for a defect that is
# known: one that fails is counted as known, one that does not has to lose the line.  `#told: CODE` is a warning that its
# check and its run are to give, and no other words.
. tests/tools/lib.sh
need_program users

for deck in tests/decks-by-users/*.yaml; do
    name=${deck##*/}
    name=${name%.yaml}
    {
        timeout "${CHECK_SECONDS:-60}" "$FMDSUB" check "$deck" >"$work/checked" || echo "check ends with status $?"
        timeout 60 "$FMDSUB" run -q "$deck" >"$work/run.csv" || echo "run ends with status $?"
    } >"$work/said" 2>&1 </dev/null
    told=$(sed -n 's/^#told: //p' "$deck")
    [ -z "$told" ] || { awk -v told="[$told]" 'index($0, told) { n++; quote = 1; next } quote && /^ / { next } { quote = 0; print }
        END { if (n != 2) print n + 0 " times told " told }' "$work/said" >"$work/left" && mv "$work/left" "$work/said"; }
    [ -s "$work/run.csv" ] || echo t >"$work/run.csv"
    awk -f tests/tools/figures.awk "$deck" "$work/run.csv" >"$work/figures"
    grep 'beyond$' "$work/figures" >>"$work/said"

    defect=$(sed -n 's/^#known: //p' "$deck")
    if [ ! -s "$work/said" ] && [ -z "$defect" ]; then ok "$name: $(wc -l <"$work/figures") figures"
    elif [ ! -s "$work/said" ]; then not_ok "$name" "passes now: take '#known: $defect' out of $deck"
    elif [ -n "$defect" ]; then known "$name" "$defect"
    else not_ok "$name" "not as by hand, or with words" "$work/said"; fi
done
