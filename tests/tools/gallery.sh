# gallery.sh -- hard cases judged by number, as a table: case, scheme, verdict, figure, limit, seconds.  right: the run ends and
# the figure is within its limit; told: it stopped, or ended with a status and a reason; silent: a wrong number without a word.
#
#     BUILD=build sh tests/tools/gallery.sh        ends with 1 where a case is silent
. tests/tools/lib.sh
cd "$work" || exit 1
silent=0
printf '%-5s %-18s %-7s %-12s %-9s %s\n' case scheme verdict figure limit seconds

# row CASE SCHEME LIMIT AWK [ARGUMENT...]: the deck on stdin; AWK prints the figure from the records, fields by comma.
row() {
    case_=$1 scheme=$2 limit=$3 program=$4
    shift 4
    cat >deck.yaml
    begun=$(date +%s%N)
    "$FMDSUB" run -q --set "integrate.scheme=$scheme" "$@" deck.yaml >out 2>err
    rc=$?
    seconds=$(awk -v ns=$(($(date +%s%N) - begun)) 'BEGIN { printf "%.2f", ns / 1e9 }')
    figure=$(awk -F, "$program" out)
    if [ $rc != 0 ] && [ -s err ]; then verdict=told
    elif [ $rc = 0 ] && awk -v f="$figure" -v l="$limit" 'BEGIN { exit !(f != "" && f + 0 == f && f >= 0 && f <= l) }'; then verdict=right
    else verdict=silent silent=$((silent + 1)); fi
    printf '%-5s %-18s %-7s %-12s %-9s %s\n' "$case_" "$scheme" "$verdict" "${figure:--}" "$limit" "$seconds"
}
abs='function abs(x) { return x < 0 ? -x : x }'

# H10: an inertia that no body can have.
row H10 midpoint 0 '' <<'DECK'
fmdsub: 1
bodies: {top: {mass: 1, at: [0, 0, 0], inertia: [1, 1, 3]}}
constraints: {float: {free: [ground, top], at: [0, 0, 0]}}
integrate: {step: 1.0e-3, until: 1}
DECK

# H11: a pendulum of 0.1 g on one of 10 t, the other way round: the energy over 10 s.
for scheme in midpoint newmark generalized-alpha; do
    row H11 $scheme 1e-6 "$abs"' NR > 1 { r = abs($2); if (r > m) m = r; if ($3 > k) k = $3 } END { printf "%.2g", m / k }' <<'DECK'
fmdsub: 1
gravity: [0, -9.81]
bodies: {upper: {mass: 1.0e-4, at: [0, -1]}, lower: {mass: 1.0e+4, at: [0, -2]}}
constraints: {pin: {revolute: [ground, upper], at: [0, 0]}, knee: {revolute: [upper, lower], at: [0, -1]}}
initial: {pin.angle: 0.01}
integrate: {step: 1.0e-4, until: 10}
output: {every: 0.1, columns: [energy.residual, energy.kinetic]}
DECK
done

# H12: an oscillator of 1e6 rad/s in steps of 1e-3: bounded, its phase that of the rule, 2 atan(500) a step, to 1e-9.
for scheme in midpoint newmark; do
    row H12 $scheme 1e-5 "$abs"' END { p = 2 * atan2(500, 1); printf "%.2g", abs($2 - cos(10000 * p)) }' <<'DECK'
fmdsub: 1
bodies: {car: {mass: 1, at: [0, 0]}}
constraints: {rail: {prismatic: [ground, car], axis: [1, 0]}}
forces: {k: {spring: rail, stiffness: 1.0e+12}}
initial: {rail.displacement: 1}
integrate: {step: 1.0e-3, until: 10}
output: {every: 10, columns: [rail.displacement]}
DECK
done

# H15: a free body near the turn about its middle axis, a thousandth of a thousand periods: energy.
for scheme in midpoint subcycle newmark; do
    limit=1e-9
    [ $scheme = newmark ] && limit=1e-5 # of second order: it does not keep the energy
    row H15 $scheme $limit "$abs"' NR > 1 { r = abs($2) / $3; if (r > m) m = r } END { printf "%.2g", m }' <<'DECK'
fmdsub: 1
bodies: {top: {mass: 1, at: [0, 0, 0], inertia: [1, 2, 3]}}
constraints: {float: {free: [ground, top], at: [0, 0, 0]}}
initial: {float.omega: {value: [1.0e-4, 10, 1.0e-4], frame: body}}
integrate: {step: 1.0e-3, until: 20}
output: {every: 0.1, columns: [energy.residual, energy.kinetic]}
DECK
done

