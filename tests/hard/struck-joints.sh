# struck-joints.sh -- impacts that load joints with friction: what the joint bears of the impulse, times its coefficient, is taken
# from what slides there, and what would be turned round by that stays where it is.
. tests/tools/lib.sh

# slide ANGLE COEFFICIENT RESTITUTION [LENGTH OFF]: a disc of 1 kg at 3 m/s meets a slider of 2 kg at an angle to its guide.  The
# impulse p along the normal leaves p sin to the guide, or, where it has a length and the disc meets the slider OFF its middle,
# 2 p OFF/length to its ends if that is more, N p in all:
#     2 V = p (cos - mu N), or 0;   3 - p = V cos - 3 e.
slide() {
    awk -v al="$1" -v mu="$2" -v e="$3" -v l="${4:-0}" -v off="${5:-0}" 'BEGIN {
        c = cos(al); s = sin(al); x = -.4 * c + off * s; y = -.4 * s - off * c
        print "fmdsub: 1\nbodies:\n  s: {mass: 2, inertia: 0.1, at: [0, 0]}"
        printf "  d: {mass: 1, inertia: 0.01, at: [%.15g, %.15g]}\nconstraints:\n", x, y
        printf "  g: {prismatic: [ground, s], at: [0, 0], axis: [1, 0], friction: {coefficient: %g%s}}\n", mu, l ? ", length: " l : ""
        printf "  f: {planar: [ground, d], at: [%.15g, %.15g]}\n", x, y
        printf "surfaces: {face: {plane: s, at: [0, 0], normal: [%.15g, %.15g]}, disc: {sphere: d, radius: 0.1}}\n", -c, -s
        printf "contacts: {k: {between: [disc, face], restitution: %g}}\n", e
        printf "initial: {f.x_rate: %.15g, f.y_rate: %.15g}\n", 3 * c, 3 * s
        print "integrate: {scheme: midpoint, step: 1.0e-3, until: 0.2}\noutput: {every: 0.2, columns: [s.vx, d.vx, d.vy]}"
    }' >"$work/slide.yaml"
    want=$(awk -v al="$1" -v mu="$2" -v e="$3" -v l="${4:-0}" -v off="${5:-0}" 'BEGIN {
        c = cos(al); N = sin(al)
        if (l && 2 * off / l > N) N = 2 * off / l
        a = c - mu * N
        p = a > 0 ? (1 + e) * 3 / (c * a / 2 + 1) : (1 + e) * 3
        printf "%.9f %.9f", (a > 0 ? p * a / 2 : 0), 3 - p + 1e-12 }')
    got=$("$FMDSUB" run -q "$work/slide.yaml" 2>"$work/err" | tail -n 1 |
        awk -F, -v al="$1" '{ v = $3 * cos(al) + $4 * sin(al); printf "%.9f %.9f", ($2 < 0 ? -$2 : $2), v + 1e-12 }')
    expect "a slider struck at $1 rad, friction $2, restitution $3${4:+, guide of $4 m, $5 m off}" "$want" "$got" "$work/err"
}

slide 0.3 0.5 0
slide 0.6 0.5 0.5
slide 1 0.2 0
slide 1 0.6 0.5
slide 1.2 0.5 0.5
slide 1.2 0.2 1
slide 0.4 0.1 0.5 0.3 0.05
slide 0.4 0.1 0.5 0.3 0.2
slide 0.4 0.3 0 0.3 0.4
slide 0.4 0.5 0 0.3 0.4

