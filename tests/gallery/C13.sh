# C13: a body driven into a floor: nothing gives way, and that is told where they meet, at 0.5 s.
touching told "stopped at t = 0\.\(5\|499\).*'c'" <<'DECK'
fmdsub: 1
bodies: {p: {mass: 1, inertia: 1, at: [0, 1]}}
constraints: {sl: {prismatic: [ground, p], axis: [0, 1]}}
surfaces: {floor: {plane: ground, at: [0, 0], normal: [0, 1]}, tip: {point: p}}
contacts: {c: {between: [tip, floor]}}
drives: {d: {drive: sl.displacement, value: "-2*t"}}
integrate: {step: 1.0e-3, until: 1}
output: {every: 0.1, columns: [p.y]}
DECK
