# driven-rubs.sh -- joints that rub where drives leave no freedom.  On 2 kg, mu 0.3, it takes 0.3 2 9.81 N times the way: in
# 2 s of 0.5 sin 3t 0.5 (4 + sin 6) m, of 0.5 (1 - cos 3t) 0.5 (3 + cos 6) m; the drive brings that and the change of
# m v^2/2, at any time by m a and what rubs.
. tests/tools/lib.sh

slider() { # VALUE SETTINGS
    cat <<END
fmdsub: 1
gravity: [0, -9.81]
bodies: {s: {mass: 2, inertia: 0.1, at: [0, 0]}}
constraints: {g: {prismatic: [ground, s], axis: [1, 0], friction: 0.3}}
drives: {d: {drive: g, value: "$1"}}
integrate: {until: 2$2}
output: {every: 0.05, columns: [energy.friction, energy.drive, d.force, g.friction, g.displacement_rate, g.displacement_accel]}
END
}

# its force on the body against the rate, -1 or 1 of 5.886 N, at each record; from rest against where it is about to go
by_hand() {
    awk -F, 'NR > 1 { n++; way = $6 ? ($6 > 0) - ($6 < 0) : ($7 > 0) - ($7 < 0); f = -5.886 * way
        if (($5 - f) ^ 2 > 1e-18 || ($4 + f - 2 * $7) ^ 2 > 1e-18) bad = 1 } END { exit bad || n != 41 }' "$work/out" &&
        ok "$1: forces" || not_ok "$1: forces" "not 5.886 N against the rate" "$work/out"
}

while read -r value friction drive; do
    for how in "" ", scheme: midpoint, step: 0.005"; do
        name="a driven slider rubs: $value${how:+ by steps of 5 ms}"
        slider "$value" "$how" >"$work/slider"
        go "$name" 0 <"$work/slider"
        near "$name: works" "$(echo "$last" | cut -d, -f2,3)" "$friction,$drive" 1e-3
        by_hand "$name"
        told "$name" 'estimated error: not known: drives move all'
    done
done <<'END'
0.5*sin(3*t) -10.9496802 10.7740159
0.5*(1-cos(3*t)) -11.6547812 11.8304455
END

slider "0.5*sin(3*t)" ", scheme: midpoint, step: 0.005" >"$work/slider"
go "a driven slider rubs: all of it" 0 <"$work/slider"
whole=$last
"$FMDSUB" run -q --until 1 --final-state "$work/half.json" "$work/slider" >"$work/first" 2>"$work/err"
go "a driven slider rubs: the rest" 0 -s "initial={from: half.json, time: keep}" <"$work/slider"
near "a driven slider rubs: goes on" "$whole" "$last" 1e-12

# Works are the same with a freedom beside them, by steps whose error there is of first order: 0.0018 J.
crank() { # BODY CONSTRAINT
    cat <<END
fmdsub: 1
gravity: [0, -9.81]
bodies:
  crank: {mass: 1, inertia: 0.01, at: [0.1, 0]}
  rod: {mass: 1, inertia: 0.02, at: [0.5, 0]}
  sl: {mass: 2, at: [0.8, 0]}
  $1
constraints:
  A: {revolute: [ground, crank], at: [0, 0], friction: {torque: 0.5}}
  B: {revolute: [crank, rod], at: [0.2, 0]}
  C: {revolute: [rod, sl], at: [0.8, 0]}
  G: {prismatic: [ground, sl], axis: [1, 0], friction: 0.3}
  $2
drives: {d: {drive: A, value: "0.5+6*t"}}
initial: {assemble: true}
integrate: {until: 2, scheme: midpoint, step: 0.002}
output: {every: 0.2, columns: [energy.friction, d.power, A.friction]}
END
}
crank "" "" >"$work/alone"
crank "p: {mass: 1, inertia: 0.1, at: [3, 0]}" "P: {revolute: [ground, p], at: [3, 1]}" >"$work/beside"
go "a driven crank rubs" 0 <"$work/alone"
alone=$last
go "a driven crank rubs beside a pendulum" 0 <"$work/beside"
near "a driven crank rubs: the same beside a pendulum" "$alone" "$last" 3e-3

go "driven, and wedged by its friction" 4 <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies:
  s: {mass: 2, inertia: 0.1, at: [0, 0]}
  r: {mass: 1, inertia: 0.1, at: [0.5, 0.5]}
  w: {mass: 1, inertia: 1, at: [1, 1]}
constraints:
  A: {prismatic: [ground, s], axis: [1, 0], friction: 1.5}
  B: {revolute: [s, r], at: [0, 0]}
  C: {revolute: [r, w], at: [1, 1]}
  W: {prismatic: [ground, w], axis: [0, 1], friction: 1.5}
drives: {d: {drive: A, value: "0.5*sin(3*t)"}}
integrate: {until: 0.5}
output: {every: 0.1, columns: [d.force]}
END
told "driven, and wedged by its friction" E-jam
