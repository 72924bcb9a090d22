# C12: a pendulum that leans on a peg: what is closed stays so to round-off, for 100 s.
touching 1e-13 'NR > 1 { see($2) } END { printf "%.2g", worst }' <<'DECK'
fmdsub: 1
gravity: [0, -9.81]
bodies: {rod: {mass: 1, inertia: 1/12, at: [0.5, 0], points: {tip: [0.5, 0]}}}
constraints: {pin: {revolute: [ground, rod], at: [0, 0]}}
surfaces: {floor: {plane: ground, at: [0, 0], normal: [0, 1]}, tip: {point: rod.tip}}
contacts: {c: {between: [tip, floor]}}
integrate: {step: 1.0e-2, until: 100}
output: {every: 0.1, columns: [c.gap]}
DECK
