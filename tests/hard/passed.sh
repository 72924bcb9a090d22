# passed.sh -- what is met and left again within a step: compliant contacts by every scheme with a tolerance, by default, and
# at fixed steps.
. tests/tools/lib.sh

cat >"$work/peg" <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies: {ball: {mass: 1, inertia: 0.004, at: [0.02, 1]}}
surfaces: {peg: {cam: ground, at: [0, 0], table: [[0, 0.05], [2, 0.05], [4, 0.05]]}, skin: {sphere: ball, radius: 0.05}}
contacts: {hit: {between: [skin, peg], stiffness: 1.0e+6}}
integrate: {until: 0.8}
output: {every: 0.8, columns: [ball.x, ball.y]}
END
# Of two equal balls that meet head on the first stops and the second goes on.
cat >"$work/balls" <<'END'
fmdsub: 1
bodies: {a: {mass: 1, inertia: 0.004, at: [0, 0]}, b: {mass: 1, inertia: 0.004, at: [3, 0]}}
surfaces: {sa: {sphere: a, radius: 0.05}, sb: {sphere: b, radius: 0.05}}
contacts: {hit: {between: [sa, sb], stiffness: 1.0e+5}}
constraints: {fa: {planar: [ground, a]}, fb: {planar: [ground, b]}}
initial: {fa.x_rate: 10}
integrate: {until: 1}
output: {every: 1, columns: [a.vx, b.vx]}
END
# A pendulum that swings onto a peg; one in a loop, a parallelogram, whose coupler comes down on it.
cat >"$work/arm" <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies: {arm: {mass: 1, inertia: 0.1, at: [1, 0]}}
constraints: {pin: {revolute: [ground, arm], at: [0, 0]}}
surfaces: {peg: {sphere: ground, at: [0, -1.1], radius: 0.02}, skin: {sphere: arm, radius: 0.09}}
contacts: {hit: {between: [skin, peg], stiffness: 1.0e+3, damping: 20}}
integrate: {until: 3}
output: {every: 3, columns: [pin.angle, pin.angle_rate]}
END
cat >"$work/loop" <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies:
  left: {mass: 1, inertia: 0.1, at: [0.5, 0]}
  right: {mass: 1, inertia: 0.1, at: [2.5, 0]}
  bar: {mass: 1, inertia: 0.1, at: [2, 0]}
constraints:
  a: {revolute: [ground, left], at: [0, 0]}
  b: {revolute: [left, bar], at: [1, 0]}
  c: {revolute: [bar, right], at: [3, 0]}
  d: {revolute: [ground, right], at: [2, 0]}
surfaces: {peg: {sphere: ground, at: [1, -1.1], radius: 0.02}, skin: {sphere: bar, at: [2, 0], radius: 0.09}}
contacts: {hit: {between: [skin, peg], stiffness: 1.0e+4}}
initial: {a.angle: -0.1, assemble: true}
integrate: {until: 1.5}
output: {every: 1.5, columns: [a.angle, a.angle_rate]}
END
# limit SCHEME TOLERANCE: by how much they may differ; hht is the least accurate.
while read -r deck until want limits; do
    set -- $limits
    go "$deck, no scheme" 0 -q <"$work/$deck"
    near "$deck, no scheme" "$until,$want" "$last" "$1"
    for scheme in dopri5 dop853 radau5 radau9 newmark midpoint generalized-alpha hht rk4; do
        for tolerance in 1.0e-4:$2 1.0e-6:$3; do
            go "$deck, $scheme to ${tolerance%:*}" 0 -q --set "integrate={scheme: $scheme, tolerance: ${tolerance%:*}, until: $until}" <"$work/$deck"
            near "$deck, $scheme to ${tolerance%:*}" "$until,$want" "$last" "${tolerance#*:}"
        done
    done
done <<'END'
peg 0.8 0.671463523,0.839361360 1e-4 1e-3 1e-6
balls 1 0,10 5e-3 1e-2 1e-5
arm 3 -1.24898568,-3.97998618 2e-3 0.1 2e-5
END
go "in a loop" 0 -q --set "integrate={scheme: midpoint, step: 2.0e-5, until: 1.5}" <"$work/loop"
want=$last
for scheme in auto dopri5 radau5 midpoint; do
    go "in a loop, $scheme" 0 -q --set "integrate={scheme: $scheme, tolerance: 1.0e-6, until: 1.5}" <"$work/loop"
    near "in a loop, $scheme" "$want" "$last" 1e-4
done

# At fixed steps, long ones: whatever the scheme makes of the touch itself, balls do not go through each other in silence, and
# one that keeps momentum and energy has the velocities right.
sed 's/^output: .*/output: {every: 0.9, columns: [{share: a.vx\/v}]}/; s/^initial: .*/initial: {fa.x_rate: v}/
    /^fmdsub/a parameters: {v: 10}' "$work/balls" >"$work/long"
for scheme in midpoint newmark generalized-alpha hht rk4 subcycle; do
    for step in 0.1 3.0e-2 1.0e-2; do
        for v in 7.13 10 10.37 12.77; do
            "$FMDSUB" run -q --set parameters.v=$v --set "integrate={scheme: $scheme, step: $step, until: 0.9}" "$work/long" >"$work/out" 2>"$work/err"
            rc=$?
            got=$(tail -n 1 "$work/out" | awk -F, -v rc=$rc '{ print rc == 1 || (NF == 2 && $2 < 0.05 && $2 > -0.05) ? "right or told" : "through: " $2 }')
            expect "balls at $v m/s, $scheme, steps of $step" "right or told" "$got" "$work/err"
            case $scheme in midpoint | newmark | subcycle) expect "balls at $v m/s, $scheme, steps of $step: status" "0 wrote" "$rc $(wrote "$work/out")" "$work/err" ;; esac
        done
    done
done
# Of two rates, by minor steps that see it and by some that do not.
for ratio in 3 10 30; do
    "$FMDSUB" run -q --set "integrate={scheme: subcycle, step: 3.0e-3, ratio: $ratio, until: 0.9}" "$work/long" >"$work/out" 2>"$work/err"
    near "balls, subcycle, $ratio minor steps" 0.9,0 "$(tail -n 1 "$work/out")" 1e-9
done
# A coupler that comes down on a peg within a step.
for step in 5.0e-2 2.0e-2; do
    go "in a loop, steps of $step" 0 -q --set "integrate={scheme: midpoint, step: $step, until: 1.5}" <"$work/loop"
    near "in a loop, steps of $step" "$want" "$last" 0.01
done
