# C08: two discs that would pass through each other between the ends of a step: the speeds after the oblique impact.
for step in 2.0e-3 1.25e-2 5.0e-2 1.0e-4; do
    touching 1e-6 'END { printf "%.2g", abs($2 + 875) + abs($3 + 484.12291827592713) + abs($4 - 1) }' --set integrate.step=$step <<'DECK'
fmdsub: 1
bodies: {a: {mass: 1, inertia: 1, at: [-1, 0]}, b: {mass: 1, inertia: 1, at: [1, 0.05]}}
constraints: {fa: {free: [ground, a], at: [-1, 0]}, fb: {free: [ground, b], at: [1, 0.05]}}
surfaces: {sa: {sphere: a, radius: 0.1}, sb: {sphere: b, radius: 0.1}}
contacts: {c: {between: [sa, sb], restitution: 1}}
initial: {fa.x_rate: 1000, fb.x_rate: -1000}
integrate: {step: 2.0e-3, until: 0.1}
output: {every: 0.1, columns: [a.vx, a.vy, c.impacts]}
DECK
done
