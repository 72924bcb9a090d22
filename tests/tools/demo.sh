# demo.sh -- the bar-slider with slow steps 1, 5 and 10 times the fast ones, and what that costs.
#
# Error: the largest of all columns against tests/refdata/bar-slider.csv, relative to the column's
# largest value.  CPU time: of the steps, the least of 20 runs that take turns.
. tests/tools/lib.sh
deck=decks/bar-slider.yaml

for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do
    for ratio in 1 5 10; do
        "$FMDSUB" run -q --set integrate.ratio=$ratio --stats="$work/stats" "$deck" >"$work/$ratio.csv" && [ -s "$work/$ratio.csv" ] || exit 1
        sed "s/^/$ratio /" "$work/stats" >>"$work/all"
    done
done
for ratio in 1 5 10; do
    echo "$ratio error $("$COMPARE" --reference --map tests/refdata/bar-slider.map tests/refdata/bar-slider.csv "$work/$ratio.csv")"
done >>"$work/all"

echo
echo "$deck: minor step 1.0e-3 s, major step ratio times that, to t = 2 s"
echo
awk '
    $2 == "cpu_seconds" { if (!($1 in cpu) || $3 < cpu[$1]) cpu[$1] = $3; next }
    { x[$1, $2] = $3 }
    END {
        printf "%6s %11s %11s %11s %9s %9s %16s\n", "ratio", "error", "slow evals", "fast evals", "CPU [ms]", "of 1:1", "energy residual"
        n = split("1 5 10", ratio, " ")
        for (i = 1; i <= n; i++) {
            r = ratio[i]
            printf "%4d:1 %11.2e %11d %11d %9.2f %9.2f %16.1e\n", r, x[r, "error"], x[r, "slow_evaluations"],
                x[r, "fast_evaluations"], 1000 * cpu[r], cpu[r] / cpu[1], x[r, "energy_share"]
        }
    }' "$work/all"
echo
echo "energy residual: |W_kin + W_int - W_ext| over the largest sum of their sizes"

# Where it pays: large and slow, with something small and fast in it.
deck=tests/bench/small-fast.yaml
echo
echo "$deck: four arms of 40 links that fall, a small one that vibrates; \`study --budget 5\` says:"
echo
"$FMDSUB" study --repeats 0 --budget 5 "$deck" >"$work/rows" 2>"$work/words" || exit 1
sed -n "/^the budget takes/p; /^the deck's own setting/p; /^subcycle at step/p" "$work/words"
awk -F , '
    NR == 2 { error = $5; work = $9; next }
    NR > 2 && $16 == "ok" && $4 == 1 && $1 != "subcycle" && $5 <= 2 * error && (!best || $9 < best) { best = $9; scheme = $1; at = $2; its = $5 }
    END {
        if (best) printf "what was gained: an error of %.1e for %d evaluations; %s at tolerance %g takes %d for %.1e, %.1f times as many\n",
            error, work, scheme, at, best, its, best / work
    }' "$work/rows"
echo "what now: \`fmdsub check YOUR.yaml\` with neither 'scheme' nor 'step' in it says what it would take, and which coordinates are fast"

echo
echo "next:"
echo "    ${FMDSUB#"$ROOT"/} animate -o crank.html decks/flexible-crank.yaml    # a page for the browser"
echo "    ${FMDSUB#"$ROOT"/} study decks/pendulum.yaml                          # what accuracy costs"
echo "    ${FMDSUB#"$ROOT"/} new mechanism > first.yaml                         # a deck to start from"