# rod SPEED ARM COEFFICIENT: a disc of 0.8 kg at 2 m/s, restitution 0.3, meets a rod of 1.5 kg on a pin of radius 5 cm, its centre
# 0.4 m off and 0.05 kg m2 about it, at an arm.  The pin bears Q = 0.6 dw - p, its friction takes 0.05 mu |Q| against where
# the rod then turns:
#     (0.05 + 0.24) dw = p arm - or + 0.05 mu |Q|;   the disc leaves with 0.3 of the speed at which they met.
rod() {
    cat >"$work/rod.yaml" <<END
fmdsub: 1
bodies:
  a: {mass: 1.5, inertia: 0.05, at: [0.4, 0]}
  b: {mass: 0.8, inertia: 0.01, at: [$2, -0.0500001]}
constraints:
  p: {revolute: [ground, a], at: [0, 0], friction: {coefficient: $3, radius: 0.05}}
  f: {planar: [ground, b], at: [$2, -0.0500001]}
surfaces: {low: {plane: a, at: [0.4, 0], normal: [0, -1]}, disc: {sphere: b, radius: 0.05}}
contacts: {k: {between: [disc, low], restitution: 0.3}}
initial: {f.y_rate: 2, p.angle_rate: $1}
integrate: {scheme: midpoint, step: 1.0e-7, until: 3.0e-7}
output: {every: 1.0e-7, columns: [p.angle_rate, b.vy]}
END
    want=$(awk -v w="$1" -v d="$2" -v mu="$3" 'BEGIN {
        for (s = -1; s < 2; s += 2) for (q = -1; q < 2; q += 2) {
            k = (d + s * mu * .05 * q) / (.29 + s * mu * .05 * q * .6)
            p = 1.3 * (2 - w * d) / (k * d + 1 / .8)
            if (p >= 0 && s * (w + k * p) >= 0 && q * (.6 * k - 1) >= 0) printf "%.4f %.4f", w + k * p, 2 - p / .8
        } }')
    expect "a rod turning at $1 rad/s struck at $2 m, friction of its pin $3" "$want" \
        "$("$FMDSUB" run -q "$work/rod.yaml" 2>"$work/err" | tail -n 1 | awk -F, '{ printf "%.4f %.4f", $2, $3 }')" "$work/err"
}

rod 0 0.3 0.3
rod 0 0.9 1
rod -3 0.55 1
rod -3 0.3 0.3
rod -8 0.9 0.3

# Of restitution 1 and a pin that rubs Newton's law would gain energy: the most that gains none is taken, and told.  So next to no
# friction changes next to nothing.  Two arms, the elbow's stop struck at w: rates of the elbow after it over those before.
stop() {
    cat >"$work/stop.yaml" <<END
fmdsub: 1
bodies:
  a: {mass: 1.2, inertia: 0.1, at: [0.5, 0]}
  b: {mass: 0.7, inertia: 0.04, at: [1.4, 0]}
constraints:
  sh: {revolute: [ground, a], at: [0, 0], friction: {coefficient: $1, radius: 0.1}}
  el: {revolute: [a, b], at: [1, 0], range: {upper: 1.0, hold: {restitution: 1}}}
initial: {sh.angle: 1.69, el.angle: 0.469, sh.angle_rate: -0.953, el.angle_rate: 2.868}
integrate: {scheme: midpoint, step: 1.0e-4, until: 0.3}
output: {every: 1.0e-4, columns: [el.angle_rate, energy.impact]}
END
    "$FMDSUB" run "$work/stop.yaml" 2>"$work/err" |
        awk -F, 'NR > 2 && p > 0 && $2 < 0 && !turned { turned = 1; kept = -$2 / p } NR > 1 { p = $2; lost = $3 }
                 END { print (kept > .999 ? "whole" : kept > .9 ? "most" : kept), (lost >= -1e-9 && lost < 1e-2 ? "none gained" : lost) }'
}

expect "an elbow's stop, restitution 1, next to no friction in the shoulder" "whole none gained" "$(stop 1e-9)" "$work/err"
expect "that is told" 1 "$(grep -c '^restitution lowered in 1 of the 1 impacts' "$work/err")" "$work/err"
expect "the same, friction 1" "most none gained" "$(stop 1)" "$work/err"
expect "the same, no friction" "whole none gained" "$(stop 0)" "$work/err"
expect "there nothing is told" "0 1" "$(grep -c '^restitution lowered' "$work/err") $(grep -c '^done at' "$work/err")" "$work/err"
