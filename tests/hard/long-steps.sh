# long-steps.sh -- steps that are long for what moves: order 8 between passages of a dead point, without a record that ends a
# step.  One step there, whose error looks small, is more than all others leave.
. tests/tools/lib.sh

run() { # TOLERANCE FILE
    "$FMDSUB" run -q --every 1 --set integrate.until=10 --set integrate.scheme=dop853 --set integrate.tolerance="$1" \
        --stats="$work/stats" decks/four-bar.yaml >"$2" 2>"$work/err"
}

run 1e-12 "$work/reference"
ended "the reference" 0 $? "$work/reference" "$work/err"
for tolerance in 1e-2 3e-3 1e-3 3e-4 1e-4 3e-5 2e-5 1e-5 3e-6 1e-6; do
    run $tolerance "$work/run"
    ended "at $tolerance" 0 $? "$work/run" "$work/err"
    off=$(awk -F, '
        NR == 1 { for (i = 2; i <= NF; i++) use[i] = $i !~ /^energy|force|\.(f[xyz]|m[xyz])$/; next }
        FNR == 1 { next }
        NR == FNR { for (i = 2; i <= NF; i++) { x[i] = $i; if (FNR == 2 || $i < low[i]) low[i] = $i; if (FNR == 2 || $i > high[i]) high[i] = $i }; n = NF; next }
        { for (i = 2; i <= n; i++) last[i] = $i }
        END { for (i = 2; i <= n; i++) if (use[i] && high[i] - low[i] > 1e-9) { d = (last[i] - x[i]) / (high[i] - low[i]); if (d < 0) d = -d; if (d > most) most = d }
              print most }' "$work/reference" "$work/run")
    if awk -v e="$off" -v t=$tolerance 'BEGIN { exit !(e > 0 && e <= 100 * t) }'; then ok "at $tolerance: met"
    else not_ok "at $tolerance: met" "the end is off by $off of a range"; fi
done

# A tenth of many steps is rejected, and there is one record: no sign of a force that jumps for ever.
cat >"$work/stiffens.yaml" <<'DECK'
fmdsub: 1
bodies: {b: {mass: 1, at: [0.5, 0]}}
constraints: {p: {prismatic: [ground, b], axis: [1, 0]}}
forces: {s: {spring: p, stiffness: 1.0e+6, cubic: 1.0e+10}, f: {force: p, value: 300*sin(600*t)}}
initial: {p.displacement: 0.01}
integrate: {scheme: dopri5, tolerance: 5.0e-4, until: 100}
output: {every: 100}
DECK
"$FMDSUB" run -q --stats="$work/stats" "$work/stiffens.yaml" >"$work/rows" 2>"$work/err"
status=$?
expect "100000 steps rejected among far more" "0 3 1" "$status $(wc -l <"$work/rows") $(awk '$1 == "rejected" { print ($2 > 100000) }' "$work/stats")" "$work/err"
