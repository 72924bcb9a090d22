# H34: a damper that gives is told, one of 1e9 runs; constants of a rule outside what they may be are refused.
for damping in -1 1.0e+9; do
    limit=1e-6 figure='END { printf "%.2g", abs($2) }'
    [ $damping = -1 ] && limit=told figure='must be at least 0'
    row midpoint $limit "$figure" <<DECK
fmdsub: 1
bodies: {car: {mass: 1, at: [0, 0]}}
constraints: {rail: {prismatic: [ground, car], axis: [1, 0]}}
forces: {d: {damper: rail, damping: $damping}}
initial: {rail.displacement_rate: 1.0e-6}
integrate: {step: 1.0e-3, until: 1}
output: {columns: [rail.displacement_rate]}
DECK
done
for set in integrate.gamma=0.4 integrate.beta=0 integrate.beta=0.2; do fall 0.1 1 | row newmark told 'must be\|not stable' --set $set; done
