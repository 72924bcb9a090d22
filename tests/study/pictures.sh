# pictures.sh -- the picture of a study: each scheme, order and ratio by its name, the deck's own setting, rows that have no place.
. tests/tools/lib.sh
cd "$work" || exit 1
cp "$ROOT"/decks/*.yaml .

# A line for each setting that rows have in common, with its order and ratio; the deck's own beside them, as its row is.
"$FMDSUB" study -q --repeats 0 --until 0.1 --plot x.svg --script -o rows.csv bar-slider.yaml >script 2>err
ended "a picture of two rates: status" 0 $? script err
awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
    $at["status"] == "ok" && $at["error"] > 0 { print $1 ($at["order"] > 2 ? ", order " $at["order"] "," : "") ($at["ratio"] > 1 ? " " $at["ratio"] ":1" : "") }' rows.csv | sort -u >names
sed -n "s/.*lc rgb '#[0-9a-f]*' title '\(.*\)'.*/\1/p" script | sed 's/  x [0-9.e+]* a digit//; /^the deck/d' | sort >titles
same "its lines have the names of the rows" names titles
expect "of order 4, of two rates, of one" "yes yes yes" "$(for name in 'subcycle, order 4, 5:1' 'daniel 5:1' rk4; do grep -qx "$name" titles && echo yes; done | tr '\n' ' ' | sed 's/ $//')" titles
expect "more lines than colours are dashed" "1 2 8" "$(sed -n 's/.* dt \([12]\) lc.*/\1/p' script | uniq -c | awk '{ kinds = kinds $2 " "; if (NR == 1) first = $1 } END { print kinds first }')" script
expect "the deck's own setting is marked" "wrote $(awk -F, '$1 == "subcycle" && $3 == 0.001 && $4 == 5 && $19 == "" { print $9, $5 }' rows.csv | head -n 1)" \
    "$(wrote script) $(awk '/^.own << END/ { getline; print $1, $3 }' script)" script

# With times a second panel, of seconds; without -o rows are not there.
"$FMDSUB" study -q --repeats 1 --until 0.1 --schemes rk4,midpoint --tolerances 1e-3,1e-4 --plot x.svg --script pendulum.yaml >script 2>err
expect "a picture with times: status, panels" "0 2 1" "$? $(grep -c '^plot ' script) $(grep -c "^set xlabel 'CPU time" script)" script err

# No run has an error: a picture of nothing is one all the same, and the status tells.
"$FMDSUB" study -q --repeats 0 --schemes rk4 --steps 0.5 --until 10 --set output.every=1 --plot x.svg --script stiff-leaf-chain.yaml >script 2>err
expect "a picture without rows: status, words, lines" "5 1 1 0" "$? $(grep -c 'no setting ran to its end' err) $(grep -c '^.line0 << END' script) $(grep -c '^set yrange' script)" script err

# The deck's own setting stops on the way: it is said, and has no mark.
"$FMDSUB" study --repeats 0 --budget 0.5 --until 10 -s integrate.scheme=rk4 -s integrate.ratio=1 -s integrate.step=0.5 -s output.every=1 \
    --plot x.svg --script -o rows.csv stiff-leaf-chain.yaml >script 2>err
expect "the deck's own setting stops: status, words, mark" "0 1 0" "$? $(grep -c "^the deck's own setting, rk4 at step 0.5 s, stops on the way" err) $(grep -c '^.own << END' script)" err script
