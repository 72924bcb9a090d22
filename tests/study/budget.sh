# budget.sh -- what a budget leaves out, and that it is told.
. tests/tools/lib.sh

# The budget is counted: too small a one brings the end forward, and says what it leaves out; the same bytes twice.
for i in 1 2; do
    "$FMDSUB" study --repeats 0 --budget 0.5 decks/flexible-crank.yaml >"$work/tight$i.csv" 2>"$work/tight$i"
    ended "--budget: status" 0 $? "$work/tight$i.csv" "$work/tight$i"
done
same "--budget: rows twice" "$work/tight1.csv" "$work/tight2.csv"
same "--budget: words twice" "$work/tight1" "$work/tight2"
expect "--budget: the end is told" 1 "$(grep -c '^the budget takes it to t = 0.0[0-9]* s of 0.1' "$work/tight1")" "$work/tight1"
expect "--budget: what is left out is told" 0 "$(grep -q '^left out: .* budget' "$work/tight1"; echo $?)" "$work/tight1"

# A pick by a part of the run says so in its lines, and beside them even with -q; by less than a tenth there is none.
"$FMDSUB" study -q --repeats 0 --budget 1.5 --pick 0.5 decks/flexible-crank.yaml >"$work/pick.yaml" 2>"$work/err"
expect "--pick, part of the run: status, lines, words" "0 1 1" "$? $(grep -c '^# its error was measured up to t = 0.0[0-9]* s only, of 0.1 s' "$work/pick.yaml") $(grep -c 'picked by errors up to .*budget' "$work/err")" "$work/pick.yaml" "$work/err"
"$FMDSUB" study -q --repeats 0 --budget 0.1 --pick 0.5 decks/flexible-crank.yaml >"$work/pick.yaml" 2>"$work/err"
expect "--pick, less than a tenth: status, lines, words" "5 0 1" "$? $(wc -l <"$work/pick.yaml") $(grep -c 'nothing is picked: .*--budget' "$work/err")" "$work/pick.yaml" "$work/err"
expect "times the work of another: told, never 1 times" "yes 0" "$(grep -q ' takes [1-9.e+]* times the work' "$work/tight1" && echo yes) $(grep -c ' 1 times' "$work/tight1")" "$work/tight1"
