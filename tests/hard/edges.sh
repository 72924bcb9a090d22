# edges.sh -- forces that bend or jump by the state: expressions with branches, tables.  By tolerance every one is stepped onto: what
# comes out is within a few tolerances, whatever side of it the points of a step are on.
. tests/tools/lib.sh

# worst WANT GOT: the largest difference of a column over its range.
worst() {
    awk -F, 'FNR == 1 { n = NF; next } NR == FNR { for (i = 2; i <= n; i++) { w[FNR, i] = $i; if (FNR == 2 || $i > hi[i]) hi[i] = $i; if (FNR == 2 || $i < lo[i]) lo[i] = $i } next }
        { for (i = 2; i <= n; i++) { d = $i - w[FNR, i]; if (d < 0) d = -d; d /= hi[i] - lo[i]; if (d > most) most = d } }
        END { print (FNR > 10 ? most + 0 : "nothing") }' "$1" "$2"
}

# A mass with play between two springs, as an expression of what the force acts along, of that and the time, as a table, as a
# load on the body, by way of abs and max, and min, and with a comparison of expressions.  Its way in closed form: 2 m/s over
# 0.1 m, half a turn of 100 rad/s.
play() { # FORCE
    cat <<YAML
fmdsub: 1
bodies: {m: {mass: 1, inertia: 1, at: [0, 0]}}
constraints: {r: {prismatic: [ground, m], axis: [1, 0]}}
forces: {a: {$1}}
initial: {r.displacement_rate: 2}
integrate: {until: 1}
output: {every: 0.005, columns: [r.displacement, r.displacement_rate]}
YAML
}
awk 'BEGIN { pi = atan2(0, -1); half = 0.05 + pi/100; print "t,x,v"
    for (i = 0; i <= 200; i++) { t = i*0.005; p = t + 0.025; k = int(p/half); p -= k*half; s = k % 2 ? -1 : 1
        if (p < 0.05) { x = -0.05 + 2*p; v = 2 } else { x = 0.05 + 0.02*sin(100*(p - 0.05)); v = 2*cos(100*(p - 0.05)) }
        printf "%g,%.15g,%.15g\n", t, s*x, s*v } }' >"$work/play.want"
play 'force: r, value: "if(r.displacement > 0.05, -1e4*(r.displacement - 0.05), if(r.displacement < -0.05, -1e4*(r.displacement + 0.05), 0))"' >"$work/play.if"
play 'force: r, value: "if(r.displacement > 0.05 and t > -1, -1e4*(r.displacement - 0.05), if(r.displacement < -0.05, -1e4*(r.displacement + 0.05), 0))"' >"$work/play.time"
play 'curve: r, table: [[-0.1, -500], [-0.05, 0], [0.05, 0], [0.1, 500]]' >"$work/play.table"
play 'force: m, value: ["-1e4*max(abs(r.displacement) - 0.05, 0)*sign(r.displacement)", 0]' >"$work/play.load"
play 'force: r, value: "-1e4*(max(r.displacement, 0.05) + min(r.displacement, -0.05)) + 0*t"' >"$work/play.max"
play 'force: r, value: "if(1e4*r.displacement - 500 > 200*r.displacement - 10 or r.displacement < -0.05, -1e4*(abs(r.displacement) - 0.05)*if(r.displacement > 0, 1, -1), 0) + 0*t"' >"$work/play.sides"
play 'unilateral: r, stiffness: 1.0e+4, from: 0.05}, b: {unilateral: r, stiffness: 1.0e+4, from: -0.05, side: below' >"$work/play.stop"

# A force that jumps, as of a switch: there and back over x = 0.1 in parabolas of 10 m/s^2.
cat >"$work/switch.value" <<'YAML'
fmdsub: 1
bodies: {m: {mass: 1, inertia: 1, at: [0, 0]}}
constraints: {r: {prismatic: [ground, m], axis: [1, 0]}}
forces: {a: {force: r, value: "if(r.displacement > 0.1, -10, 10)"}}
initial: {r.displacement_rate: 2}
integrate: {until: 3}
output: {every: 0.05, columns: [r.displacement, r.displacement_rate]}
YAML
awk 'BEGIN { c = sqrt(4 + 2*10*0.1); t0 = (c - 2)/10; half = 2*c/10; print "t,x,v"
    for (i = 0; i <= 60; i++) { t = i*0.05; p = t - t0 + half; k = int(p/half); p -= k*half; s = k % 2 ? 1 : -1
        printf "%g,%.15g,%.15g\n", t, 0.1 + s*(c*p - 5*p*p), s*(c - 10*p) } }' >"$work/switch.want"

