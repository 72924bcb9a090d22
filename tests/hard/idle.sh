# idle.sh -- turns that move no mass: held still and told once where nothing acts along them, else refused by name.
. tests/tools/lib.sh

# rssr JOINT INERTIA: crank and rocker with a slender rod between them, on a spherical joint and on JOINT
rssr() {
    cat <<END
fmdsub: 1
gravity: [0, 0, -9.81]
parameters: {l: sqrt(1.08)}
bodies:
  crank: {mass: 1, inertia: [0.01, 0.02, 0.02], at: [0, 0.1, 0]}
  rod: {mass: 0.8, $2, at: [0.5, 0.3, 0.1], orient: {x: [1, 0.2, 0.2], z: [-0.2, 0, 1]}}
  rocker: {mass: 1.2, inertia: [0.02, 0.03, 0.04], at: [1, 0.2, 0.1]}
constraints:
  A: {revolute: [ground, crank], at: [0, 0, 0], axis: [1, 0, 0]}
  B: {$1, at: [0, 0.2, 0]}
  C: {spherical: [rod, rocker], at: [1, 0.4, 0.2]}
  D: {revolute: [rocker, ground], at: [1, 0, 0], axis: [0, 1, 0.1]}
initial: {A.angle_rate: 3}
integrate: {scheme: dopri5, tolerance: 1.0e-10, until: 2}
output: {every: 0.5, columns: [A.angle, D.angle, rod.x, rod.y, rod.z, energy.kinetic]}
END
}
rssr "universal: [crank, rod], axis: [0, 1, -1], axis2: [-0.4, 1, 1]" "shape: {rod: l}" >"$work/universal"
go "universal joint for a spherical one" 0 <"$work/universal"
want=$last
rssr "spherical: [crank, rod]" "shape: {rod: l}" >"$work/spherical"
go "slender rod between spherical joints" 0 <"$work/spherical"
told "slender rod between spherical joints" "'rod' about its axis \[1, 0, 0\] can turn without moving any mass.*W-idle"
near "slender rod between spherical joints: as with a universal one" "$want" "$last" 1e-6
expect "slender rod between spherical joints: told once" 1 "$(grep -c W-idle "$work/err")"
for scheme in newmark midpoint subcycle; do
    go "slender rod, $scheme" 0 --set "integrate={scheme: $scheme, step: 1.0e-3, until: 1}" <"$work/spherical"
    one=$last
    go "universal, $scheme" 0 --set "integrate={scheme: $scheme, step: 1.0e-3, until: 1}" <"$work/universal"
    near "slender rod as with a universal joint, $scheme" "$last" "$one" 1e-5
done
"$FMDSUB" check "$work/spherical" 2>/dev/null | awk '/natural frequencies/ { found = 1; if (match($0, /\([0-9.e+-]* 1\/s\)/) && substr($0, RSTART + 1) + 0 > 2) exit 1 } END { exit !found }' &&
    ok "slender rod: no frequency from nothing" || not_ok "slender rod: no frequency from nothing" "check says otherwise"
# The same, driven: the drive turns the rod about its axis, too, at the start and later.
for value in 2*t t^2; do
    for scheme in 'midpoint, step: 1.0e-3' 'radau9, tolerance: 1.0e-9' 'dop853, tolerance: 1.0e-9'; do
        driven() { go "driven slender rod, $1, $value, $scheme" 0 --set 'initial={}' --set "drives={m: {drive: A, value: $value}}" \
            --set "integrate={scheme: $scheme, until: 1}" --columns t,D.angle,rod.x,rod.y,rod.z,rod.ax,rod.az,m.force,energy.kinetic <"$work/$1.moving"; }
        for joint in universal spherical; do sed '/^initial/d' "$work/$joint" >"$work/$joint.moving"; done
        driven universal
        held=$last
        driven spherical
        near "driven slender rod as with a universal joint, $value, $scheme" "$held" "$last" 1e-6
    done
done
rssr "spherical: [crank, rod]" "inertia: [1.0e-12, 0.072, 0.072]" >"$work/deck"
go "rod with next to no inertia about itself" 0 <"$work/deck"
told "rod with next to no inertia about itself" "without moving measurable mass"
near "rod with next to no inertia about itself: as with a universal joint" "$want" "$last" 1e-6

