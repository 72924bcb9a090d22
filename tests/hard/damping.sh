# damping.sh -- a beam's damping is its own: no matter in which order a deck tells its joints and bodies.
. tests/tools/lib.sh

arm() { # ROOT-STATION
    cat <<END
fmdsub: 1
bodies:
  arm:
    beam: {$1, elements: 12}
    section: {rectangle: [0.02, 0.01]}
    material: steel
    modes: 3
    damping: {ratio: 0.05}
  load: {mass: 0.1, inertia: 1.0e-4, at: [1, 0]}
constraints:
  root: {fixed: [ground, arm], at: [0, 0]}
  tip: {revolute: [arm, load], at: [1, 0]}
integrate: {scheme: newmark, step: 1.0e-3, until: 0.1}
END
}
# turned FILE: its joints told the other way round.
turned() { awk '/^  tip:/ { print; print root; next } /^  root:/ { root = $0; next } { print }' "$1"; }
# ratios FILE: omega and damping of the modes.
ratios() { "$FMDSUB" modes "$1" 2>>"$work/err" | cut -d , -f 3,4; }
: >"$work/err"
for axis in 'from: [0, 0], to: [1, 0]' 'from: [1, 0], to: [0, 0]'; do
    arm "$axis" >"$work/arm.yaml"
    turned "$work/arm.yaml" >"$work/turned.yaml"
    ratios "$work/arm.yaml" >"$work/a"
    ratios "$work/turned.yaml" >"$work/b"
    same "damping ratios, joints in both orders: $axis" "$work/a" "$work/b"
    # The tip's mass makes the modes others than those in which the ratio is given.
    awk -F , 'NR > 2 && NR < 6 && ($2 < .04 || $2 > .05) { exit 1 } END { exit NR < 6 }' "$work/a" &&
        ok "damping ratios near what is given: $axis" || not_ok "damping ratios near what is given: $axis" "omega, damping:" "$work/a" "$work/err"
done

# A coupler of a loop, of which either joint may come first.
cat >"$work/arm.yaml" <<'END'
fmdsub: 1
bodies:
  crank: {mass: 1, inertia: 0.01, at: [0, 0.1]}
  rod:
    beam: {from: [0, 0.2], to: [0.8, 0.2], elements: 8}
    section: {rectangle: [0.02, 0.01]}
    material: steel
    modes: 2
    damping: {ratio: 0.05}
  slider: {mass: 1, at: [0.8, 0.2]}
constraints:
  shaft: {revolute: [ground, crank], at: [0, 0]}
  root: {revolute: [crank, rod], at: [0, 0.2]}
  tip: {revolute: [rod, slider], at: [0.8, 0.2]}
  rail: {prismatic: [ground, slider], at: [0.8, 0.2], axis: [1, 0]}
integrate: {scheme: newmark, step: 1.0e-3, until: 0.1}
END
turned "$work/arm.yaml" >"$work/turned.yaml"
ratios "$work/arm.yaml" >"$work/a"
ratios "$work/turned.yaml" >"$work/b"
paste -d , "$work/a" "$work/b" | awk -F , 'NR > 1 && ($1 - $3)^2 + ($2 - $4)^2 * 1e6 > 1e-8 * (1 + $1 * $1) { exit 1 } END { exit NR < 4 }' &&
    ok "damping ratios of a coupler, joints in both orders" || not_ok "damping ratios of a coupler, joints in both orders" "omega, damping:" "$work/a" "$work/b" "$work/err"

# In segments a ratio is of each piece, and is told; beta is the material's.
for n in 1 4; do
    arm 'from: [0, 0], to: [1, 0]' | sed "s/ratio: 0.05/beta: 2*0.05\/46.8/; s/modes: 3/modes: 3\n    segments: $n/" >"$work/arm.yaml"
    ratios "$work/arm.yaml" | sed -n 3p >"$work/$n"
