# stayed.sh -- a beam with a stay between two of its own points: a spring, a damper, a drive.  Frequencies are those of a mesh of
# 100 elements with the spring's stiffness added, made apart from this program; the motion is that of a beam whose stay ends on
# small rigid bodies; momenta are kept.
. tests/tools/lib.sh
stayed() { # FROM TO BODIES JOINTS: the deck
    cat <<DECK
fmdsub: 1
bodies:
  arm:
    beam: {from: [0, 0], to: [1, 0], elements: 20}
    section: {rectangle: [0.03, 0.01]}
    material: {E: 7.0e+10, nu: 0.33, density: 2700}
    modes: 12
    damping: {beta: 1.0e-5}
    points: {tip: {station: 1}, a: {station: 0.2, offset: [0, 0.099], static: true}, b: {station: 0.8, offset: [0, 0.099], static: true}}
${3:-}
constraints:
  clamp: {fixed: [ground, arm], at: [0, 0]}
${4:-}
measures: {l: {distance: [$1, $2]}, d: {displacement: [$1, $2], axis: [0, 1]}}
forces: {stay: {spring: l, stiffness: 2.0e+5, damping: 20}, cross: {spring: d, stiffness: 1000}, pull: {force: arm.tip, value: [0, "20*smooth(t, 0, 0.01)"]}}
integrate: {scheme: radau9, tolerance: 1.0e-6, until: 0.1}
output: {every: 0.01, columns: [arm.tip.dx, arm.tip.dy, stay.force, cross.force, l, d, energy.residual]}
DECK
}
stayed arm.a arm.b >"$work/own.yaml"
stayed ra rb "  ra: {mass: 1.0e-8, inertia: 1.0e-11, at: [0.2, 0.099]}
  rb: {mass: 1.0e-8, inertia: 1.0e-11, at: [0.8, 0.099]}" "  fa: {fixed: [arm, ra], at: [0.2, 0]}
  fb: {fixed: [arm, rb], at: [0.8, 0]}" | sed '/static: true/s/, a: .*/}/' >"$work/small.yaml"
"$FMDSUB" modes -q -s forces.cross.stiffness=0 "$work/own.yaml" >"$work/out" 2>"$work/err"
awk -F, 'NR > 1 && NR < 5 { split("9.575907 95.76718 146.4025", f, " "); d = $2 / f[NR - 1] - 1; n += d * d < 1e-8 } END { print n + 0 }' "$work/out" >"$work/met"
expect "a beam with a stay: its frequencies" 3 "$(cat "$work/met")" "$work/out" "$work/err"
for deck in own small; do "$FMDSUB" run -q "$work/$deck.yaml" >"$work/$deck.csv" 2>"$work/err"; done
"$FMDSUB" diff -q --rel 1e-5 --columns 'arm.*,*.force,l,d' "$work/own.csv" "$work/small.csv" >"$work/out" 2>"$work/err"
expect "its motion is that with small bodies at the ends" "0 12" "$? $(grep -c , "$work/own.csv")" "$work/out" "$work/err"
"$FMDSUB" run -q -s 'constraints={clamp: {free: [ground, arm], at: [0.5, 0]}}' -s 'forces.pull={force: [arm.a, arm.b], value: 5}' \
    -s 'initial={clamp.angle_rate: 3, clamp.y_rate: 1}' -s 'integrate={scheme: midpoint, step: 1.0e-4, until: 0.1}' \
    -s 'output.columns=["momentum.*"]' "$work/own.yaml" >"$work/out" 2>"$work/err"
awk -F, 'NR == 2 { for (i = 2; i <= NF; i++) was[i] = $i } NR > 2 { for (i = 2; i <= NF; i++) { d = $i - was[i]; if (d * d > 1e-24) exit 1 } n++ }
    END { print n }' "$work/out" >"$work/kept"
expect "free, it keeps its momenta" 10 "$(cat "$work/kept")" "$work/out" "$work/err"
