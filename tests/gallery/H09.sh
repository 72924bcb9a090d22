# H09: a four-bar whose coupler has no mass, beside one of 1e-12 kg; a free body without mass is refused by name.
bar() { sed -e "s|coupler: {mass: 1, inertia: 1/12|coupler: {mass: $1, inertia: $1/12|" "$ROOT/decks/four-bar.yaml"; }
for scheme in $schemes rk4; do
    how="--columns shaft.angle,pivot.angle,shaft.angle_rate --every 2"
    bar 1.0e-12 >light.yaml
    want=$("$FMDSUB" run -q --set integrate.scheme=$scheme $how light.yaml 2>/dev/null | tail -n 1)
    bar 0 | row $scheme 1e-6 'END { split("'$want'", w); printf "%.2g", abs($2 - w[2]) + abs($3 - w[3]) + abs($4 - w[4]) }' $how
done
row deck told "'a'" <<'DECK'
fmdsub: 1
bodies: {a: {mass: 0, inertia: 0, at: [0, 0]}, b: {mass: 1, inertia: 1, at: [1, 0]}}
integrate: {step: 1.0e-3, until: 1}
DECK
