# H10: inertias that no body can have are refused by the rule; a rod without inertia about itself spins on.
for inertia in "1, 1, 3" "1, 1, -1" "0, 1, 1"; do
    limit=told figure='no body has this inertia'
    [ "$inertia" = "0, 1, 1" ] && limit=1e-9or-told figure='END { printf "%.2g", abs($2 - 1) }'
    row midpoint $limit "$figure" <<DECK
fmdsub: 1
bodies: {top: {mass: 1, at: [0, 0, 0], inertia: [$inertia]}}
constraints: {float: {free: [ground, top], at: [0, 0, 0]}}
initial: {float.omega: {value: [5, 0, 1], frame: body}}
integrate: {step: 1.0e-3, until: 1}
output: {every: 1, columns: [float.omega_z]}
DECK
done
