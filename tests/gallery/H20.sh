# H20: a pendulum from 2 rad, 1e5 steps: the error of its energy over that of the first 10 s.
for scheme in $schemes; do
    row $scheme 1.05 'NR > 1 { r = abs($2); if ($1 <= 10) { if (r > a) a = r } else see(r) } END { printf "%.4g", (a > 1e-9 ? worst / a : 1) }' <<'DECK'
fmdsub: 1
gravity: [0, -9.81]
bodies: {bob: {mass: 1, at: [0, -1]}}
constraints: {pin: {revolute: [ground, bob], at: [0, 0]}}
initial: {pin.angle: 2}
integrate: {step: 1.0e-2, until: 1000}
output: {every: {steps: 1}, columns: [energy.residual]}
DECK
done
