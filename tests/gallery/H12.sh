# H12: an oscillator of 1e6 rad/s in steps of 1e-3 s: its phase is that of the rule, 2 atan(500) a step.
for scheme in $schemes; do
    row $scheme 1e-5 'END { p = 2 * atan2(500, 1); printf "%.2g", abs($2 - cos(10000 * p)) }' <<'DECK'
fmdsub: 1
bodies: {car: {mass: 1, at: [0, 0]}}
constraints: {rail: {prismatic: [ground, car], axis: [1, 0]}}
forces: {k: {spring: rail, stiffness: 1.0e+12}}
initial: {rail.displacement: 1}
integrate: {step: 1.0e-3, until: 10}
output: {every: 10, columns: [rail.displacement]}
DECK
done
