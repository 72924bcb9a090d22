# apart.sh -- two rates under a tolerance where they are no use: stiff fast parts that begin anew with each major step.
. tests/tools/lib.sh

# Three blades on a hub, run up from rest: single rates take 2000 steps at 1e-3.
work_of() { awk -v key="$1" '$1 == key { print $2 }' "$work/stats"; }
for scheme in midpoint subcycle; do
    "$FMDSUB" run -q --every 0.015 --set integrate.scheme=$scheme --set integrate.tolerance=1e-3 --stats="$work/stats" \
        decks/airscrew/airscrew.yaml >"$work/out" 2>"$work/err"
    ended "airscrew by $scheme" 0 $? "$work/out" "$work/err"
    awk -v slow="$(work_of slow_evaluations)" -v fast="$(work_of fast_evaluations)" 'BEGIN { exit !(slow > 100 && slow < 12000 && fast < 20000) }' &&
        ok "airscrew by $scheme: evaluations" || not_ok "airscrew by $scheme: evaluations" "too many, or none" "$work/stats"
done
