# table.sh -- the table of a study: a golden one, its forms and files.
. tests/tools/lib.sh

# Without times the table is the same whatever the machine does: a golden file, to a quarter of errors and work, which other
# libraries of functions may move; the other forms have the same numbers.
simple() { "$FMDSUB" study -q --repeats 0 --until 1 --schemes midpoint,dop853,radau9 "$@" decks/pendulum.yaml 2>"$work/err"; }
simple >"$work/golden.csv"
awk -F, '
    function near(a, b) { return a == b || (a > .75 * b && b > .75 * a) }
    NR == FNR { line[FNR] = $0; n = FNR; next }
    { split(line[FNR], was, ",") }
    FNR == 1 { bad = $0 != line[1]; next }
    $1 != was[1] || $2 != was[2] || $3 != was[3] || $4 != was[4] || $10 != "" || $16 != was[16] ||
        !near($5, was[5]) || !near($9, was[9]) || !near($12, was[12]) { print "was: " line[FNR]; print "is:  " $0; bad = 1 }
    END { exit bad || FNR != n }' tests/refdata/study-pendulum.csv "$work/golden.csv" >"$work/line"
expect "a study without times" 0 $? "$work/line"
simple -f json >"$work/rows.json"
simple -f ndjson >"$work/rows.ndjson"
sed -e '1d' -e '$d' -e 's/^,//' "$work/rows.json" >"$work/inner"
same "-f json, ndjson: the same rows" "$work/inner" "$work/rows.ndjson"
awk -F, 'NR > 1 { print $1, $5, $16 }' "$work/golden.csv" >"$work/a"
sed 's/.*"scheme":"\([^"]*\)".*"error":\([^,]*\),.*"status":"\([^"]*\)".*/\1 \2 \3/' "$work/rows.ndjson" >"$work/b"
same "-f ndjson: the numbers of the CSV" "$work/a" "$work/b"
simple -f json --schemes newmark --steps 1.0e-2 --absolute >"$work/unit"
expect "--absolute: the unit" 1 "$(grep -c '"worst":"pin.fx".*"unit":"N"' "$work/unit")" "$work/unit"
simple -o "$work/file.csv" >"$work/out"
expect "-o FILE: nothing else" "0 0 rows" "$? $(wc -c <"$work/out") $([ -s "$work/file.csv" ] && echo rows)" "$work/out"
same "-o FILE" "$work/golden.csv" "$work/file.csv"

# Errors of what is fast and of what is slow are those of their columns alone.
for column in guide.displacement hub.angle; do
    "$FMDSUB" study -q --repeats 0 --until 0.5 --schemes newmark --steps 0.001 -s "output.columns=[$column]" decks/bar-slider.yaml 2>"$work/err" |
        awk -F, 'NR == 2 { print $5, $7, $8 }'
done >"$work/parts"
expect "errors of what is fast and slow" "fine" "$(awk 'NR == 1 { fast = $1; both = $2 " " $3 } NR == 2 { print (fast > 0 && $1 > 0 && both == fast " " $1 && both == $2 " " $3) ? "fine" : "not" }' "$work/parts")" "$work/parts" "$work/err"
