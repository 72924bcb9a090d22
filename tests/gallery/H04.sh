# H04: a parallelogram that stands flat, where two branches meet: at rest it is refused; its rates name the branch.
flat() { printf 'fmdsub: 1\nbodies:\n  a: {mass: 1, inertia: 1/12, at: [0.5, 0]}\n  c: {mass: 1, inertia: 1/12, at: [1.5, 0]}\n  b: {mass: 1, inertia: 1/12, at: [1.5, 0]}\nconstraints:\n  A: {revolute: [ground, a], at: [0, 0]}\n  B: {revolute: [a, c], at: [1, 0]}\n  C: {revolute: [c, b], at: [2, 0]}\n  D: {revolute: [ground, b], at: [1, 0]}\ninitial: {%s}\nintegrate: {step: 1.0e-3, until: 8}\noutput: {every: 8, columns: [A.angle, D.angle]}\n' "$1"; }
flat "" | row deck told 'dead point'
for scheme in $schemes; do
    flat "A.angle_rate: 1, D.angle_rate: 1" | row $scheme 1e-5 'END { printf "%.2g", abs($2 - 8) + abs($3 - 8) }'
    flat "A.angle_rate: 0, D.angle_rate: 1" | row $scheme 1e-5 'END { printf "%.2g", abs($2) + abs($3 - 8) }'
done
