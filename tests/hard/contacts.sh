# contacts.sh -- rigid contacts where outsiders broke them: fast, small, driven.
. tests/tools/lib.sh

# 250 impacts a step without loss: the speed stays.
cat >"$work/fast.yaml" <<'END'
fmdsub: 1
bodies: {a: {mass: 1, inertia: 1, at: [0, 0]}}
constraints: {s: {prismatic: [ground, a], axis: [1, 0], range: {lower: -1, upper: 1, hold: {restitution: 1}}}}
initial: {s.displacement_rate: 1000}
integrate: {step: 1, until: 2}
output: {every: 1, columns: [a.vx, s.upper.impacts, s.lower.impacts]}
END
"$FMDSUB" run -q "$work/fast.yaml" >"$work/out" 2>"$work/err"
expect "two stops, 500 impacts a step: speed, impacts" "1000 1000" \
    "$(tail -n 1 "$work/out" | awk -F, '{ v = $2 < 0 ? -$2 : $2; printf "%.9g %d", v, $3 + $4 }')" "$work/out"

# Two discs that would pass through each other between two ends of steps; closed form of the oblique impact.
cat >"$work/pass.yaml" <<'END'
fmdsub: 1
bodies: {a: {mass: 1, inertia: 1, at: [-1, 0]}, b: {mass: 1, inertia: 1, at: [1, 0.05]}}
constraints: {fa: {free: [ground, a], at: [-1, 0]}, fb: {free: [ground, b], at: [1, 0.05]}}
surfaces: {sa: {sphere: a, radius: 0.1}, sb: {sphere: b, radius: 0.1}}
contacts: {c: {between: [sa, sb], restitution: 1}}
initial: {fa.x_rate: 1000, fb.x_rate: -1000}
integrate: {step: 2.0e-3, until: 0.1}
output: {every: 0.1, columns: [a.vx, a.vy, c.impacts]}
END
for step in 2.0e-3 1.25e-2 5.0e-2 1.0e-4; do
    "$FMDSUB" run -q -s integrate.step=$step "$work/pass.yaml" >"$work/out" 2>"$work/err"
    expect "discs that meet within a step of $step s" "-875.000 -484.123 1" \
        "$(tail -n 1 "$work/out" | awk -F, '{ printf "%.3f %.3f %d", $2, $3, $4 }')" "$work/out"
done

# A ball of any size slides, then rolls on at 5/7 of its speed.
cat >"$work/roll.yaml" <<'END'
fmdsub: 1
parameters: {s: 1, m: 4000*s^3, I: 0.4*4000*s^5}
gravity: [0, -9.81]
bodies: {b: {mass: m, inertia: I, at: [0, s]}}
constraints: {f: {free: [ground, b]}}
surfaces: {floor: {plane: ground, at: [0, 0], normal: [0, 1]}, ball: {sphere: b, radius: s}}
contacts: {c: {between: [ball, floor], friction: 0.3}}
initial: {f.x_rate: sqrt(s)}
integrate: {step: 1.0e-3*sqrt(s), until: 2*sqrt(s)}
output: {every: 0.5*sqrt(s), columns: [{part: b.vx/sqrt(s)}]}
END
for s in 1 1.0e-2 1.0e-4 1.0e-6; do
    "$FMDSUB" run -q -s parameters.s=$s "$work/roll.yaml" >"$work/out" 2>"$work/err"
    expect "a ball of $s m: 5/7" 0.714286 "$(tail -n 1 "$work/out" | awk -F, '{ printf "%.6f", $2 }')" "$work/out"
done

# Driven into a plane: nothing gives way, and the run ends where they meet; also beside a body that is free.
cat >"$work/driven.yaml" <<'END'
fmdsub: 1
bodies: {p: {mass: 1, inertia: 1, at: [0, 1]}}
constraints: {sl: {prismatic: [ground, p], axis: [0, 1]}}
surfaces: {floor: {plane: ground, at: [0, 0], normal: [0, 1]}, tip: {point: p}}
contacts: {c: {between: [tip, floor]}}
drives: {d: {drive: sl.displacement, value: "-2*t"}}
integrate: {step: 1.0e-3, until: 1}
output: {every: 0.1, columns: [p.y]}
END
sed 's/^bodies: {/&z: {mass: 1, inertia: 1, at: [5, 5]}, /; s/^constraints: {/&zf: {free: [ground, z], at: [5, 5]}, /' "$work/driven.yaml" >"$work/beside.yaml"
for deck in driven beside; do
    "$FMDSUB" run -q "$work/$deck.yaml" >"$work/out" 2>"$work/err"
    expect "$deck: status" 5 $? "$work/err"
    expect "$deck: where they meet" 1 "$(grep -cE "stopped at t = 0\.(5|499)[0-9]* s.*'c'" "$work/err")" "$work/err"
