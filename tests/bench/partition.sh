# partition.sh -- what scheme: auto and partition: auto take on decks whose partition was made by hand, beside what these take
# as they stand: errors and counted evaluations of both, by `fmdsub study`.  A given step is what auto aims at.  Judged: on six
# at least auto takes no more work for no larger an error, and on four at least of those where one rate is enough it takes one.
#     sh tests/bench/partition.sh [DECK...]; BUDGET (default 4): CPU seconds of a study
. tests/tools/lib.sh
[ $# -gt 0 ] || set -- bar-slider bar-slider-constant spring-pendulum stiff-leaf-chain telescope driven-telescope geared-pendulum \
    double-pendulum light-hub turbine-blade
# row DECK ARGUMENT...: scheme, error and work of what the deck takes with these.
row() {
    "$FMDSUB" run -q -f ndjson "$@" 2>"$work/err" | head -n 1 | tr ',{' '\n\n' | tr -d '"}' >"$work/head"
    is() { awk -F : -v key="$1" '$1 == key { print $2; exit }' "$work/head"; }
    tolerance=$(is tolerance)
    if [ "${tolerance:-0}" != 0 ]; then set -- "$@" --tolerances "$tolerance"; else set -- "$@" --steps "$(is step)" --ratios "$(is ratio)"; fi
    timeout 300 "$FMDSUB" study -q --repeats 0 --budget "${BUDGET:-4}" --schemes "$(is scheme)" "$@" 2>"$work/err" |
        awk -F , 'NR == 2 { print $1, $5, $9 }'
}
printf '%-22s %-9s %9s %9s   %-9s %9s %9s  %6s  %s\n' deck own error work auto error work over verdict
for name in "$@"; do
    deck=decks/$name.yaml
    own=$(row --set integrate.scheme=subcycle "$deck")
    auto=$(row --set integrate.scheme=auto --set partition=auto "$deck")
    echo "$(basename "$name") $own $auto" | awk 'NF < 7 { printf "%-22s no row: %s\n", $1, $0; next }
        { over = $7 / $4; good = over <= 1.05 && $6 <= 1.05 * $3
          verdict = good ? ($5 == "subcycle" ? "two-rates" : "one-rate") : "dearer"
          printf "%-22s %-9s %9.2g %9d   %-9s %9.2g %9d  %6.2f  %s\n", $1, $2, $3, $4, $5, $6, $7, over, verdict }'
done | tee "$work/table"
awk '$NF == "two-rates" || $NF == "one-rate" { good++ } $NF == "one-rate" { one++ }
    END { printf "%d of %d: no more work, no larger an error; of these %d by one rate\n", good, NR, one; exit !(good >= 6 && one >= 4) }' "$work/table"
