# C14: stacks of two to eight boxes on a floor, with friction: they stand for 1 s.
for boxes in 2 4 8; do
    touching 1e-6 'NR > 1 { see($2 - 0.1 * (2 * '$boxes' - 1)); see($3) } END { printf "%.2g", worst }' --set parameters.N=$boxes <<'DECK'
fmdsub: 1
parameters: {N: 2}
gravity: [0, -9.81]
bodies:
  b$i: {repeat: {i: [1, N]}, mass: 1, inertia: 0.2^2/6, at: [0, 0.2*i - 0.1], points: {a: [-0.1, -0.1], b: [0.1, -0.1]}}
constraints:
  f$i: {repeat: {i: [1, N]}, planar: [ground, b$i]}
surfaces:
  top0: {plane: ground, at: [0, 0], normal: [0, 1]}
  top$i: {repeat: {i: [1, N]}, plane: b$i, at: [0, 0.2*i], normal: [0, 1]}
  feet$i: {repeat: {i: [1, N]}, points: [b$i.a, b$i.b]}
contacts:
  c$i: {repeat: {i: [1, N]}, between: [feet$i, top$(i-1)], friction: 0.5}
integrate: {step: 1.0e-3, until: 1}
output: {every: 0.1, columns: [b$(N).y, b$(N).x]}
DECK
done
