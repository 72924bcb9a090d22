# H11: a pendulum of 0.1 g on one of 10 t, and the other way round: the energy over 10 s.
for masses in 1.0e-4:1.0e+4 1.0e+4:1.0e-4; do
    for scheme in $schemes; do
        row $scheme 1e-6 'NR > 1 { see($2); if ($3 > k) k = $3 } END { printf "%.2g", worst / k }' <<DECK
fmdsub: 1
gravity: [0, -9.81]
bodies: {upper: {mass: ${masses%:*}, at: [0, -1]}, lower: {mass: ${masses#*:}, at: [0, -2]}}
constraints: {pin: {revolute: [ground, upper], at: [0, 0]}, knee: {revolute: [upper, lower], at: [0, -1]}}
initial: {pin.angle: 0.01}
integrate: {step: 1.0e-4, until: 10}
output: {every: 0.1, columns: [energy.residual, energy.kinetic]}
DECK
    done
done
