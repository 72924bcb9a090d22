# stepped.sh -- a shaft with a shoulder, and one with a groove: two sections at one station are a step.  Under a force F at its
# tip a cantilever bends by F sum (b^3 - a^3)/(3 E I), b and a the distances of a piece's ends from the tip; whatever its elements,
# and cut into segments at the step or beside it, which the shortening by bending moves by 1e-6.
. tests/tools/lib.sh
cat >"$work/deck.yaml" <<'DECK'
fmdsub: 1
parameters: {F: 1, E: 7.0e+10}
bodies:
  arm:
    beam: {from: [0, 0], to: [1, 0], elements: 8}
    sections: [{station: 0, rectangle: [0.03, 0.02]}, {station: 0.4, rectangle: [0.03, 0.02]},
               {station: 0.4, rectangle: [0.03, 0.01]}, {station: 1, rectangle: [0.03, 0.01]}]
    material: {E: E, nu: 0.3, density: 2700}
    modes: 3
    points: {tip: {station: 1, static: true}}
    stress: {thin: {station: 0.4, corner: top}}
constraints: {clamp: {fixed: [ground, arm], at: [0, 0]}}
forces: {pull: {force: arm.tip, value: [0, F]}}
initial: {static: true}
integrate: {scheme: midpoint, step: 1.0e-3, until: 1.0e-3}
output: {columns: [arm.tip.dy, "arm*thin.bending"]}
DECK
# bends NAME TIP STRESS ARGUMENTS: to 2e-6, and 1e-4 (the arm is shorter by bending)
bends() {
    bends_name=$1 bends_tip=$2 bends_stress=$3
    shift 3
    "$FMDSUB" run -q "$@" "$work/deck.yaml" >"$work/out" 2>"$work/err"
    bends_rc=$?
    awk -F, -v tip="$bends_tip" -v stress="$bends_stress" 'FNR == 2 { d = $2 / (tip) - 1; e = $3 / (stress) - 1; printf "%.3g %.3g\n", d, e
        exit !(d * d < 4e-12 && e * e < 1e-8) } END { if (NR < 2) exit 1 }' "$work/out" >"$work/off"
    expect "$bends_name" "0 0" "$bends_rc $?" "$work/off" "$work/err" "$work/out"
}
thick=2.0e-8 thin=2.5e-9
tip=$(awk "BEGIN { printf \"%.12g\", (1 - .6^3) / (3 * 7e10 * $thick) + .6^3 / (3 * 7e10 * $thin) }")
stress=$(awk "BEGIN { printf \"%.12g\", -.6 * .005 / $thin }")
for elements in 1 8 40; do bends "a shoulder, $elements elements" $tip $stress -s bodies.arm.beam.elements=$elements -s bodies.arm.modes=1; done
bends "in two segments" $tip $stress -s bodies.arm.segments=2
near=$(awk "BEGIN { printf \"%.12g\", -.6 * .01 / $thick }")
bends "in five, cut at the step: the stress is that of the part before" $tip $near -s bodies.arm.segments=5
tip=$(awk "BEGIN { printf \"%.12g\", (1 - .6^3 + .59^3) / (3 * 7e10 * $thick) + (.6^3 - .59^3) / (3 * 7e10 * $thin) }")
bends "a groove" $tip $stress -s 'bodies.arm.sections=[{station: 0, rectangle: [0.03, 0.02]}, {station: 0.4, rectangle: [0.03, 0.02]},
    {station: 0.4, rectangle: [0.03, 0.01]}, {station: 0.41, rectangle: [0.03, 0.01]}, {station: 0.41, rectangle: [0.03, 0.02]},
    {station: 1, rectangle: [0.03, 0.02]}]'
