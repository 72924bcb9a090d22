# H23: an oscillator of 10 rad/s on which a force sets in, at the end of a step and within one: its place at 1 s.
# x = cos(10 t) + (1 - cos(10 (t - t0))) F/k; second order, w^3 h^2/12, where the steps meet the jump, first elsewhere.
for scheme in $schemes rk4; do
    for case in "1.0e-2 0" "1.0e-2 1/3" "2.5e-3 1/3"; do
        set -- $case
        limit=$(awk "BEGIN { print $2 ? 1.2 * $1 : 1000 / 12 * $1 ^ 2 }")
        row $scheme $limit 'END { x = (1 - cos(10 * (0.5 - '$1' * '$2'))) * 0.2 + cos(10); printf "%.2g", abs($2 - x) }' <<DECK
fmdsub: 1
bodies: {car: {mass: 1, at: [0, 0]}}
constraints: {rail: {prismatic: [ground, car], axis: [1, 0]}}
forces: {k: {spring: rail, stiffness: 100}, push: {force: rail, value: "if(t < 0.5 + $1*$2, 0, 20)"}}
initial: {rail.displacement: 1}
integrate: {step: $1, until: 1}
output: {every: 1, columns: [rail.displacement]}
DECK
    done
done
