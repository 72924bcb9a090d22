# H06: a planar four-bar made from four spatial revolute joints, three equations of which are redundant, beside the planar one.
for scheme in $schemes; do
    how="--set integrate.scheme=$scheme --set integrate.newton_tolerance=1.0e-13 --set output.every=2 --columns shaft.angle,pivot.angle,shaft.angle_rate"
    want=$("$FMDSUB" run -q $how "$ROOT/decks/four-bar.yaml" 2>/dev/null | tail -n 1)
    row $scheme 1e-9 'END { split("'$want'", w); printf "%.2g", abs($2 - w[2]) + abs($3 - w[3]) + abs($4 - w[4]) }' $how <"$ROOT/tests/decks/spatial-four-bar.yaml"
done