# H17 to H19: two sliders side by side (coupled by stiffness), one on the other (by mass), and with a whole number of half
# periods in a major step: bounded, or told.
for scheme in subcycle midpoint newmark generalized-alpha miao daniel neal-belytschko; do
    for case in H17 H18 H19; do
        step=0.01 on=ground
        [ $case = H18 ] && on=cart
        [ $case = H19 ] && step=0.00628318530717958648 # 10 h omega = pi at 50 rad/s
        row $case $scheme 3 "$abs"' NR == 2 { e = $3 + $4 } NR > 1 { if ($3 + $4 > m) m = $3 + $4 } END { printf "%.4g", m / e }' --set integrate.ratio=10 --set integrate.step=$step <<DECK
fmdsub: 1
bodies: {cart: {mass: 1, inertia: 1, at: [0, 0]}, rider: {mass: 1, inertia: 1, at: [2, 0]}}
constraints:
  rail: {prismatic: [ground, cart], axis: [1, 0], at: [0, 0]}
  slot: {prismatic: [$on, rider], axis: [1, 0], at: [2, 0]}
forces: {soft: {spring: rail, stiffness: 1}, stiff: {spring: [cart, rider], stiffness: 2500}, weak: {spring: slot, stiffness: 1}}
partition: {fast: [slot]}
initial: {rail.displacement: 0.1, slot.displacement: 0.01}
integrate: {step: 0.01, until: 500}
output: {every: {steps: 10}, columns: [rail.displacement, energy.kinetic, energy.elastic]}
DECK
    done
done

# H20: a pendulum from 2 rad, 1e5 steps: the energy swings, and does not drift.
for scheme in midpoint newmark subcycle; do
    row H20 $scheme 1.05 "$abs"' NR > 1 { r = abs($2); if ($1 <= 10) { if (r > a) a = r } else if (r > b) b = r } END { printf "%.4g", (a > 1e-9 ? b / a : 1) }' <<'DECK'
fmdsub: 1
gravity: [0, -9.81]
bodies: {bob: {mass: 1, at: [0, -1]}}
constraints: {pin: {revolute: [ground, bob], at: [0, 0]}}
initial: {pin.angle: 2}
integrate: {step: 1.0e-2, until: 1000}
output: {every: {steps: 1}, columns: [energy.residual]}
DECK
done

# H21: free fall in steps of a nanosecond; a step that t cannot resolve.
fall() { printf 'fmdsub: 1\ngravity: [0, -9.81]\nbodies: {ball: {mass: 1, at: [0, 0]}}\nconstraints: {rail: {prismatic: [ground, ball], axis: [0, 1]}}\nintegrate: {step: %s, until: %s}\noutput: {columns: [ball.ay]}\n' "$1" "$2"; }
fall 1.0e-9 1.0e-6 | row H21 midpoint 1e-9 "$abs"' NR > 1 { r = abs($2 + 9.81); if (r > m) m = r } END { printf "%.2g", m }'
fall 1.0e-17 1 | row H21 midpoint 0 ''

# H22: the last record stands at until.
for until in 0.3 0.7 1; do fall 0.1 $until | row H22 newmark 0 'END { printf "%.2g", $1 - '$until' }'; done

# H34: dampers that give, and one that all but locks.
for damping in -1 1.0e+9; do
    row H34 midpoint 1e-6 "$abs"' END { printf "%.2g", abs($2) }' <<DECK
fmdsub: 1
bodies: {car: {mass: 1, at: [0, 0]}}
constraints: {rail: {prismatic: [ground, car], axis: [1, 0]}}
forces: {d: {damper: rail, damping: $damping}}
initial: {rail.displacement_rate: 1.0e-6}
integrate: {step: 1.0e-3, until: 1}
output: {columns: [rail.displacement_rate]}
DECK
done

# H35: a force 1/x that meets 0.
for scheme in midpoint newmark rk4 dopri5; do
    step="step: 1.0e-3"
    [ $scheme = dopri5 ] && step="tolerance: 1.0e-6"
    row H35 $scheme 0 '' <<DECK
fmdsub: 1
bodies: {car: {mass: 1, at: [1, 0]}}
constraints: {rail: {prismatic: [ground, car], axis: [1, 0]}}
forces: {pole: {force: rail, value: -1/(1 + rail.displacement)}}
integrate: {$step, until: 5}
output: {every: 0.1, columns: [rail.displacement]}
DECK
done

# H39: ratios and steps that are none.
for set in integrate.ratio=0 integrate.ratio=-1 integrate.step=0 integrate.step=-1 integrate.step=9 integrate.ratio=1000000000; do fall 1.0e-2 1 | row H39 subcycle 0 '' --set $set; done

echo "silent: $silent"
exit $((silent > 0))
