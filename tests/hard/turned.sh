# turned.sh -- what turns far within a step: an arm that turns freely, of whose turn both ends of a step know nothing, meets a
# peg all the same, by every scheme with a tolerance, whatever the push is made of; and the flap that a driven arm strikes.
. tests/tools/lib.sh

arm() { # FORCE or contact
    cat <<END
fmdsub: 1
bodies: {arm: {mass: 1, inertia: 0.02, at: [0.25, 0], points: {tip: [-0.145, 0]}}}
constraints: {b: {revolute: [ground, arm], at: [0.25, 0]}}
measures: {gap: {distance: [[0, 0], arm.tip]}}
surfaces: {tip: {sphere: arm, at: [0.105, 0], radius: 0.01}, disc: {sphere: ground, at: [0, 0], radius: 0.12},
  cam: {cam: ground, at: [0, 0], table: [[0, 0.12], [1, 0.12], [2, 0.12], [3, 0.12], [4, 0.12], [5, 0.12]]}}
$1
initial: {b.angle: 1.5, b.angle_rate: 12}
integrate: {until: 1.5}
output: {every: 1.5, columns: [b.angle, b.angle_rate]}
END
}
arm 'contacts: {hit: {between: [tip, disc], stiffness: 1.0e+6}}' >"$work/ball"
arm 'contacts: {hit: {between: [tip, cam], stiffness: 1.0e+6}}' >"$work/cam"
arm 'forces: {hit: {unilateral: gap, stiffness: 1.0e+6, from: 0.13, side: below}}' >"$work/stop"
arm 'forces: {hit: {force: gap, value: "if(gap < 0.13, 1.0e+6*(0.13 - gap), 0)"}}' >"$work/if"
arm 'forces: {hit: {curve: gap, rest: 0.13, table: [[-0.1, -1.0e+5], [0, 0], [1, 0]]}}' >"$work/curve"
go "the peg, by short steps" 0 -q --set "integrate={scheme: midpoint, step: 1.0e-5, until: 1.5}" <"$work/ball"
want=$last
for push in ball cam stop if curve; do
    for scheme in auto dop853 radau9 dopri5 newmark rk4 midpoint; do
        wrong=
        for angle in 1.5 2.3 3.1; do
            "$FMDSUB" run -q --set "initial={b.angle: $angle, b.angle_rate: 12}" \
                --set "integrate={scheme: $scheme, tolerance: 1.0e-6, until: $(awk "BEGIN { print 1.5 - ($angle - 1.5)/12 }")}" \
                --set "output.every={steps: 1000000}" "$work/$push" >"$work/out" 2>"$work/err"
            tail -n 1 "$work/out" | awk -F, -v want="$want" '{ split(want, w); d = $2 - w[2]; e = $3 - w[3]
                fine = NF == 3 && d*d < 1e-4 && e*e < 1e-2 } END { exit !fine }' || wrong="$wrong $angle"
        done
        expect "peg by $push, $scheme, from three places" "" "$wrong" "$work/out" "$work/err"
    done
done

# A peg of 1 mm at the end of an arm of 1 m: what goes by on an arc is quicker between two places than it comes near at either.
cat >"$work/thin" <<'END'
fmdsub: 1
bodies: {arm: {mass: 1, inertia: 0.02, at: [0.5, 0], points: {tip: [0.5, 0]}}}
constraints: {b: {revolute: [ground, arm], at: [0, 0]}}
surfaces: {tip: {sphere: arm, at: [1, 0], radius: 0.0005}, peg: {sphere: ground, at: [-1, 0], radius: 0.0005}}
contacts: {hit: {between: [tip, peg], stiffness: 1.0e+9}}
initial: {b.angle_rate: 12}
integrate: {until: 1}
output: {every: 1, columns: [b.angle_rate]}
END
for scheme in auto dop853 radau9 newmark rk4; do
    wrong=
    for angle in 0 0.1 0.2 0.3 0.4 0.5 0.6 0.7 0.8 0.9; do
        "$FMDSUB" run -q --set "initial={b.angle: $angle, b.angle_rate: 12}" --set "integrate={scheme: $scheme, tolerance: 1.0e-6, until: 0.4}" \
            --set output.every=0.4 "$work/thin" >"$work/out" 2>"$work/err"
        tail -n 1 "$work/out" | awk -F, '{ fine = $2 < -11.9 && $2 > -12.1 } END { exit !fine }' || wrong="$wrong $angle"
    done
    expect "a thin peg, $scheme, from ten places" "" "$wrong" "$work/out" "$work/err"
done

# Nothing but the drive moves until the arm is there.
cat >"$work/driven" <<'END'
fmdsub: 1
bodies: {arm: {mass: 1, inertia: 0.02, at: [0.5, 0]}, flap: {mass: 0.1, inertia: 1.0e-3, at: [-1, 0]}}
constraints: {b: {revolute: [ground, arm], at: [0, 0]}, f: {prismatic: [ground, flap], axis: [0, 1]}}
surfaces: {tip: {sphere: arm, at: [1, 0], radius: 0.01}, skin: {sphere: flap, radius: 0.01}}
contacts: {hit: {between: [tip, skin], stiffness: 1.0e+6}}
drives: {turn: {drive: b, value: 12*t}}
integrate: {until: 0.4}
output: {every: 0.4, columns: [f.displacement_rate]}
END
for scheme in auto dop853 radau9 newmark rk4; do
    go "a flap by a driven arm, $scheme" 0 -q --set "integrate={scheme: $scheme, tolerance: 1.0e-6, until: 0.4}" <"$work/driven"
    near "a flap by a driven arm, $scheme" "0.4,-24" "$last" 0.3
done
