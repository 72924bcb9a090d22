# neutral.sh -- static starts of what nothing holds and nothing pushes, beside what is held: it stands as drawn and is told, all
# else is where closed forms, or the same with that motion fixed, have it.  What a push, however small, acts on is no equilibrium.
. tests/tools/lib.sh

run_on='integrate: {scheme: midpoint, step: 1.0e-3, until: 1}'
# stands NAME COORDINATES RECORD: the deck on stdin starts so, and is still there after a second.
stands() {
    stands_name=$1 stands_what=$2 stands_want=$3
    { cat; echo "$run_on"; } >"$work/whole.yaml"
    go "$stands_name" 0 <"$work/whole.yaml"
    told "$stands_name" "^static: nothing holds $stands_what where it stands"
    near "$stands_name: at the start" "0,$stands_want" "$(sed -n 2p "$work/out")" 1e-10
    near "$stands_name: after a second" "1,$stands_want" "$last" 1e-10
}
refused() {
    { cat; echo "$run_on"; } >"$work/deck.yaml"
    refuse 4 'no-equilibrium' run -q "$work/deck.yaml"
}

lift() { printf 'fmdsub: 1\ngravity: [0, -9.81]\nbodies:\n  frame: {mass: 10, inertia: 1, at: [0, 0]}\n  shaft: {mass: 2, inertia: 0.1, at: [%s, 0]}\nconstraints:\n  lift: {prismatic: [ground, frame], at: [0, 0], axis: [0, 1]}\n  bearing: {revolute: [frame, shaft], at: [0.5, 0]}\nforces: {k: {spring: lift, stiffness: %s}}\ninitial: {static: true, bearing.angle: 0.3}\noutput: {every: 1, columns: [lift.displacement, bearing.angle]}\n' $1 $2; }
lift 0.5 1000 | stands "a shaft on a frame on a spring" "'bearing.angle'" "-0.11772,0.3"
lift 0.5 1.0e+10 | stands "the same, the spring hard" "'bearing.angle'" "-1.1772e-8,0.3"
{ lift 0.5001 1000; echo "$run_on"; } >"$work/whole.yaml"
go "a shaft out of balance by 0.1 mm hangs" 0 <"$work/whole.yaml"
near "a shaft out of balance by 0.1 mm hangs" "1,-0.11772,-1.5707963267948966" "$last" 1e-9
expect "a shaft out of balance: nothing is told" "0 wrote" "$(grep -c 'nothing holds' "$work/err") $(wrote "$work/out")"

stands "a disc on a pendulum" "'pin.angle'" "-1.5707963267948966,0.3" <<'DECK'
fmdsub: 1
gravity: [0, -9.81]
bodies: {arm: {mass: 1, inertia: 1/12, at: [0.5, 0]}, disc: {mass: 2, inertia: 0.1, at: [1, 0]}}
constraints: {hinge: {revolute: [ground, arm], at: [0, 0]}, pin: {revolute: [arm, disc], at: [1, 0]}}
initial: {static: true, pin.angle: 0.3}
output: {every: 1, columns: [hinge.angle, pin.angle]}
DECK
stands "a ball joint at the centre of mass" "'ball'" "-0.007848,0.19866933079506124" <<'DECK'
fmdsub: 1
space: 3d
gravity: [0, 0, -9.81]
bodies: {frame: {mass: 3, inertia: [1, 1, 1], at: [0, 0, 0]}, top: {mass: 1, at: [0.2, 0, 0], inertia: [1, 2, 2.5]}}
constraints: {rail: {prismatic: [ground, frame], at: [0, 0, 0], axis: [0, 0, 1]}, ball: {spherical: [frame, top], at: [0.2, 0, 0]}}
forces: {k: {spring: rail, stiffness: 5000}}
initial: {static: true, ball.rotation: {axis: [0, 1, 0], angle: 0.4}}
output: {every: 1, columns: [rail.displacement, top.qy]}
DECK
stands "two discs, a twisted spring between them" "'A.angle'" "0.1,0" <<'DECK'
fmdsub: 1
bodies: {a: {mass: 1, inertia: 0.1, at: [0, 0]}, b: {mass: 3, inertia: 0.3, at: [0, 0]}}
constraints: {A: {revolute: [ground, a], at: [0, 0]}, B: {revolute: [a, b], at: [0, 0]}}
forces: {k: {spring: B, stiffness: 50}}
initial: {static: true, A.angle: 0.1, B.angle: 0.4}
output: {every: 1, columns: [A.angle, B.angle]}
DECK
# The way of a neutral motion may be bent: a pair that floats comes to the length of its spring and turns no further.
stands "two bodies float, a spring between them" "'a_free.angle', 'b_free.angle', 'a_free.y' and 2 more" "2,0.5" <<'DECK'
fmdsub: 1
bodies: {a: {mass: 1, inertia: 0.1, at: [0, 0]}, b: {mass: 3, inertia: 0.2, at: [2, 1]}}
forces: {k: {spring: [a, b], stiffness: 50, rest: 2}}
initial: static
output: {every: 1, columns: [{length: "sqrt((b.x - a.x)^2 + (b.y - a.y)^2)"}, {slope: (b.y - a.y)/(b.x - a.x)}]}
DECK
stands "a four-bar that nothing drives, beside a block" "'p1.angle'" "0,0,0.07" <<'DECK'
fmdsub: 1
bodies: {a: {mass: 1, inertia: 1/12, at: [0, 0.5]}, b: {mass: 1, inertia: 1/6, at: [1, 1.25], orient: "atan2(0.25, 1)"}, c: {mass: 1.5, inertia: 0.3, at: [2, 0.75]}, w: {mass: 2, inertia: 1, at: [5, 0]}}
constraints:
  p0: {revolute: [ground, a], at: [0, 0]}
  p1: {revolute: [a, b], at: [0, 1]}
  p2: {revolute: [b, c], at: [2, 1.5]}
  p3: {revolute: [ground, c], at: [2, 0]}
  rail: {prismatic: [ground, w], at: [5, 0], axis: [1, 0]}
