# drawn.sh -- how bodies and forces stand when drawn and what joints say of it: rods by their ends, axes, inertias as given,
# ends of springs that meet, moments of sliding joints.
. tests/tools/lib.sh

# rod BODY: as a pendulum in space, drawn askew
rod() {
    cat <<END
fmdsub: 1
gravity: [0, 0, -9.81]
bodies: {b: {mass: 2, $1}}
constraints: {j: {universal: [ground, b], at: [0, 0, 0], axis: [-2, 1, 0], axis2: [0, 0, 1]}}
integrate: {scheme: midpoint, step: 1.0e-2, until: 1}
output: {every: 1, columns: [b.x, b.y, b.z, energy.kinetic]}
END
}
rod "at: [0.5, 1, 0], orient: {axis: [0, 0, 1], angle: \"atan2(2, 1)\"}, shape: {rod: sqrt(5)}" >"$work/deck"
go "a rod by length and turn" 0 <"$work/deck"
want=$last
for body in "shape: {rod: {from: [0, 0, 0], to: [1, 2, 0]}}" "at: [0.5, 1, 0], orient: {x: [1, 2, 0]}, shape: {rod: sqrt(5)}" \
    "at: [0.5, 1, 0], orient: {x: [-1, -2, 0], z: [0, 0, 1]}, shape: {rod: sqrt(5)}"; do
    rod "$body" >"$work/deck"
    go "a rod, {$body}" 0 <"$work/deck"
    near "a rod, {$body}: as by length and turn" "$want" "$last" 1e-12
done
go "a rod by its ends in the plane" 0 <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies: {b: {mass: 2, shape: {rod: {from: [0, 0], to: [0.6, -0.8]}}, points: {tip: [0.5, 0]}}}
constraints: {j: {revolute: [ground, b], at: [0, 0]}}
integrate: {scheme: midpoint, step: 1.0e-2, until: 0.01}
output: {every: 0.01, columns: [b.tip.x, j.angle_accel]}
END
near "a rod by its ends in the plane: 3 g cos/(2 l)" "0,0.6,-8.829" "$(sed -n 2p "$work/out")" 1e-12

for second in "[ground, a]" "[a, ground]"; do
    for joint in "p: {prismatic: $second, at: [0.2, 0, 0], axis: [1, 0, 0]}" \
        "f: {free: [ground, a], at: [1, 0.3, 0]}, p: {prismatic: $second, at: [0.2, 0, 0], axis: [1, 0, 0], loop: true}"; do
        cat >"$work/deck" <<END
fmdsub: 1
gravity: [0, 0, -9.81]
bodies: {a: {mass: 2, inertia: [0.1, 0.2, 0.3], at: [1, 0.3, 0]}}
constraints: {$joint}
forces: {k: {force: a, value: [1, 2, 3]}}
integrate: {scheme: midpoint, step: 1.0e-2, until: 1}
output: {every: 1, columns: [p.fy, p.fz, p.mx, p.my, p.mz]}
END
        go "moment of a sliding joint, $second" 0 <"$work/deck"
        # the weight less 3 N acts at (0.8, 0.3, 0) from the joint's point on the body, and 0.25 m farther from the ground's
        case $second in
        "[ground, a]") near "moment of a sliding joint, $second" "1,-2,16.62,4.986,-13.296,-1.6" "$last" 1e-10 ;;
        *) near "moment of a sliding joint, $second" "1,2,-16.62,-4.986,17.451,2.1" "$last" 1e-10 ;;
        esac
    done
done

# pass SCHEME: a spring that is pressed through nothing; the law makes no energy
pass() {
    cat <<END
fmdsub: 1
bodies: {a: {mass: 1, at: [1, 0]}}
constraints: {p: {prismatic: [ground, a], axis: [1, 0]}}
forces: {k: {spring: [[0, 0], a], stiffness: 100, rest: 0.5}}
initial: {p.displacement_rate: -3}
integrate: {scheme: $1, step: 1.0e-3, until: 0.4}
output: {every: 0.4, columns: [a.x, energy.residual]}
END
}
for scheme in midpoint newmark subcycle; do
    pass $scheme >"$work/deck"
    go "ends that pass through each other, $scheme" 0 -f ndjson <"$work/deck"
    told "ends that pass through each other, $scheme" '"event".*the ends of force .k. have passed through each other'
    expect "ends that pass through each other, $scheme: once" 1 "$(grep -c '"event"' "$work/out")"
done
go "a spring that turns round" 0 -f ndjson <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies: {a: {mass: 1, at: [1, 0]}}
forces: {k: {spring: [[0, 0], a], stiffness: 100, rest: 1}}
integrate: {scheme: dopri5, tolerance: 1.0e-8, until: 4}
output: {every: 0.5, columns: [a.x]}
END
expect "a spring that turns round: passes nothing" "1 0" "$(grep -c '"summary"' "$work/out") $(grep -c '"event"' "$work/out")"

go "an inertia that no body has" 0 <<'END'
fmdsub: 1
bodies: {b: {mass: 1, at: [0, 0, 0], inertia: [10, 7, 6, 1, 2, 3], inertia_check: false}, c: {mass: 1, at: [1, 0, 0], inertia: [1, 1, 3], inertia_check: false}}
constraints: {j: {free: [ground, b], at: [0, 0, 0]}, k: {free: [ground, c], at: [1, 0, 0]}}
initial: {k.omega: [0.1, 0, 5]}
integrate: {scheme: midpoint, step: 1.0e-3, until: 1}
output: {every: 1, columns: [k.omega_x, k.omega_y, k.omega_z]}
END
told "an inertia that no body has" "W-inertia"
# Euler's equations of a symmetric body: the rate turns about its axis by (3 - 1) 5 rad/s in body axes
near "an inertia that no body has: as Euler's equations say" "1,-0.0839072,-0.0544021,5" "$last" 1e-4

# A body from a file with one node, in its centre; what is drawn there may miss it by round-off.
cat >"$work/lump.json" <<'END'
{"fmdsub_flex": 1, "modes": 1, "reference": 0, "at": [0, 0, 0], "mass": 1, "xx": [0.08, 0, 0, 0, 0.08, 0, 0, 0, 0.08],
"rot": [0, 0, 0, 0, 0, 0, 0, 0, 0], "f": [0, 0, 0], "xf": [0, 0, 0, 0, 0, 0, 0, 0, 0], "ff": [0, 0, 0, 0, 0, 0, 0, 0, 0.25],
"rpsi": [0, 0, 0], "ppsi": [0], "K": [100], "nodes": [{"name": "middle", "x": [0, 0, 0], "phi": [0, 0, 0], "psi": [0, 0, 0]}],
"stresses": []}
END
go "a place that misses a node by round-off" 0 --strict <<'END'
fmdsub: 1
bodies: {arm: {flexible: lump.json, at: [0.3, 0.1, 0.2]}}
constraints: {f: {free: [ground, arm], at: [3*0.1, 0.1, 2e-1 + 1.0e-14]}}
integrate: {scheme: midpoint, step: 1.0e-2, until: 0.1}
output: {every: 0.1, columns: [f.x]}
END
go "a place that misses a node by more" 0 <<'END'
fmdsub: 1
bodies: {arm: {flexible: lump.json, at: [0.3, 0.1, 0.2]}}
constraints: {f: {free: [ground, arm], at: [0.31, 0.1, 0.2]}}
integrate: {scheme: midpoint, step: 1.0e-2, until: 0.1}
output: {every: 0.1, columns: [f.x]}
END
told "a place that misses a node by more" "W-offset"
