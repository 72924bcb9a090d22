# H15: a free body near the turn about its middle axis, which it leaves and comes back to: the energy.
for scheme in $schemes; do
    limit=1e-9
    case $scheme in newmark|generalized-alpha|miao) limit=1e-5 ;; esac # of second order: it does not keep the energy
    row $scheme $limit 'NR > 1 { see($2 / $3) } END { printf "%.2g", worst }' <<'DECK'
fmdsub: 1
bodies: {top: {mass: 1, at: [0, 0, 0], inertia: [1, 2, 3]}}
constraints: {float: {free: [ground, top], at: [0, 0, 0]}}
initial: {float.omega: {value: [1.0e-4, 10, 1.0e-4], frame: body}}
integrate: {step: 1.0e-3, until: 20}
output: {every: 0.1, columns: [energy.residual, energy.kinetic]}
DECK
done
# The period of its tumbling, 4 K/(lambda), in which omega comes back: 8.6967278135 s.
for scheme in dop853 radau9; do
    row $scheme 1e-4 'END { printf "%.2g", abs($2 - 1e-4) + abs($3 - 10) }' --set integrate='{tolerance: 1.0e-13, until: 8.6967278135}' --set output.every=8.6967278135 <<'DECK'
fmdsub: 1
bodies: {top: {mass: 1, at: [0, 0, 0], inertia: [1, 2, 3]}}
constraints: {float: {free: [ground, top], at: [0, 0, 0]}}
initial: {float.omega: {value: [1.0e-4, 10, 1.0e-4], frame: body}}
output: {columns: [float.omega_x, float.omega_y]}
DECK
done
