# H05: Bricard's mechanism, one equation redundant in every posture: its energy over 10 s [J].
for scheme in $schemes; do
    limit=1e-3
    [ $scheme = generalized-alpha ] && limit=0.2 # it damps, at rho_infinity 0.9
    row $scheme $limit 'NR > 1 { see($2) } END { printf "%.2g", worst }' --set output='{every: 0.05, columns: [energy.residual]}' <"$ROOT/decks/bricard.yaml"
done