done

# Stacks of boxes on two feet each: what they weigh is what the floor bears, they stay where they are, masses as they may be.
stack()
{
    awk -v list="$1" -v friction="$2" 'BEGIN {
        n = split(list, m, " ")
        print "fmdsub: 1\ngravity: [0, -9.81]\nbodies:"
        for (i = 1; i <= n; i++)
            printf "  b%d: {mass: %s, inertia: %s*1.25/12, at: [0, %g], points: {l: [-0.5, -0.25], r: [0.5, -0.25]}}\n", i, m[i], m[i], i / 2 - .25
        print "constraints:"
        for (i = 1; i <= n; i++) printf "  f%d: {planar: [ground, b%d]}\n", i, i
        print "surfaces:\n  top0: {plane: ground, at: [0, 0], normal: [0, 1]}"
        for (i = 1; i <= n; i++)
            printf "  top%d: {plane: b%d, at: [0, %g], normal: [0, 1]}\n  feet%d: {points: [b%d.l, b%d.r]}\n", i, i, i / 2, i, i, i
        print "contacts:"
        for (i = 1; i <= n; i++) printf "  c%d: {between: [feet%d, top%d], friction: %s}\n", i, i, i - 1, friction
        print "integrate: {step: 1.0e-3, until: 0.5}\noutput: {every: 0.5, columns: [c1.1.normal, c1.2.normal, b" n ".x, b" n ".y, energy.impact]}"
    }'
}
check_stack()
{
    stack "$1" "$2" >"$work/stack.yaml"
    "$FMDSUB" run -q ${4:-} "$work/stack.yaml" >"$work/out" 2>"$work/err"
    expect "a stack of $1, friction $2" "$3 1 1" "$(tail -n 1 "$work/out" |
        awk -F, '{ printf "%.6g %d %d", $2 + $3, $4 * $4 < 1e-20, $6 < 1e-12 }')" "$work/err"
}
check_stack "1 1 1 1" 0.5 39.24
check_stack "1 1 1 1 1 1 1 1" 0.5 78.48
check_stack "1 100" 0.5 990.81
check_stack "1 100 10000" 0.5 99090.8
check_stack "1 1" 0 19.62 "-s integrate.until=20 -s output.every=20" # without friction nothing holds it but that nothing pushes

# A plate on 5 x 5 points comes down tilted: rattles, and lies flat, in bounded work.
awk 'BEGIN {
    for (i = 0; i < 25; i++) {
        points = points sprintf("%sp%d: [%g, %g, -0.1]", i ? ", " : "", i, int(i / 5) / 4 - .5, i % 5 / 4 - .5)
        names = names sprintf("%sb.p%d", i ? ", " : "", i)
    }
    print "fmdsub: 1\nspace: 3d\ngravity: [0, 0, -9.81]"
    print "bodies: {b: {mass: 1, inertia: [0.1, 0.1, 0.2], at: [0, 0, 0.15], points: {" points "}}}"
    print "constraints: {f: {free: [ground, b]}}"
    print "surfaces: {floor: {plane: ground, at: [0, 0, 0], normal: [0, 0, 1]}, feet: {points: [" names "]}}"
    print "contacts: {c: {between: [feet, floor], restitution: 0.3, friction: 0.3}}"
    print "initial: {f.x_rate: 1, f.omega: [0.5, 0.25, 1]}\nintegrate: {step: 1.0e-3, until: 0.6}"
    print "output: {every: 0.6, columns: [b.z, b.vx, energy.residual]}"
}' >"$work/plate.yaml"
"$FMDSUB" run --stats="$work/stats" "$work/plate.yaml" >"$work/out" 2>"$work/err"
expect "a plate of 25 points comes to rest" "0.100000 1 1" \
    "$(tail -n 1 "$work/out" | awk -F, '{ printf "%.6f %d %d", $2, $3 * $3 < 1e-20, $4 * $4 < 1e-18 }')" "$work/err"
expect "a plate of 25 points: bounded work" 1 "$(awk '$1 == "slow_evaluations" { print $2 < 20000 }' "$work/stats")" "$work/stats"

# A guide that is too short for its load wedges: 0.3 is above 0.2/(2 0.5).
cat >"$work/guide.yaml" <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies: {b: {mass: 2, inertia: 0.1, at: [0, 0.5]}}
constraints: {s: {prismatic: [ground, b], at: [0, 0], axis: [1, 0], friction: {coefficient: 0.3, length: 0.2}}}
initial: {s.displacement_rate: 2}
integrate: {scheme: midpoint, step: 1.0e-3, until: 1}
END
"$FMDSUB" run -q "$work/guide.yaml" >"$work/out" 2>"$work/err"
expect "a guide that wedges" "5 1" "$? $(grep -c "'s' is one of them; friction that presses a joint harder than it slows it wedges it" "$work/err")" "$work/err"

