# rates.sh -- both rates of subcycle chosen by a tolerance: steps are hardly ever rejected, and what is asked is met.
#
# The chain's base of the leaves turns while they vibrate: the W of a step is not that of the step before.  The slider is driven
# by what the rod does, and the rod's straight line in a major step is its error.
. tests/tools/lib.sh

run() { # SCHEME TOLERANCE DECK FILE
    "$FMDSUB" run -q --every 0.5 --set integrate.scheme="$1" --set integrate.tolerance="$2" --stats="$work/stats" "$3" >"$4" 2>"$work/err"
}

for deck in bar-slider stiff-leaf-chain telescope; do
    for tolerance in 1e-2 1e-4; do
        run subcycle $tolerance decks/$deck.yaml "$work/run"
        ended "$deck at $tolerance" 0 $? "$work/run" "$work/err"
        if awk '{ x[$1] = $2 } END { exit !(x["minor_steps"] > 0 && x["rejected"] < .25 * x["minor_steps"] && x["fast_evaluations"] < 12 * x["minor_steps"]) }' "$work/stats"
        then ok "$deck at $tolerance: few steps are rejected"; else not_ok "$deck at $tolerance: few steps are rejected" "too many:" "$work/stats"; fi
    done
done

run dop853 1e-11 decks/bar-slider.yaml "$work/reference"
for tolerance in 1e-2 1e-3 1e-4 1e-5; do
    run subcycle $tolerance decks/bar-slider.yaml "$work/run"
    off=$(awk -F, 'NR == FNR { for (i = 2; i <= 5; i++) { x[i] = $i; s = $i < 0 ? -$i : $i; if (FNR > 1 && s > top[i]) top[i] = s }; next }
        { for (i = 2; i <= 5; i++) last[i] = $i }
        END { for (i = 2; i <= 5; i++) { d = (last[i] - x[i]) / top[i]; if (d < 0) d = -d; if (d > most) most = d }; print most }' "$work/reference" "$work/run")
    if awk -v e="$off" -v t=$tolerance 'BEGIN { exit !(e > 0 && e < 10 * t) }'; then ok "bar-slider at $tolerance: met"
    else not_ok "bar-slider at $tolerance: met" "the end is off by $off of its range"; fi
done

# Where nothing is fast it is the midpoint rule, which besides lands on no record.
run midpoint 1e-4 decks/pendulum.yaml "$work/one"
steps=$(awk '$1 == "minor_steps" { print $2 }' "$work/stats")
run subcycle 1e-4 decks/pendulum.yaml "$work/two"
expect "nothing fast: as many steps" 1 "$(awk -v n="$steps" '$1 == "minor_steps" { print (n > 0 && $2 < 1.1 * n) }' "$work/stats")" "$work/stats"
