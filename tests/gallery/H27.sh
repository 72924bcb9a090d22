# H27: no freedom, nothing but freedoms, no bodies, more equations than unknowns.
row deck told '0 freedoms' <<'DECK'
fmdsub: 1
bodies: {a: {mass: 1, inertia: 0.1, at: [0.5, 0]}, b: {mass: 1, inertia: 0.1, at: [0.75, 0.5]}, c: {mass: 1, inertia: 0.1, at: [0.25, 0.5]}}
constraints: {foot: {fixed: [ground, a], at: [0, 0]}, ab: {revolute: [a, b], at: [1, 0]}, bc: {revolute: [b, c], at: [0.5, 1]}, ca: {revolute: [c, a], at: [0, 0]}}
integrate: {step: 1.0e-3, until: 0.01}
DECK
for scheme in subcycle midpoint newmark generalized-alpha miao dopri5; do
    step="step: 1.0e-3"
    [ $scheme = dopri5 ] && step="tolerance: 1.0e-9"
    row $scheme 1e-9 'END { printf "%.2g", abs($2 + 4.905) + abs($3 + 4.905) }' <<DECK
fmdsub: 1
gravity: [0, -9.81]
bodies: {a: {mass: 1, inertia: 0.1, at: [0, 0]}, b: {mass: 2, inertia: 0.2, at: [1, 0]}}
integrate: {$step, until: 1}
output: {every: 1, columns: [a.y, b.y]}
DECK
done
printf 'fmdsub: 1\nbodies: {}\nintegrate: {step: 1.0e-3, until: 1}\n' >none.yaml
row deck told 'bodies' <none.yaml
cat >bridge.yaml <<'DECK'
fmdsub: 1
gravity: [0, -9.81]
bodies:
  bar$i: {repeat: {i: [1, 6]}, mass: 1, inertia: 1/12, at: [i, -0.5]}
  bridge: {mass: 1, inertia: 1, at: [3.5, -1]}
constraints:
  foot$i: {repeat: {i: [1, 6]}, revolute: [ground, bar$i], at: [i, 0]}
  head$i: {repeat: {i: [1, 6]}, revolute: [bar$i, bridge], at: [i, -1]}
initial: {foot1.angle_rate: 1}
integrate: {step: 1.0e-3, until: 1}
output: {every: 0.01, columns: [energy.residual]}
DECK
for scheme in $schemes; do row $scheme 1e-4 'NR > 1 { see($2) } END { printf "%.2g", worst }' <bridge.yaml; done
