# H40: everything slow, everything fast, a fast coordinate that depends on others, the stiff one called slow: as midpoint, or told.
want=$("$FMDSUB" run -q --set "integrate={scheme: dop853, tolerance: 1.0e-11, until: 2}" --set output='{every: 2, columns: [shaft.angle]}' "$ROOT/decks/four-bar.yaml" 2>/dev/null | tail -n 1 | cut -d, -f2)
for fast in "[]" "[shaft]" "[shaft, elbow, wrist]" "[wrist]" "[elbow]"; do
    limit=1e-3
    [ "$fast" = "[]" ] && limit=0.02 # all of it takes the major step
    row subcycle $limit 'END { printf "%.2g", abs($2 - '$want') }' --set "partition={fast: $fast}" --set integrate.ratio=5 --set output='{every: 2, columns: [shaft.angle]}' <"$ROOT/decks/four-bar.yaml"
done
row subcycle 0.2 'NR > 1 { see($2) } END { printf "%.2g", worst }' --set "partition={fast: [hub]}" --set output='{every: 0.05, columns: [energy.residual]}' <"$ROOT/decks/bar-slider.yaml"
