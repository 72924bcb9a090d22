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

# A chain closed in space with springs, one of them strained against the others by a tolerance: bushings that do not turn
# push nothing, and its energies are round-off of the strain.
cat >"$work/d.yaml" <<'DECK'
fmdsub: 1
bodies:
  b0: {mass: 0.0265, inertia: [0.004839955018, 0.007169681848, 0.004109554174], at: [0.5592, 0.291, -0.8698], orient: {quaternion: [0.673710025124775, 0.3579084508475366, 0.5804733698619712, 0.284722689189637]}, points: {p: [0.428, -0.463, -0.498]}}
  b1: {mass: 0.018, inertia: [0.002741733, 0.0019391058, 0.001539522], at: [0.4664, 0.4454, -0.547], orient: {quaternion: [0.478728563542099, 0.5595455777860173, 0.450105870997378, 0.5051063390244891]}, points: {p: [0.897, 0.104, -0.03]}}
  b2: {mass: 0.0626, inertia: [0.01445067477, 0.0110024447904, 0.01295577738], at: [0.3902, 0.2485, -0.1442], orient: {quaternion: [0.4144915361710287, 0.8269709775062758, 0.2666025657410743, 0.2706267554126378]}, points: {p: [-0.43, 0.071, 0.224]}}
  b3: {mass: 0.132, inertia: [0.026326318788, 0.03197675712, 0.03061411122], at: [0.3698, 0.9284, -0.7871], orient: {quaternion: [1, 0, 0, 0]}, points: {p: [-0.725, 0.22, -0.456]}}
  b4: {mass: 0.289, inertia: [0.026038358125, 0.023596308125, 0.02606888375], at: [-0.1756, 1.003, -1.26], orient: {quaternion: [1, 0, 0, 0]}, points: {p: [0.174, -0.065, -0.732]}}
  b5: {mass: 0.11, inertia: [0.007946829, 0.005661414, 0.006808131], at: [-0.1622, 0.7575, -0.6169], orient: {quaternion: [1, 0, 0, 0]}, points: {p: [0.548, -0.052, 0.016]}}
constraints:
  j0: {cylindrical: [ground, b0], at: [0.9575, 0.732, -0.636], axis: [-0.436, -0.759, -0.103]}
  j1: {prismatic: [b0, b1], at: [0.1472, 0.2235, -0.9733], axis: [-0.211, -0.47, 0.051]}
  j2: {cylindrical: [b1, b2], at: [0.8284, 0.5544, -0.462], axis: [-0.727, -0.142, -0.382]}
  j3: {prismatic: [b0, b3], at: [0.6407, 0.381, -1.0818], axis: [-0.152, 0.19, 0.902]}
  j4: {universal: [b3, b4], at: [0.0323000000000002, 1.1024, -1.0556], axis: [-0.852, 0.107, 0.004], axis2: [-0.039431, -0.31332, -0.017493]}
  j5: {revolute: [b3, b5], at: [0.4223, 0.7694, -0.7296], axis: [0.712, 0.145, 0.371]}
  j6: {planar: [b2, b5], at: [0.0598000000000003, 0.6879, -0.3907], axis: [-0.102, -0.394, 0.48], axis2: [-0.517914, 0.112182, -0.017974]}
forces:
  f0: {spring: j1, stiffness: 47.5553, damping: 0.110099, cubic: 21.4474}
  f1: {curve: j3, table: [[-1, -7.83976], [-0.2, -0.783976], [0, 0], [0.3, 3.91988]]}
  f2: {curve: j5, table: [[-1, -7.95971], [-0.2, -0.795971], [0, 0], [0.3, 3.97986]]}
  f3: {spring: [b5.p, b3], stiffness: 18.0224, damping: 0.002816, preload: -0.05753}
  f4: {bushing: [b4, b5], at: [-0.2195, 0.7407, -0.7069], axis: [0.409, -0.649, 0.064], stiffness: [11.2211, 11.2211, 6.56434], rotation: [1.12211, 1.12211, 0], damping: [0.1111, 0.1111, 0.1111], axes: first}
partition: {fast: [j4, j5]}
integrate: {scheme: subcycle, step: 0.0003125, ratio: 10, until: 0.5}
DECK
for how in scheme=dopri5,tolerance=1.0e-10 scheme=midpoint scheme=subcycle scheme=newmark; do
    "$FMDSUB" run -q $(echo "$how" | sed 's/^/--set integrate./; s/,/ --set integrate./') "$work/d.yaml" >"$work/out" 2>"$work/err"
    rc=$?
    grep 'fmdsub:' "$work/err" >"$work/said"
    ended "nothing moves: strained by a tolerance, $how" 0 $rc "$work/out" "$work/said"
done
