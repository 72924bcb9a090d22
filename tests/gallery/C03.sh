# C03: a ball thrown without spin slides and then rolls at 5/7 of its speed; small ones, too.
for size in 1 1.0e-2 1.0e-4 1.0e-6; do
    touching 1e-6 'END { printf "%.2g", abs($2 - 5 / 7) }' --set parameters.s=$size <<'DECK'
fmdsub: 1
parameters: {s: 1, m: 4000*s^3, I: 0.4*4000*s^5}
gravity: [0, -9.81]
bodies: {b: {mass: m, inertia: I, at: [0, s]}}
constraints: {f: {free: [ground, b]}}
surfaces: {floor: {plane: ground, at: [0, 0], normal: [0, 1]}, ball: {sphere: b, radius: s}}
contacts: {c: {between: [ball, floor], friction: 0.3}}
initial: {f.x_rate: sqrt(s)}
integrate: {step: 1.0e-3*sqrt(s), until: 2*sqrt(s)}
output: {every: 0.5*sqrt(s), columns: [{part: b.vx/sqrt(s)}]}
DECK
done
