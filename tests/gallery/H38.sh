# H38: Andrews' mechanism at 0.03 s beside the test set's, five digits; the heavy top at 2 s; a governor's energy.
want=$(tail -n 1 "$ROOT/tests/refdata/andrews.csv")
for how in "dopri5 1.0e-9" "radau9 1.0e-9" "newmark 1.0e-5" "midpoint 1.0e-5"; do
    set -- $how
    case $1 in dopri5|radau9) set -- $1 "integrate={tolerance: $2, until: 0.03}" ;; *) set -- $1 "integrate.step=$2" ;; esac
    row $1 2e-4 'END { split("'$want'", w); for (i = 2; i <= 8; i++) see(($i - w[i]) / (1 + abs(w[i]))); printf "%.2g", (NF > 8 ? worst : 9) }' --set "$2" <"$ROOT/decks/andrews.yaml"
done
want=$(tail -n 1 "$ROOT/tests/refdata/heavy-top.csv")
for scheme in $schemes; do
    row $scheme 1e-3 'END { split("'$want'", w); for (i = 2; i <= 4; i++) see($i - w[i]); printf "%.2g", (NF > 4 ? worst : 9) }' <"$ROOT/decks/heavy-top.yaml"
done
for scheme in $schemes; do
    row $scheme 2e-3 'NR > 1 { see($2) } END { printf "%.2g", worst }' --columns energy.residual <"$ROOT/decks/governor.yaml"
done
