# H35: a force 1/x that meets 0, and a table with a row that is not a number: it ends there, and says so.
for scheme in subcycle midpoint newmark generalized-alpha miao rk4 dopri5 radau5; do
    step="step: 1.0e-3"
    case $scheme in dopri5|radau5) step="tolerance: 1.0e-6" ;; esac
    row $scheme told 'without bound\|the step fell to' <<DECK
fmdsub: 1
bodies: {car: {mass: 1, at: [1, 0]}}
constraints: {rail: {prismatic: [ground, car], axis: [1, 0]}}
forces: {pole: {force: rail, value: -1/(1 + rail.displacement)}}
integrate: {$step, until: 5}
output: {every: 0.1, columns: [rail.displacement]}
DECK
done
row midpoint told 'is not finite' <<'DECK'
fmdsub: 1
bodies: {car: {mass: 1, at: [1, 0]}}
constraints: {rail: {prismatic: [ground, car], axis: [1, 0]}}
forces: {push: {force: rail, value: {table: [[0, 1], [1, nan], [2, 0]]}}}
integrate: {step: 1.0e-3, until: 5}
DECK