# A spring that pushes from a place on, which every scheme already steps onto, against the same as an expression, in a loop.
bars() { # FORCES
    cat <<YAML
fmdsub: 1
gravity: [0, -9.81]
bodies:
  a: {mass: 1, inertia: 0.1, at: [0, 0.5]}
  b: {mass: 2, inertia: 0.5, at: [1, 1.25]}
  c: {mass: 1, inertia: 0.2, at: [2, 0.75]}
constraints:
  p: {revolute: [ground, a], at: [0, 0]}
  q: {revolute: [a, b], at: [0, 1]}
  r: {revolute: [b, c], at: [2, 1.5]}
  s: {revolute: [ground, c], at: [2, 0]}
forces: {$1}
initial: {p.angle_rate: 2}
integrate: {until: 1}
output: {every: 0.02, columns: [p.angle, s.angle, p.angle_rate, s.angle_rate]}
YAML
}
bars 'u: {unilateral: s, stiffness: 3000, from: 0.2}, l: {unilateral: s, stiffness: 3000, from: -0.2, side: below}' >"$work/bars.reference"
bars 'stop: {torque: s, value: "if(s.angle > 0.2, -3000*(s.angle - 0.2), if(s.angle < -0.2, -3000*(s.angle + 0.2), 0))"}' >"$work/bars.if"

# Others against themselves at 1e-12, where steps are as short as edges ask for: a magnet that is passed within a step, a motor
# with a clipped torque, drag by the square, a damper by a table, a detent by mod and floor.
one() { # NAME FORCE UNTIL INITIAL
    cat >"$work/$1.value" <<YAML
fmdsub: 1
gravity: [0, -9.81]
bodies: {m: {mass: 1, inertia: 0.1, at: [1, 0]}}
constraints: {r: {revolute: [ground, m], at: [0, 0]}}
forces: {a: {$2}}
initial: {$4}
integrate: {until: $3}
output: {every: 0.02, columns: [r.angle, r.angle_rate]}
YAML
}
one magnet 'torque: r, value: "if(abs(r.angle + pi/2) < 0.01, 300, 0)"' 2 'r.angle: 0'
one motor 'torque: r, value: "max(-20, min(20, 200*(2*sin(2*t) - r.angle) - 5*r.angle_rate))"' 3 'r.angle: 0'
one drag 'torque: r, value: "-0.3*abs(r.angle_rate)*r.angle_rate"' 5 'r.angle: 0'
one valve 'curve: r.angle_rate, table: [[-10, -12], [-1, -3], [1, 3], [10, 12]]' 5 'r.angle: 0'
one detent 'torque: r, value: "4*mod(r.angle, 0.5) + 0.5*floor(4*r.angle) - 0.2*r.angle_rate"' 4 'r.angle: 0'

