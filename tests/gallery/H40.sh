# H40: everything slow, everything fast, a fast coordinate that depends on others, the stiff one called slow: as it is, or told; one rate knows no partition.
want=$("$FMDSUB" run -q --set "integrate={scheme: dop853, tolerance: 1.0e-11, until: 2}" --set output='{every: 2, columns: [shaft.angle]}' "$ROOT/decks/four-bar.yaml" 2>/dev/null | tail -n 1 | cut -d, -f2)
for scheme in subcycle miao; do
    for fast in "[]" "[shaft]" "[shaft, elbow, wrist]" "[wrist]" "[elbow]"; do
        limit=1e-3
        [ "$fast" = "[]" ] && limit=0.02 # all of it takes the major step
        [ $scheme = miao ] && limit=${limit}or-told
        row $scheme $limit 'END { printf "%.2g", abs($2 - '$want') }' --set "partition={fast: $fast}" --set integrate.ratio=5 --set output='{every: 2, columns: [shaft.angle]}' <"$ROOT/decks/four-bar.yaml"
    done
done
for scheme in midpoint newmark generalized-alpha; do
    row $scheme 1e-3 'END { printf "%.2g", abs($2 - '$want') }' --set "partition={fast: [wrist]}" --set output='{every: 2, columns: [shaft.angle]}' <"$ROOT/decks/four-bar.yaml"
done
for scheme in $schemes; do
    row $scheme 0.2 'NR > 1 { see($2) } END { printf "%.2g", worst }' --set "partition={fast: [hub]}" --set output='{every: 0.05, columns: [energy.residual]}' <"$ROOT/decks/bar-slider.yaml"
done