forces: {k: {spring: rail, stiffness: 100}, f: {force: rail, value: 7}}
initial: static
output: {every: 1, columns: [p0.angle, p3.angle, rail.displacement]}
DECK

# A beam on a hub that is free to turn, bent at the start; a small force across its tip that turns with it is held by nothing.
hub() { printf 'fmdsub: 1\nbodies:\n  hub: {mass: 1, inertia: 0.02, at: [0, 0]}\n  arm: {beam: {from: [0, 0], to: [2, 0], elements: 8}, section: {rectangle: [0.02, 0.04]}, material: aluminium, modes: 3, points: {tip: {station: 1}}}\nconstraints: {axle: {revolute: [ground, hub], at: [0, 0]}, clamp: {fixed: [hub, arm], at: [0, 0]}}\nforces: {f: {force: arm.tip, value: [0, %s], frame: body}}\ninitial: {static: true, axle.angle: 0.2, arm.mode1: %s}\noutput: {every: 1, columns: [axle.angle, arm.mode1, arm.mode3]}\n' $1 $2; }
hub 0 0.01 | stands "a beam on a hub that is free" "'axle.angle'" "0.2,0,0"
hub 1.0e-6 0 | refused

# One coordinate: flat, held by a force of third order, pushed by one, or by a small force.
law() { printf 'fmdsub: 1\nbodies: {a: {mass: 1, inertia: 0.1, at: [0, 0]}}\nconstraints: {s: {prismatic: [ground, a], axis: [1, 0]}}\nforces: {f: {force: s, value: "%s"}}\ninitial: static\noutput: {every: 1, columns: [s.displacement]}\n' "$1"; }
law 0 | stands "nothing at all" "'s.displacement'" 0
{ law '-100*s.displacement^3'; echo "$run_on"; } >"$work/whole.yaml"
go "held by its cube" 0 <"$work/whole.yaml"
near "held by its cube" "1,0" "$last" 1e-12
expect "held by its cube: nothing is told" "0 wrote" "$(grep -c 'nothing holds' "$work/err") $(wrote "$work/out")"
for push in '100*s.displacement^3' '100*s.displacement^2' '-100*s.displacement^2' 1.0e-7; do law "$push" | refused; done

# A motor that is stronger than the weight: no balance, and what the search has turned is named.
go "a motor stronger than the weight" 4 -q <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies: {a: {mass: 1, inertia: 0.1, at: [0, -0.5]}, b: {mass: 1, inertia: 0.1, at: [2, 0]}}
constraints: {p: {revolute: [ground, a], at: [0, 0]}, s: {prismatic: [ground, b], axis: [1, 0]}}
forces: {m: {torque: p, value: 4.91}, k: {spring: s, stiffness: 100}}
initial: {static: true}
integrate: {scheme: midpoint, step: 1.0e-3, until: 1}
END
told "a motor stronger than the weight" "the search has moved 'p.angle' by [0-9]* m or rad: look for what should hold it, or for a load"