# check NAME DECK WANT SCHEME TOLERANCE MOST: within so many tolerances, and told as such.
check() {
    until=$(sed -n 's/^integrate: {until: \([0-9]*\)}/\1/p' "$2")
    "$FMDSUB" run --set "integrate={scheme: $4, tolerance: $5, until: $until}" "$2" >"$work/out" 2>"$work/err"
    status=$?
    off=$(worst "$3" "$work/out")
    expect "$1, $4 at $5: within $6 tolerances" "0 yes" \
        "$status $(awk -v off="$off" -v tol="$5" -v most="$6" 'BEGIN { print (off != "nothing" && off < most*tol ? "yes" : off) }')" "$work/err"
    told=$(sed -n 's/^estimated error: //p' "$work/err" |
        awk -v off="$off" -v tol="$5" '/^not known/ { print "yes"; next } { print (30*$1 + tol >= off ? "yes" : $1 " of " off) }')
    case "$1/$told" in
        play*/[0-9]*) known "$1, $4 at $5: told" "sums of local errors, as bounces make more of them: $told" ;;
        *) expect "$1, $4 at $5: told" yes "$told" "$work/err" ;;
    esac
}
for deck in play.if play.time play.table play.stop play.load play.max play.sides switch.value bars.if magnet.value motor.value drag.value valve.value detent.value; do
    name=${deck%%.*}
    if [ ! -f "$work/$name.want" ]; then
        source=$work/$deck
        [ -f "$work/$name.reference" ] && source=$work/$name.reference
        until=$(sed -n 's/^integrate: {until: \([0-9]*\)}/\1/p' "$source")
        "$FMDSUB" run -q --set "integrate={scheme: dop853, tolerance: 1.0e-12, until: $until}" "$source" >"$work/$name.want" 2>"$work/err"
    fi
    most=10
    [ $name = play ] && most=30
    for how in "dopri5 1.0e-3" "dopri5 1.0e-5" "dopri5 1.0e-7" "dop853 1.0e-4" "dop853 1.0e-6" "dop853 1.0e-8" "radau5 1.0e-3" \
        "radau5 1.0e-5" "radau5 1.0e-7" "radau9 1.0e-4" "radau9 1.0e-6" "radau9 1.0e-8" "rk4 1.0e-4" "rk4 1.0e-6" "newmark 1.0e-4" \
        "midpoint 1.0e-4" "generalized-alpha 1.0e-4" "hht 1.0e-4"; do
        set -- $how
        case $1 in newmark | midpoint | generalized-alpha | hht) most=30 ;; esac
        check "$deck" "$work/$deck" "$work/$name.want" "$1" "$2" $most
    done
done

# Where the force jumps against both ways there is no way on: the run ends and says which it is, soon.
for how in dopri5 dop853 radau5 radau9 rk4 newmark midpoint; do
    for tolerance in 1.0e-3 1.0e-5 1.0e-8; do
        go "friction as a sign, $how at $tolerance" 7 -q --set "integrate={scheme: $how, tolerance: $tolerance, until: 5}" <<'YAML'
fmdsub: 1
bodies: {m: {mass: 1, inertia: 1, at: [0, 0]}}
constraints: {r: {prismatic: [ground, m], axis: [1, 0]}}
forces: {a: {force: r, value: "-3*sign(r.displacement_rate)"}, k: {spring: r, stiffness: 10}}
initial: {r.displacement_rate: 2}
integrate: {until: 5}
output: {every: 0.05, columns: [r.displacement, r.displacement_rate]}
YAML
        told "friction as a sign, $how at $tolerance" "force 'a' jumps near here, between -*3 and -*3"
    done
done

# Nor is there where stages are on both sides by turns, so that steps agree and are taken, of a hundredth of a nanosecond and less:
# friction that holds a mass on another one that is moved from rest, and a pendulum's pivot.
sled() { # SCHEME TOLERANCE
    go "friction that holds from the start, $1 at $2" 7 -q --set "integrate={scheme: $1, tolerance: $2, until: 5}" <<'YAML'
fmdsub: 1
bodies: {m: {mass: 1, inertia: 1, at: [0, 0]}, n: {mass: 2, inertia: 1, at: [1, 0]}}
constraints: {r: {prismatic: [ground, m], axis: [1, 0]}, u: {prismatic: [m, n], axis: [1, 0]}}
forces: {a: {force: u, value: "-1*sign(u.displacement_rate)"}, k: {spring: u, stiffness: 100}, d: {force: r, value: 2*sin(2*t)}}
integrate: {until: 5}
output: {every: 0.05, columns: [r.displacement, u.displacement_rate]}
YAML
    told "friction that holds from the start, $1 at $2: what to do" "force.* 'a' .*tanh(x/0.01) in place of sign(x)"
}
sled dopri5 1.0e-3
sled dopri5 1.0e-8
sled midpoint 1.0e-5
sled newmark 1.0e-8
sled rk4 1.0e-6
pivot() { # SCHEME TOLERANCE
    go "friction at a pivot, $1 at $2" 7 -q --set "integrate={scheme: $1, tolerance: $2, until: 5}" <<'YAML'
fmdsub: 1
gravity: [0, -9.81]
bodies: {m: {mass: 1, inertia: 1, at: [0, 0]}, p: {mass: 0.3, inertia: 0.01, at: [0, -0.3]}}
constraints: {r: {prismatic: [ground, m], axis: [1, 0]}, j: {revolute: [m, p], at: [0, 0]}}
forces: {a: {force: m, value: ["-3*sign(r.displacement_rate)", 0]}, d: {force: r, value: 5*sin(3*t)}}
initial: {r.displacement_rate: 2}
integrate: {until: 5}
output: {every: 0.05, columns: [r.displacement, r.displacement_rate]}
YAML
    told "friction at a pivot, $1 at $2: what to do" "force 'a' jumps near here, between -*3 and -*3: let it go from one to the other"
}
pivot rk4 1.0e-3
pivot rk4 1.0e-8
pivot dopri5 1.0e-8

