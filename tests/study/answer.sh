# answer.sh -- the answer in sentences and as lines of a deck (--pick).
. tests/tools/lib.sh

# The answer in sentences, the cheapest setting as lines of a deck that meet the error, and the same counts twice.
"$FMDSUB" study --repeats 1 --until 1 decks/double-pendulum.yaml >"$work/one.csv" 2>"$work/answer"
"$FMDSUB" study -q --repeats 1 --until 1 decks/double-pendulum.yaml >"$work/two.csv" 2>"$work/err"
for level in 1e-02 1e-04 1e-06; do
    expect "error below $level: a sentence" 1 "$(grep -c "^error below $level: .* work of .* evaluations" "$work/answer")" "$work/answer"
done
expect "does sub-cycling pay: a sentence" 1 "$(grep -c '^subcycle .* pay' "$work/answer")" "$work/answer"
cut -d, -f1-9,12-16 "$work/one.csv" >"$work/one"
cut -d, -f1-9,12-16 "$work/two.csv" >"$work/two"
same "a study twice, apart from times" "$work/one" "$work/two"
"$FMDSUB" study -q --pick 1e-5 --repeats 1 --until 1 decks/double-pendulum.yaml >"$work/pick.yaml" 2>"$work/err"
ended "--pick" 0 $? "$work/pick.yaml" "$work/err"
scheme=$(awk '$1 == "scheme:" { print $2 }' "$work/pick.yaml") tolerance=$(awk '$1 == "tolerance:" { print $2 }' "$work/pick.yaml")
"$FMDSUB" study -q --schemes "${scheme:-none}" --tolerances "${tolerance:-0}" --repeats 1 --until 1 decks/double-pendulum.yaml 2>"$work/err" |
    awk -F, 'NR == 2 { e = $5 } END { exit !(e > 0 && e <= 1e-5) }'
expect "--pick meets its error" 0 $? "$work/pick.yaml" "$work/err"
"$FMDSUB" study -q --pick 1e-15 --schemes midpoint --repeats 1 --until 1 decks/double-pendulum.yaml >"$work/out" 2>"$work/err"
expect "--pick: nothing that good" 1 $? "$work/out" "$work/err"

# The deck's own setting has its sentence, and --pick lines that a deck includes.
"$FMDSUB" study --repeats 0 --until 1 decks/pendulum.yaml >"$work/own.csv" 2>"$work/err"
expect "the deck's own setting" 1 "$(grep -c "^the deck's own setting, newmark at step 0.001 s: error .* work of .* times that of " "$work/err")" "$work/err"
sed -e '/^integrate:/d' -e 's/^gravity:/include: pick.yaml\nintegrate: {until: 1}\n&/' decks/pendulum.yaml >"$work/with.yaml"
"$FMDSUB" study -q --repeats 0 --until 1 --pick 1e-6 decks/pendulum.yaml >"$work/pick.yaml" 2>"$work/err"
"$FMDSUB" run "$work/with.yaml" >"$work/out" 2>"$work/err"
expect "--pick, included: status, its scheme runs" "0 1" "$? $(grep -c ", $(awk '$1 == "scheme:" { print $2 }' "$work/pick.yaml") to tolerance " "$work/err")" "$work/err" "$work/pick.yaml"