# A floor as an expression runs as it is, also under --strict, and is told that there is a word for it; what is no stop is not.
floor()
{
    cat >"$work/floor.yaml" <<END
fmdsub: 1
gravity: [0, -9.81]
bodies: {b: {mass: 1, inertia: 0.1, at: [0, 0]}}
constraints: {y: {prismatic: [ground, b], axis: [0, 1]}}
forces: {f: {force: y.displacement, value: "$1"}}
initial: {y.displacement: 0.01}
integrate: {scheme: midpoint, step: 1.0e-3, until: 0.01}
END
    "$FMDSUB" run -q --strict "$work/floor.yaml" >"$work/out" 2>"$work/err"
    expect "an expression, $2: $1" "0 said $2" "$? $([ -s "$work/out" ] && echo said) $(grep -c 'hint: .*W-expression-stop' "$work/err")" "$work/err"
}
floor "if(y.displacement < 0, -1e5*y.displacement - 10*y.displacement_rate, 0)" 1
floor "max(0, -1e5*(y.displacement - 0.002))" 1
floor "if(y.displacement > 5, -100*(y.displacement - 5)^3, 0)" 1
floor "-1e5*y.displacement" 0
floor "-10*abs(y.displacement)" 0
floor "if(y.displacement < 0, 1e5*y.displacement, 0)" 0
floor "if(t < 1, 0, -100*y.displacement)" 0
floor "if(y.displacement < 0, -5, 0)" 0

# A ball falls past its edge on a peg, both of 50 mm, struck while it falls ever faster in steps longer than the way through: its
# normal leans by asin(0.2) at y = sqrt(0.0096), and the flight from there, in closed form.
want=$(awk 'BEGIN { g = 9.81; y = sqrt(.0096); v = sqrt(2 * g * (1 - y)); t = .8 - v / g; n = .2; m = y / .1
    printf "%.12g,%.12g", .02 + 2 * v * m * n * t, y + v * (2 * m * m - 1) * t - g * t * t / 2 }')
for peg in 'sphere: ground, at: [0, 0], radius: 0.05' 'cam: ground, at: [0, 0], table: [[0, 0.05], [2, 0.05], [4, 0.05]]'; do
    for how in 'tolerance: 2.0e-3' 'tolerance: 1.0e-3' 'tolerance: 2.0e-4' 'tolerance: 3.0e-5' 'step: 0.8'; do
        go "a peg in the way, ${peg%%:*}, $how" 0 -q <<END
fmdsub: 1
gravity: [0, -9.81]
bodies: {ball: {mass: 1, inertia: 0.004, at: [0.02, 1]}}
surfaces: {peg: {$peg}, skin: {sphere: ball, radius: 0.05}}
contacts: {hit: {between: [skin, peg], restitution: 1}}
integrate: {scheme: midpoint, $how, until: 0.8}
output: {every: 0.8, columns: [ball.x, ball.y]}
END
        near "a peg in the way, ${peg%%:*}, $how: where it is" "0.8,$want" "$last" 1e-9
    done
done

# A block let go by friction under two feet, a start from rest: in closed form 0.09468878551071935, to each tolerance that is asked.
for tolerance in 1e-4 1e-5 1e-6 1e-7 1e-8 1e-9; do
    "$FMDSUB" run -q -s integrate.scheme=midpoint -s integrate.tolerance=$tolerance decks/effect-friction.yaml >"$work/out" 2>"$work/err"
    expect "a block let go, by $tolerance: status, within 10 tolerances" "0 0" \
        "$? $(tail -n 1 "$work/out" | awk -F, -v tol=$tolerance '{ d = $2 / .09468878551071935 - 1; print !(d < 10 * tol && d > -10 * tol) }')" \
        "$work/out" "$work/err"
done