# One that is too small to matter may be crossed as often as one likes.
go "a small jump, many times" 0 -q --set "integrate={scheme: dopri5, tolerance: 1.0e-4, until: 1000}" <<'YAML'
fmdsub: 1
bodies: {m: {mass: 1, inertia: 1, at: [0, 0]}}
constraints: {r: {prismatic: [ground, m], axis: [1, 0]}}
forces: {a: {force: r, value: "-1.0e-7*sign(r.displacement_rate)"}, k: {spring: r, stiffness: 100}}
initial: {r.displacement_rate: 2}
integrate: {until: 1000}
output: {every: 100, columns: [r.displacement, r.displacement_rate]}
YAML

# Nor is a run ended that bounces often in steps far shorter than those before.
go "many bounces" 0 -q --set "integrate={scheme: midpoint, tolerance: 1.0e-5, until: 60}" <<'YAML'
fmdsub: 1
bodies: {m: {mass: 1, inertia: 1, at: [0, 0]}}
constraints: {r: {prismatic: [ground, m], axis: [1, 0]}}
forces: {a: {force: r, value: "if(r.displacement > 1, -1e5*(r.displacement - 1) - 10*sign(r.displacement_rate)*0.001, 0) - 0.001*sign(r.displacement_rate)"}, k: {spring: r, stiffness: 1}}
initial: {r.displacement_rate: 2}
integrate: {until: 60}
output: {every: 10, columns: [r.displacement, r.displacement_rate]}
YAML

# A run and its continuation are one, byte for byte, where steps end on records.
cd "$work" || exit 1
for deck in switch.value motor.value magnet.value; do
    part() { "$FMDSUB" run -q --columns '*' --every 0.05 --set "integrate={scheme: dopri5, tolerance: 9.0e-7, until: $2}" ${3-} "$1" 2>err; }
    part $deck 0.8 >whole
    part $deck 0.4 "--final-state half.json" >first
    "$FMDSUB" run -q --columns '*' --every 0.05 --set "integrate={scheme: dopri5, tolerance: 9.0e-7, until: 0.8}" \
        --set "initial={from: half.json, time: keep}" $deck >rest 2>err
    { cat first; sed 1,2d rest; } >both
    same "$deck: goes on from a state" whole both
done

# What grows without bound is no jump: plates that snap together, m x'' = -k x - c x' + b(t)/(g - x)^2.
for how in "tolerance: 1.0e-4" "scheme: newmark, step: 1.0e-4" "scheme: dop853, tolerance: 1.0e-6" "scheme: radau9, tolerance: 1.0e-6" "scheme: midpoint, step: 1.0e-4"; do
    go "plates that snap together, $how" 5 -q --set "integrate={$how, until: 1}" <<'YAML'
fmdsub: 1
bodies: {m: {mass: 1, at: [0, 0]}}
constraints: {r: {prismatic: [ground, m], axis: [1, 0]}}
forces: {k: {spring: r, stiffness: 100}, c: {damper: r, damping: 2}, pull: {force: r, value: "min(10*t, 1)*0.2/(0.1 - r.displacement)^2"}}
integrate: {until: 1}
output: {every: 0.01, columns: [r.displacement]}
YAML
    told "plates that snap together, $how: what it is" "force 'pull' grows without bound.*keep away from 0 what its expression divides by"
done

# A touch whose damper jumps by so much that no step which t can tell is within a tight tolerance: it is gone over.
cat >"$work/pad.yaml" <<'EOF'
fmdsub: 1
gravity: [0, -9.81]
bodies:
  case:  {mass: 0.01, at: [0, 1]}
  proof: {mass: 1.0e-6, at: [0, 1]}
constraints:
  z: {prismatic: [ground, case], axis: [0, 1]}
  p: {prismatic: [case, proof], axis: [0, 1]}