# pendulum INERTIA: a point mass on a spherical joint, drawn askew
pendulum() {
    cat <<END
fmdsub: 1
gravity: [0, 0, -9.81]
bodies: {m: {mass: 3$1, at: [0.6, 0.48, 0.64]}}
constraints: {ball: {spherical: [ground, m], at: [0, 0, 0]}}
initial: {ball.omega: $2}
integrate: {scheme: midpoint, step: 1.0e-3, until: 1}
output: {every: 1, columns: [m.x, m.y, m.z, energy.kinetic]}
END
}
evaluations() { sed -n 's/.* steps.*, \([0-9]*\) slow.*/\1/p' "$work/err"; }
pendulum "" "[0.64, 0, -0.6]" >"$work/deck"
go "point mass on a spherical joint" 0 <"$work/deck"
told "point mass on a spherical joint" "'m' about its axis \[0.6, 0.48, 0.64\] can turn"
want=$last free=$(evaluations)
for inertia in 1.0e-9 1.0e-12 1.0e-16; do
    pendulum ", inertia: [$inertia, $inertia, $inertia]" "[0.64, 0, -0.6]" >"$work/deck"
    go "point mass with an inertia of $inertia" 0 <"$work/deck"
    near "point mass with an inertia of $inertia: as without" "$want" "$last" 1e-6
    [ "$(evaluations)" -le $((free + free / 10)) ] && ok "point mass with an inertia of $inertia: for the same work" ||
        not_ok "point mass with an inertia of $inertia: for the same work" "more than $free evaluations" "$work/err"
done
pendulum ", inertia: [1.0e-9, 1.0e-9, 1.0e-9]" "[0.6, 0.48, 5]" >"$work/deck"
go "an inertia of next to nothing that the deck sets turning" 0 <"$work/deck"
expect "an inertia of next to nothing that the deck sets turning: stays" "1 0" "$(grep -c '^energy balance' "$work/err") $(grep -c W-idle "$work/err")"
pendulum "" "[0.6, 0.48, 5]" >"$work/deck"
go "a rate along the turn" 0 <"$work/deck"
told "a rate along the turn" "its rate at the start, 3.79.* rad/s, is dropped"

# What the arm that carries it gives it is not a rate of the deck's own.
go "a point mass on an arm that turns" 0 <<'END'
fmdsub: 1
gravity: [0, 0, -9.81]
bodies:
  arm: {mass: 1, inertia: [0.1, 0.1, 0.1], at: [0.5, 0, 0]}
  m: {mass: 3, at: [1.3, 0, -0.6]}
constraints:
  post: {revolute: [ground, arm], at: [0, 0, 0], axis: [0, 0, 1]}
  ball: {spherical: [arm, m], at: [1, 0, 0]}
initial: {post.angle_rate: 4}
integrate: {scheme: midpoint, step: 1.0e-3, until: 0.1}
END
expect "a point mass on an arm that turns: held still, and nothing is dropped" "1 0" "$(grep -c 'held still' "$work/err") $(grep -c 'is dropped' "$work/err")" "$work/err"

go "point masses in space, loose" 0 <<'END'
fmdsub: 1
gravity: [0, 0, -9.81]
bodies: {p: {mass: 3, at: [0, 0, 1]}, q: {mass: 1, at: [1, 0, 1]}}
constraints: {f: {free: [ground, p], at: [0, 0, 1]}}
forces: {k: {spring: [p, q], stiffness: 10, rest: 1}}
integrate: {scheme: midpoint, step: 1.0e-2, until: 1}
output: {every: 1, columns: [p.z, q.z]}
END
near "point masses in space, loose: they fall" "1,-3.905,-3.905" "$last" 1e-9

go "a chain of point masses" 0 <<'END'
fmdsub: 1
gravity: [0, 0, -9.81]
bodies:
  p$i: {repeat: {i: [1, 5]}, mass: 0.1, at: [0.1*i, 0.02*i, 0]}
