# C11: a mass on a soft stop of any stiffness in any step: the energy, over what it fell; 1000 bounces on 1e8 N/m.
for stiffness in 1.0e+2 1.0e+5 1.0e+8 1.0e+11; do
    for step in 1.0e-2 1.0e-3; do
        touching 1e-9 'NR > 1 { see($2) } END { printf "%.2g", worst / 4.905 }' --set forces.stop.stiffness=$stiffness --set integrate.step=$step <<'DECK'
fmdsub: 1
gravity: [0, -9.81]
bodies: {b: {mass: 1, at: [0, 0.5]}}
constraints: {y: {prismatic: [ground, b], axis: [0, 1]}}
forces: {stop: {unilateral: y, stiffness: 1, from: -0.5, side: below}}
integrate: {step: 1.0e-3, until: 12}
output: {every: {steps: 1}, columns: [energy.residual]}
DECK
    done
done
touching 1e-9 'NR > 1 { see($2) } END { printf "%.2g", worst / 9.81 }' <<'DECK'
fmdsub: 1
gravity: [0, -9.81]
bodies: {b: {mass: 1, at: [0, 1]}}
constraints: {y: {prismatic: [ground, b], axis: [0, 1]}}
forces: {stop: {unilateral: y, stiffness: 1.0e+8, from: -1, side: below}}
integrate: {step: 1.0e-3, until: 904}
output: {every: {steps: 100}, columns: [energy.residual]}
DECK
