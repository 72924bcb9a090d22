# C05: three blocks on a floor, pulled through springs: places at 4 s beside an event-driven solution to 1e-11.
for case in "4.0e-3 5e-5" "2.0e-3 1.3e-5" "1.0e-3 3.1e-6"; do
    set -- $case
    touching $2 'END { see($2 - 0.3523019555023); see($3 - 0.3204925942615); see($4 - 0.3027829510615); printf "%.2g", (NF == 4 ? worst : 9) }' --set integrate.step=$1 <<'DECK'
fmdsub: 1
gravity: [0, -9.81]
bodies: {a: {mass: 1, inertia: 0.1, at: [0, 0]}, b: {mass: 1, inertia: 0.1, at: [-1, 0]}, c: {mass: 1, inertia: 0.1, at: [-2, 0]}}
constraints: {fa: {planar: [ground, a], at: [0, 0]}, fb: {planar: [ground, b], at: [-1, 0]}, fc: {planar: [ground, c], at: [-2, 0]}}
surfaces: {floor: {plane: ground, at: [0, 0], normal: [0, 1]}, ta: {point: a}, tb: {point: b}, tc: {point: c}}
forces:
  pull: {force: fa.x, value: 200*(0.1*t - fa.x)}
  ab: {force: fa.x, value: -200*(fa.x - fb.x)}
  ba: {force: fb.x, value: 200*(fa.x - fb.x)}
  bc: {force: fb.x, value: -200*(fb.x - fc.x)}
  cb: {force: fc.x, value: 200*(fb.x - fc.x)}
contacts: {ca: {between: [ta, floor], friction: 0.3}, cb: {between: [tb, floor], friction: 0.3}, cc: {between: [tc, floor], friction: 0.3}}
integrate: {step: 1.0e-3, until: 4}
output: {every: 4, columns: [fa.x, fb.x, fc.x]}
DECK
done
