# C15: a ball thrown on a floor that gives way slides and then rolls, at 5/7 of its speed, by every scheme; two that spin meet off their centres.
for scheme in midpoint newmark generalized-alpha hht subcycle rk4; do
    row $scheme 2e-4 'END { printf "%.2g", abs($2 * 7 / 15 - 1) }' <<'DECK'
fmdsub: 1
gravity: [0, -9.81]
bodies: {ball: {mass: 1, inertia: 0.004, at: [0, 0.1]}}
constraints: {fly: {planar: [ground, ball]}}
surfaces: {floor: {plane: ground, at: [0, 0], normal: [0, 1]}, skin: {sphere: ball, radius: 0.1}}
contacts: {roll: {between: [skin, floor], stiffness: 1.0e+5, damping: 200, friction: 0.3}}
initial: {fly.x_rate: 3}
integrate: {step: 2.0e-4, until: 1}
output: {every: 1, columns: [ball.vx]}
DECK
done
touching 1e-12 'END { printf "%.2g", abs($2) + abs($3 + 0.12) }' <<'DECK'
fmdsub: 1
bodies:
  a: {mass: 1, inertia: [0.004, 0.004, 0.004], at: [0, 0, 0]}
  b: {mass: 2, inertia: [0.01, 0.01, 0.01], at: [0.3, 0.05, 0.02]}
constraints: {fa: {free: [ground, a], at: [0, 0, 0]}, fb: {free: [ground, b], at: [0.3, 0.05, 0.02]}}
surfaces: {sa: {sphere: a, radius: 0.1}, sb: {sphere: b, radius: 0.12}}
contacts: {hit: {between: [sa, sb], stiffness: 1.0e+6, exponent: 1.5, friction: {kinetic: 0.3, slip_speed: 1.0e-2}}}
initial: {fa.x_rate: 3, fa.omega: [1, 20, -30]}
integrate: {step: 2.0e-5, until: 0.05}
output: {every: 0.05, columns: [momentum.y, momentum.lz]}
DECK
