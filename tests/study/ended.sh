# ended.sh -- a study that is ended on the way.
. tests/tools/lib.sh

# Ended on the way, the rows that are done are there, and the sentences on them; no process stays.
"$FMDSUB" study --repeats 100000 --schemes midpoint,dop853 --until 1 decks/pendulum.yaml >"$work/some.csv" 2>"$work/err" &
pid=$!
for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do
    grep -q '^reference: ' "$work/err" && break
    sleep 0.2
done
sleep 0.5
kill -TERM $pid
wait $pid
expect "ended: status, rows" "143 0" "$? $(awk -F, 'NR > 1 && $5 > 0 { n++ } END { print !(n > 3) }' "$work/some.csv")" "$work/some.csv" "$work/err"
