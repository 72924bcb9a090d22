# bells.sh -- loads of time alone that come and go between steps that a tolerance would choose: they are stopped at.
. tests/tools/lib.sh

# A mass of 1 kg hangs at rest on a spring and a damper until it is pushed.  The reference: rk4 at a twentieth of a bell.
deck() { # EXPRESSION HOW
    cat <<END
fmdsub: 1
bodies: {block: {mass: 1, inertia: 1, at: [0, 0]}}
constraints: {rail: {prismatic: [ground, block], at: [0, 0], axis: [1, 0]}}
forces:
  push: {force: rail, value: "$1"}
  soft: {spring: rail, stiffness: 1, damping: 0.3}
integrate: {$2, until: 4}
output: {every: 4, columns: [block.x, block.vx]}
END
}

case_of() { # NAME EXPRESSION
    deck "$2" "scheme: rk4, step: 5.0e-5" >"$work/fine.yaml"
    "$FMDSUB" run -q "$work/fine.yaml" >"$work/fine" 2>/dev/null
    for how in dopri5:1e-6 dop853:1e-6 radau5:1e-6 radau9:1e-6 rk4:1e-6 newmark:1e-4 midpoint:1e-4 hht:1e-4 subcycle:1e-4; do
        scheme=${how%:*} tolerance=${how#*:}
        deck "$2" "scheme: $scheme, tolerance: $tolerance" >"$work/deck.yaml"
        "$FMDSUB" run -q "$work/deck.yaml" >"$work/run" 2>"$work/err"
        near "bells: $1, $how" "$(tail -n 1 "$work/fine")" "$(tail -n 1 "$work/run")" \
            "$(awk -v t=$tolerance 'BEGIN { print 10 * t }')"
    done
}

case_of "a bell" "1000*exp(-((t - 1.23)/1.0e-3)^2)"
case_of "a flat one that a look may hit" "1000*exp(-((t - 2.308657)/1.0e-3)^4)"
case_of "where cosh overflows" "500/cosh((t - 3.151917)/1.0e-3)^2"
case_of "on a wave" "3*sin(5*t) + 500/(1 + ((t - 1.23)/1.0e-3)^2)"
case_of "once in a period" "500*exp(-((mod(t, 0.7) - 0.3)/1.0e-3)^2)"
case_of "up, and down again" "smooth(t, 1.2, 1.201)*1000 - 1000*smooth(t, 1.202, 1.203)"

# A drive that steps smoothly: the ends of that step, and its middle, show no acceleration to schemes that ask there alone.
cat >"$work/smooth.yaml" <<END
fmdsub: 1
bodies: {s: {mass: 2, inertia: 0.1, at: [0, 0]}, b: {mass: 1, inertia: 0.05, at: [0, 0]}}
constraints: {g: {prismatic: [ground, s], axis: [0, 1]}, j: {prismatic: [s, b], axis: [0, 1]}}
forces: {k: {spring: j, stiffness: 100}}
drives: {lift: {drive: g, value: "smooth(t, 0.3, 0.5)"}}
integrate: {until: 1}
output: {every: 0.5, columns: [j.displacement]}
END
for scheme in midpoint newmark generalized-alpha hht; do
    "$FMDSUB" run -q -s "integrate={scheme: $scheme, tolerance: 1.0e-4, until: 1}" "$work/smooth.yaml" >"$work/out" 2>"$work/err"
    expect "a drive's smooth step, $scheme" -0.893 "$(tail -n 1 "$work/out" | awk -F, '{ printf "%.3f", $2 }')" "$work/err"
done
sed 's/axis: \[0, 1\]}}/axis: [1, 0], friction: 0.3}}/; s/^forces.*/initial: {j.displacement_rate: 30}/; s/j\.disp.*\]/b.vx]/' "$work/smooth.yaml" >"$work/rubs.yaml"
"$FMDSUB" run -q "$work/rubs.yaml" >"$work/out" 2>"$work/err"
expect "a drive's smooth step, and what rubs" 24.375 "$(tail -n 1 "$work/out" | awk -F, '{ printf "%.3f", $2 }')" "$work/err"
