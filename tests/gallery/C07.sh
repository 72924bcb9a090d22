# C07: a mass between two stops, restitution 0.8: where it is at 6 s, and hundreds of impacts in a step.
for step in 1.0e-2 0.1 1.0e-3; do # v after n impacts is 0.8^n; legs of 2 m
    touching 1e-9 'END { x = 0; v = 3; t = 6; d = 1; while (t > (1 - x * d) / v) { t -= (1 - x * d) / v; x = d; d = -d; v *= 0.8 } printf "%.2g", abs($2 - (x + d * v * t)) }' --set integrate.step=$step <<'DECK'
fmdsub: 1
bodies: {a: {mass: 1, inertia: 1, at: [0, 0]}}
constraints: {s: {prismatic: [ground, a], axis: [1, 0], range: {lower: -1, upper: 1, hold: {restitution: 0.8}}}}
initial: {s.displacement_rate: 3}
integrate: {step: 1.0e-2, until: 6}
output: {every: 6, columns: [a.x]}
DECK
done
touching 1e-6 'END { printf "%.2g", abs(abs($2) - 1000) + abs($3 + $4 - 1000) }' <<'DECK'
fmdsub: 1
bodies: {a: {mass: 1, inertia: 1, at: [0, 0]}}
constraints: {s: {prismatic: [ground, a], axis: [1, 0], range: {lower: -1, upper: 1, hold: {restitution: 1}}}}
initial: {s.displacement_rate: 1000}
integrate: {step: 1, until: 2}
output: {every: 1, columns: [a.vx, s.upper.impacts, s.lower.impacts]}
DECK
