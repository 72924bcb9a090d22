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

# Behind a standstill works are as little as behind the start: what a quadrature is off by there is no loss.
for how in "scheme: midpoint, tolerance: 1.0e-4" "scheme: newmark, tolerance: 1.0e-4" "scheme: newmark, step: 0.004" "scheme: dopri5, tolerance: 1.0e-5"; do
    go "from a standstill, $how" 0 --set "integrate={$how, until: 2}" <<'YAML'
fmdsub: 1
gravity: [0, -9.81]
bodies: {trolley: {mass: 3, at: [0, 0]}, rod: {mass: 1, inertia: 0.05, at: [0, -0.4]}}
constraints: {rail: {prismatic: [ground, trolley], axis: [1, 0]}, pin: {revolute: [trolley, rod], at: [0, 0]}}
drives: {go: {drive: rail.displacement, value: "0.8*smooth(t, 0.3, 1.1)"}}
integrate: {until: 2}
output: {every: 0.02, columns: [pin.angle, pin.angle_rate]}
YAML
    expect "from a standstill, $how: nothing is told, the balance is kept" "0 1" \
        "$(grep -c 'for the first time' "$work/err") $(grep -c '^energy balance kept' "$work/err")" "$work/err"
done

# One that is lost behind it is told: a spring that the step does not resolve.
go "behind a standstill, lost" 1 --set "integrate={scheme: rk4, step: 0.004, until: 2}" <<'YAML'
fmdsub: 1
bodies: {trolley: {mass: 3, at: [0, 0]}, load: {mass: 1, at: [1, 0]}}
constraints: {rail: {prismatic: [ground, trolley], axis: [1, 0]}, slide: {prismatic: [trolley, load], axis: [1, 0]}}
forces: {k: {spring: slide, stiffness: 6.0e+5}}
drives: {go: {drive: rail.displacement, value: "0.8*smooth(t, 0.3, 1.1)"}}
integrate: {until: 2}
output: {every: 0.02, columns: [slide.displacement]}
YAML
told "behind a standstill, lost: told" "for the first time: the step does not resolve 'slide.displacement'"
