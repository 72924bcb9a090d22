# H07: a parallelogram with a third crank: of the same length it swings, longer by 1e-6 or 1e-2 it says so.
cranks() { printf 'fmdsub: 1\ngravity: [0, -9.81]\nbodies:\n  a: {mass: 1, inertia: 1/12, at: [0, 0.5]}\n  b: {mass: 1, inertia: 1/12, at: [1, 0.5]}\n  d: {mass: 1, inertia: 1/12, at: [2, 0.5 + %s/2]}\n  c: {mass: 1, inertia: 1/12, at: [1, 1]}\nconstraints:\n  A: {revolute: [ground, a], at: [0, 0]}\n  B: {revolute: [ground, b], at: [1, 0]}\n  D: {revolute: [ground, d], at: [2, 0]}\n  P: {revolute: [a, c], at: [0, 1]}\n  Q: {revolute: [b, c], at: [1, 1]}\n  R: {revolute: [d, c], at: [2, 1 + %s]}\ninitial: {A.angle_rate: -1}\nintegrate: {step: 1.0e-3, until: %s}\noutput: {every: 0.1, columns: [A.angle, energy.residual]}\n' $1 $1 $2; }
for scheme in $schemes; do
    cranks 0 10 | row $scheme 1e-3 'NR > 1 { see($3) } END { printf "%.2g", worst }'
    cranks 1.0e-6 10 | row $scheme 1e-3or-told 'NR > 1 { see($3) } END { printf "%.2g", worst }' --strict
    cranks 1.0e-2 10 | row $scheme told 'loop\|close'
done