forces:
  pad: {unilateral: z, side: below, from: -1, stiffness: 5.0e+4, damping: 2}
  k: {spring: p, stiffness: 40, damping: 6.0e-4}
integrate: {scheme: radau9, tolerance: 1.0e-6, until: 0.8}
output: {every: 0.8, columns: [z.displacement]}
EOF
# tight WHAT DECK UNTIL VALUE MOST SCHEME...: the last record at a tolerance of 1e-11 is off by less than MOST.
tight() {
    what=$1 deck=$2 until=$3 value=$4 most=$5
    shift 5
    for scheme; do
        "$FMDSUB" run -q -s "integrate={scheme: $scheme, tolerance: 1.0e-11, until: $until}" "$deck" >"$work/at" 2>"$work/err"
        tail -n 1 "$work/at" | awk -F, -v until="$until" -v value="$value" -v most="$most" \
            '{ d = $2 - value; fine = $1 == until && d < most && -d < most } END { exit !fine }' &&
            ok "edges: $what at 1e-11, $scheme" || not_ok "edges: $what at 1e-11, $scheme" "not $value at $until s" "$work/at" "$work/err"
    done
}
tight "a pad" "$work/pad.yaml" 0.8 -0.25009053225 1e-9 radau5 radau9 dop853 dopri5

# Latches that take hold of panels with a damper, so that their torque jumps: of a trial that is far too long for the motion behind it
# the end does not tell where that is, and trials that end close before it each would be thousands.
cat >"$work/latch.yaml" <<'EOF'
fmdsub: 1
bodies:
  hub: {mass: 200, inertia: 40, at: [0, 0]}
  p1: {mass: 8, inertia: 1.5, at: [0.5, 0.75], orient: pi/2}
  p2: {mass: 8, inertia: 1.5, at: [0.5, 0.8], orient: -pi/2}
constraints:
  fly: {free: [ground, hub]}
  h1: {revolute: [hub, p1], at: [0.5, 0]}
  h2: {revolute: [p1, p2], at: [0.5, 1.5]}
forces:
  s1: {spring: h1, stiffness: 0.8, preload: -2.5, damping: 0.15}
  s2: {spring: h2, stiffness: 0.8, preload: 3.5, damping: 0.15}
  l1: {torque: h1, value: "if(h1.angle < -pi/2, -3.0e+4*(h1.angle + pi/2) - 60*h1.angle_rate, 0)"}
  l2: {torque: h2, value: "if(h2.angle > pi, -3.0e+4*(h2.angle - pi) - 60*h2.angle_rate, 0)"}
integrate: {tolerance: 1.0e-3, until: 12}
output: {every: 0.05, columns: [h1.angle, h2.angle]}
EOF
for how in auto dop853; do
    "$FMDSUB" run -q -s "integrate.scheme=$how" --stats="$work/stats" "$work/latch.yaml" >"$work/at" 2>"$work/err"
    awk '$1 == "rejected" { n = $2 } END { exit !(n > 0 && n < 400) }' "$work/stats" && ok "edges: latches cost few trials, $how" ||
        not_ok "edges: latches cost few trials, $how" "$(grep rejected "$work/stats")" "$work/err"
done

# Two balls that strike each other with a damper, whose push jumps where they touch: steps that an edge has cut short do not foretell
# ones that t cannot tell.
cat >"$work/balls.yaml" <<'EOF'
fmdsub: 1
gravity: [0, -9.81]
bodies:
  a: {mass: 1, inertia: 4.0e-4, at: [-0.05, -1]}
  b: {mass: 1.5, inertia: 6.0e-4, at: [0.05, -1]}
constraints:
  pa: {revolute: [ground, a], at: [-0.05, 0]}
  pb: {revolute: [ground, b], at: [0.05, 0]}
surfaces:
  ba: {sphere: a, radius: 0.05}
  bb: {sphere: b, radius: 0.05}
contacts:
  hit: {between: [ba, bb], stiffness: 1.0e+8, exponent: 1.5, damping: 100}
initial: {pa.angle: -0.6}
integrate: {until: 5}
output: {every: 0.02, columns: [pa.angle]}
EOF
tight "balls that strike" "$work/balls.yaml" 5 0.0567683666 2e-9 radau5 radau9 dop853 auto