# A pendulum that comes by a peg on its arc within a step, in ways that the ends of the step do not tell.
cat >"$work/arc.yaml" <<'YAML'
fmdsub: 1
parameters: {turn: -1, r: 1.0e-3, off: 0}
gravity: [0, -9.81]
bodies: {arm: {mass: 1, inertia: 0.1, at: [1, 0]}}
constraints: {pin: {revolute: [ground, arm], at: [0, 0]}}
surfaces: {peg: {sphere: ground, at: [(1 + off*r)*cos(turn), (1 + off*r)*sin(turn)], radius: r}, tip: {point: arm}}
contacts: {hit: {between: [tip, peg], restitution: 0.5}}
integrate: {step: 0.1, until: 1.2}
output: {every: 1.2, columns: [hit.impacts]}
YAML
sed 's/{sphere: ground, \(.*\), radius: r}/{cam: ground, \1, table: [[0, r], [2, r], [4, r]]}/' "$work/arc.yaml" >"$work/arc-cam.yaml"
for peg in arc arc-cam; do
    for turn in -0.4 -1.1 -1.6 -2.3; do
        for r in 3.0e-4 1.0e-3 1.0e-2; do
            for how in "0.1 0" "5.0e-2 0.8" "2.0e-2 -0.8"; do
                set -- $how
                "$FMDSUB" run -q -s integrate.step=$1 -s parameters.off=$2 -s parameters.turn=$turn -s parameters.r=$r "$work/$peg.yaml" >"$work/out" 2>"$work/err"
                expect "$peg at $turn, $r m, $2 off its middle, steps of $1: met" "0 1" \
                    "$? $(tail -n 1 "$work/out" | awk -F, '{ print ($2 > 0) }')" "$work/out" "$work/err"
            done
        done
    done
done

# A block that slides one way is hit back by a disc: it slides the other way at once, and sticks once only, at its end.  With
# v = 2 - mu g t and the disc at 2 m/s they meet 0.8 m apart at t1; then (1 + e) 2/3 of their speed is its change.
cat >"$work/hit.yaml" <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies:
  b: {mass: 1, inertia: 0.01, at: [0, 0.1], points: {l: [-0.1, -0.1], r: [0.1, -0.1]}}
  d: {mass: 2, inertia: 0.01, at: [1, 0.1]}
constraints:
  f: {planar: [ground, b], at: [0, 0.1]}
  s: {prismatic: [ground, d], at: [1, 0.1], axis: [1, 0]}
surfaces:
  floor: {plane: ground, at: [0, 0], normal: [0, 1]}
  feet: {points: [b.l, b.r]}
  face: {plane: b, at: [0.1, 0.1], normal: [1, 0]}
  disc: {sphere: d, radius: 0.1}
contacts:
  g: {between: [feet, floor], friction: 0.3}
  k: {between: [disc, face], restitution: 0.6}
initial: {f.x_rate: 2, s.displacement_rate: -2}
integrate: {scheme: midpoint, step: 1.0e-3, until: 1}
output: {every: 0.5, columns: [b.x]}
END
"$FMDSUB" run -q -f ndjson "$work/hit.yaml" >"$work/out"
want=$(awk 'BEGIN { a = .3 * 9.81; t = (4 - sqrt(16 - 2 * a * .8)) / a; v = 2 - a * t; u = v - 1.6 * 2 / 3 * (v + 2)
    printf "%.9f 2 %.9f", t - u / a, 2 * t - a * t * t / 2 - u * u / (2 * a) }')
expect "a sliding block is hit back: when its two feet stick, how often, where" "$want" \
    "$(awk -F'[:,]' '/"sticks"/ { n++; t = $4 } /"slips"/ { n += 100 } END { printf "%.9f %d", t, n }' "$work/out") $(
        "$FMDSUB" run -q "$work/hit.yaml" | tail -n 1 | awk -F, '{ printf "%.9f", $2 }')"

# Sub-cycling saves nothing in major steps near contacts, and says in how many: what hangs above the floor never, what lies on it always.
for at in 1 0; do
    cat >"$work/near.yaml" <<END
fmdsub: 1
gravity: [0, -9.81]
bodies:
  a: {mass: 1, inertia: 0.1, at: [0, $at]}
  b: {mass: 1, inertia: 0.1, at: [5, 0]}
constraints:
  s: {prismatic: [ground, a], at: [0, $at], axis: [0, 1]}
  t: {revolute: [ground, b], at: [5, 0]}
surfaces: {floor: {plane: ground, at: [0, 0], normal: [0, 1]}, foot: {point: a}}
contacts: {c: {between: [foot, floor]}}
forces: {k: {spring: t, stiffness: 1.0e+4}}
initial: {t.angle: 0.01}
partition: {fast: [t]}
integrate: {scheme: subcycle, step: 1.0e-3, ratio: 10, until: 0.1}
output: {every: 0.1, columns: [a.y]}
END
    "$FMDSUB" run "$work/near.yaml" >"$work/out" 2>"$work/err"
    expect "near contacts all takes the minor step: at $at m" "wrote $([ $at = 1 ] && echo 0 || echo "in 10 of the 10")" \
        "$(wrote "$work/out") $(grep -o 'in 10 of the 10' "$work/err" || grep -c 'took the minor step:' "$work/err")" "$work/err"
done