done
near "beta, in one piece and in four" "$(cat "$work/1")" "$(cat "$work/4")" 0.01
for what in ratio alpha; do
    arm 'from: [0, 0], to: [1, 0]' | sed "s/ratio:/$what:/; s/modes: 3/modes: 3\n    segments: 4/" >"$work/arm.yaml"
    "$FMDSUB" check "$work/arm.yaml" >"$work/out" 2>"$work/said"
    expect "$what in segments is told" 1 "$(grep -c "damping by '$what' is that of each of its 4 segments.*W-damping" "$work/said")" "$work/said"
done

# rho_infinity: what a step leaves of what it does not resolve, and what it takes is booked; schemes without it refuse it.
vibration() { # INTEGRATE
    cat >"$work/vibration.yaml" <<END
fmdsub: 1
bodies: {a: {mass: 1, inertia: 0.1, at: [0, 0]}, b: {mass: 2, inertia: 0.2, at: [1, 0]}}
constraints: {j: {prismatic: [ground, a], axis: [1, 0]}, k: {prismatic: [a, b], axis: [1, 0]}}
forces: {s: {spring: k.displacement, stiffness: 1.0e+5}, t: {spring: j.displacement, stiffness: 100}}
initial: {k.displacement: 0.01}
integrate: {$1, step: 1.0e-2, until: 1}
output: {every: 1, columns: [energy.numerical, energy.residual]}
END
}
for way in "midpoint 0.8" "midpoint 0.3" "newmark 0.8" "newmark 0.3" "generalized-alpha 0.8" "hht 0.6"; do
    vibration "scheme: ${way% *}, rho_infinity: ${way#* }"
    "$FMDSUB" stability --schemes "${way% *}" --steps 1e3 "$work/vibration.yaml" >"$work/out" 2>"$work/err"
    expect "$way: what is left of what is not resolved" "${way#* }" \
        "$(awk -F, -v s="${way% *}" '$1 == s { printf "%.1f", $4; exit }' "$work/out")" "$work/err"
    "$FMDSUB" run -q "$work/vibration.yaml" >"$work/out" 2>"$work/err"
    expect "$way: its loss is booked" "0 1 1" \
        "$? $(tail -n 1 "$work/out" | awk -F, '{ printf "%d %d", ($2 > 0.5), ($3 * $3 < 1e-18) }')" "$work/out"
done
for way in rk4:0.5 "midpoint:0.5, order: 4" "hht:0.3" "hht:1" "newmark:0.8, gamma: 0.6" "newmark:0.8, tolerance: 1.0e-5" dopri5:0.5 miao:0.5; do
    vibration "scheme: ${way%%:*}, rho_infinity: ${way#*:}"
    "$FMDSUB" run -q "$work/vibration.yaml" >"$work/out" 2>"$work/err"
    expect "$way: refused" "3 1" "$? $(grep -cE 'error: .*(rho_infinity|hht leaves).*(E-damping|E-newmark|E-order)' "$work/err")" "$work/err"
done
vibration "scheme: subcycle, rho_infinity: 0.5"
"$FMDSUB" run -q "$work/vibration.yaml" >"$work/out" 2>"$work/err"
expect "subcycle: nothing fast to damp" "0 1" "$? $(grep -c 'nothing is damped' "$work/err")" "$work/err"

# Beside what touches, steps are not damped: refused.
for scheme in midpoint subcycle; do
    cat >"$work/ball.yaml" <<DECK
fmdsub: 1
gravity: [0, -9.81]
bodies: {ball: {mass: 1, at: [0, 1]}}
constraints: {rail: {prismatic: [ground, ball], axis: [0, 1], range: {lower: -1, upper: 10, hold: {restitution: 0.8}}}}
integrate: {scheme: $scheme, step: 1.0e-3, rho_infinity: 0.5, until: 1}
DECK
    "$FMDSUB" run -q "$work/ball.yaml" >"$work/out" 2>"$work/err"
    expect "$scheme, rho_infinity and a stop: refused" "3 1" \
        "$? $(grep -c "error: .rail.lower. is a rigid contact: $scheme takes those without .rho_infinity. only .E-scheme-contact" "$work/err")" "$work/err"
done
