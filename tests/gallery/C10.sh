# C10: Painleve's rod: at a friction of 2 no sliding is possible, it jams at once; at 1 it slides on: the energy left after 0.05 s.
for case in "1 0.7826" "2 0.7948"; do
    set -- $case
    for step in 1.0e-3 1.0e-4; do
        touching 2e-4 'END { e = 9.81 * 0.5 * sin(1.1); printf "%.2g", abs(($2 + 9.81 * $3) / (4.5 + e) - '$2') }' --set contacts.c.friction=$1 --set integrate.step=$step <<'DECK'
fmdsub: 1
gravity: [0, -9.81]
parameters: {th: 1.1}
bodies: {b: {mass: 1, inertia: 1/12, at: [0, 0.5*sin(th)], orient: th, points: {toe: [-0.5, 0]}}}
constraints: {f: {planar: [ground, b], at: [0, 0.5*sin(th)]}}
surfaces: {floor: {plane: ground, at: [0, 0], normal: [0, 1]}, toe: {point: b.toe}}
contacts: {c: {between: [toe, floor], friction: 1}}
initial: {f.x_rate: -3}
integrate: {step: 1.0e-3, until: 0.05}
output: {every: 0.05, columns: [energy.kinetic, b.y]}
DECK
    done
done