constraints:
  s1: {spherical: [ground, p1], at: [0, 0, 0]}
  s$i: {repeat: {i: [2, 5]}, spherical: ["p$(i-1)", p$i], at: [0.1*(i-1), 0.02*(i-1), 0]}
integrate: {scheme: dopri5, tolerance: 1.0e-9, until: 1}
output: {every: 1, columns: [p5.x, p5.z]}
END
told "a chain of point masses" "and so can 4 more"
x=$last
go "the same of revolutes" 0 <<'END'
fmdsub: 1
gravity: [0, -9.81]
parameters: {l: sqrt(0.0104)}
bodies:
  p$i: {repeat: {i: [1, 5]}, mass: 0.1, at: [l*i, 0]}
constraints:
  s1: {revolute: [ground, p1], at: [0, 0]}
  s$i: {repeat: {i: [2, 5]}, revolute: ["p$(i-1)", p$i], at: [l*(i-1), 0]}
integrate: {scheme: dopri5, tolerance: 1.0e-9, until: 1}
output: {every: 1, columns: [{px: "p5.x*0.9805806756909202"}, p5.y]}
END
near "a chain of point masses: as one of revolutes" "$last" "$x" 1e-6

# plane FORCES: a point mass on a revolute at its centre
plane() {
    cat <<END
fmdsub: 1
gravity: [0, -9.81]
bodies:
  a: {mass: 1, inertia: 0.1, at: [0.5, 0]}
  p: {mass: 3${2:-}, at: [1, 0]}
constraints: {r: {revolute: [ground, a], at: [0, 0]}, s: {revolute: [a, p], at: [1, 0]}}
forces: {$1}
integrate: {scheme: midpoint, step: 1.0e-2, until: 1}
output: {every: 1, columns: [p.x, p.y]}
END
}
plane "" | sed '/^forces/d' >"$work/deck"
go "point mass in the plane" 0 <"$work/deck"
told "point mass in the plane" "'p' can turn without moving any mass: held still"
want=$last
for law in 'spring: s, stiffness: 3' 'spring: s, stiffness: 3, rest: 0.2' 'damper: s, damping: 0.01' 'torque: p, value: 0.1' \
    'torque: p, value: "if(t > 0.5, 1, 0)"' 'torque: s, value: "-s.angle^3"'; do
    plane "k: {$law}" >"$work/deck"
    go "pushed by {$law}" 4 <"$work/deck"
    told "pushed by {$law}" "'p' can turn without moving any mass, and a force"
done
plane "k: {spring: s, stiffness: 3}" ", inertia: 1.0e-9" >"$work/deck"
"$FMDSUB" check "$work/deck" >"$work/out" 2>"$work/err"
grep -q "to 8717 Hz" "$work/out" && ok "a spring on an inertia of next to nothing: its frequency" ||
    not_ok "a spring on an inertia of next to nothing: its frequency" "sqrt(3/1e-9) rad/s is not there" "$work/out"
plane "k: {torque: p, value: \"if(r.angle < -0.7, 1, 0)\"}" >"$work/deck"
go "pushed later, by where the other turns" 5 <"$work/deck"
told "pushed later, by where the other turns" "'p', which can turn without moving any mass, has been set turning"

# A rate at the start that the deck gives to what has an inertia, however small against the scene's, stays.
for rate in 1 100; do
    cat >"$work/deck" <<DECK
fmdsub: 1
bodies:
  a: {mass: 500, inertia: 100, at: [0, 0]}
  b: {mass: 120, inertia: 10, at: [4990, 0]}
constraints: {ja: {free: [ground, a]}, jb: {free: [ground, b]}}
forces: {tether: {spring: [a, b], stiffness: 40, rest: 4900}}
initial: {jb.angle_rate: 0.1, jb.y_rate: $rate}
integrate: {scheme: dopri5, tolerance: 1.0e-8, until: 100}
output: {every: 100, columns: [jb.angle, jb.angle_rate]}
DECK
    go "a satellite that spins five kilometres away, $rate m/s" 0 <"$work/deck"
    near "a satellite that spins five kilometres away, $rate m/s" "$last" 100,10,0.1 1e-9
done
