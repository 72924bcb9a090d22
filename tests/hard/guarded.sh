# guarded.sh -- where the guard takes steps in parts over a stop that jumps, it goes on where the plain scheme does.
. tests/tools/lib.sh

for how in "midpoint, step: 1.0e-2" "newmark, step: 2.0e-3" "miao, step: 2.0e-3"; do
    cat >"$work/deck.yaml" <<END
fmdsub: 1
gravity: [0, -9.81]
bodies:
  a: {mass: 1, inertia: 1/12, at: [0.5, 0]}
  b: {mass: 0.1, inertia: 1.0e-3, at: [1.15, 0]}
constraints:
  p: {revolute: [ground, a], at: [0, 0]}
  q: {revolute: [a, b], at: [1, 0]}
forces:
  k: {spring: q, stiffness: 3000, cubic: 1.0e+6}
  w: {unilateral: q, from: 0.05, stiffness: 1.0e+5, damping: 1}
initial: {q.angle: 0.3, p.angle_rate: 3}
integrate: {scheme: $how, guard: act, until: 1}
output: {every: 0.02, columns: [p.angle, q.angle]}
END
    "$FMDSUB" run -q "$work/deck.yaml" >"$work/out" 2>"$work/err"
    ended "guard: act, $how" 0 $? "$work/out" "$work/err"
    "$FMDSUB" run -q --every-steps 1 --columns step.sweeps "$work/deck.yaml" >"$work/out" 2>"$work/err"
    expect "guard: act, $how: every step tells its iterations" 0 "$(awk -F, 'NR > 2 && !($2 > 0) { n++ } END { print n + (NR < 100) }' "$work/out")" "$work/err"
done
