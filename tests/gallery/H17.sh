# H17: two sliders coupled by stiffness, 10:1, 50000 steps: largest energy over that at the start.
# pair ON STEP LIMIT-OF-YARDSTICKS: H17, H18 and H19 are this deck.
pair() {
    for scheme in subcycle midpoint newmark generalized-alpha miao daniel neal-belytschko; do
        limit=3
        case $scheme in miao|daniel|neal-belytschko) limit=3or-told ;; esac
        row $scheme $limit 'NR == 2 { e = $3 + $4 } NR > 1 { see($3 + $4) } END { printf "%.4g", worst / e }' \
            --set integrate.ratio=10 --set integrate.step=$2 <<DECK
fmdsub: 1
bodies: {cart: {mass: 1, inertia: 1, at: [0, 0]}, rider: {mass: 1, inertia: 1, at: [2, 0]}}
constraints:
  rail: {prismatic: [ground, cart], axis: [1, 0], at: [0, 0]}
  slot: {prismatic: [$1, rider], axis: [1, 0], at: [2, 0]}
forces: {soft: {spring: rail, stiffness: 1}, stiff: {spring: [cart, rider], stiffness: 2500}, weak: {spring: slot, stiffness: 1}}
partition: {fast: [slot]}
initial: {rail.displacement: 0.1, slot.displacement: 0.01}
integrate: {step: 0.01, until: 500}
output: {every: {steps: 10}, columns: [rail.displacement, energy.kinetic, energy.elastic]}
DECK
    done
}
pair ground 0.01
