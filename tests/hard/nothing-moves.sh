# nothing-moves.sh -- a mechanism that stands as drawn, in a bushing that is not loaded, keeps the balance: what round-off
# moves is no work.  So it does a thousand times smaller.
. tests/tools/lib.sh
deck() { # SCALE
    cat <<DECK
fmdsub: 1
parameters: {s: $1}
bodies:
  b0: {mass: 70*s^3, inertia: 4.2*s^5, at: [0.28*s, -1.04*s], points: {p: [0.05*s, -0.77*s]}}
  b1: {mass: 0.025*s^3, inertia: 0.002*s^5, at: [1.07*s, -0.96*s], orient: -0.675, points: {p: [-0.58*s, 0.71*s]}}
constraints:
  j0: {free: [ground, b0]}
  j1: {prismatic: [b0, b1], at: [0.5*s, -0.88*s], axis: [0.9, -0.011]}
  j2: {distance: [[0.97*s, -0.73*s], b1.p]}
forces:
  f0: {bushing: [b0, b1], at: [1.14*s, -0.67*s], axis: [0.858, 0.15], stiffness: [43*s^3, 40*s^3], rotation: 4.3*s^5, damping: [0.14*s^3, 0.14*s^3], axes: second}
integrate: {scheme: subcycle, step: 1.0e-3, ratio: 4, until: 0.5}
DECK
}
for s in 1 1.0e-3 1.0e-6; do
    deck $s >"$work/d.yaml"
    for how in scheme=dopri5,tolerance=1.0e-10 scheme=midpoint scheme=subcycle scheme=newmark; do
        "$FMDSUB" run -q $(echo "$how" | sed 's/^/--set integrate./; s/,/ --set integrate./') "$work/d.yaml" >"$work/out" 2>"$work/err"
        rc=$?
        grep -v W-partition "$work/err" | grep 'fmdsub:' >"$work/said"
        ended "nothing moves: size $s m, $how" 0 $rc "$work/out" "$work/said"
    done
done
