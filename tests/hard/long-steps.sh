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
