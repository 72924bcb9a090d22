# bdf.sh -- Gear's method by CVODE: against closed forms and references, what is stiff, loops, rotations, corners, edges; what it
# forgets in a state.  A build without CVODE says what it is without.
. tests/tools/lib.sh
cd "$work" || exit 1

cat >oscillator.yaml <<'DECK'
fmdsub: 1
title: A mass on a spring, from rest, displacement cos(3 t)
bodies: {ball: {mass: 1, at: [0, 0]}}
constraints: {rail: {prismatic: [ground, ball], at: [0, 0], axis: [1, 0]}}
forces: {spring: {spring: rail.displacement, stiffness: 9}}
initial: {rail.displacement: 1}
integrate: {scheme: bdf, tolerance: 1.0e-6, until: 10}
output: {every: 0.37, columns: [rail.*, energy.residual]}
DECK
if ! has_scheme bdf; then
    "$FMDSUB" check oscillator.yaml >out 2>err
    expect "without CVODE: a deck is refused, with the package" "3 1 1" "$? $(grep -c E-absent-scheme err) $(grep -c libsundials-dev err)" err
    "$FMDSUB" study --schemes bdf oscillator.yaml >out 2>err
    expect "without CVODE: so is a study" "2 1" "$? $(grep -c libsundials-dev err)" err
    expect "without CVODE: the list says so" 1 "$("$FMDSUB" list schemes -f csv | grep -c '^bdf,.*,libsundials-dev$')"
    skip bdf "this build has not found CVODE (Debian: libsundials-dev)"
    exit 0
fi
expect "it is listed" 1 "$("$FMDSUB" list schemes -f csv | grep -c '^bdf,5,no,yes,.*,$')"

# Records are between steps: as close as those.
for tolerance in 1.0e-3 1.0e-5 1.0e-8; do
    "$FMDSUB" run -q --set integrate.tolerance=$tolerance oscillator.yaml >out 2>err
    expect "oscillator to $tolerance: all records, within ten tolerances a period" "0 ok" "$? $(awk -F, -v tol=$tolerance '
        NR > 1 { e = $2 - cos(3 * $1); v = $3 + 3 * sin(3 * $1); if (e < 0) e = -e; if (v < 0) v = -v; if (v / 3 > e) e = v / 3; if (e > most) most = e; n++ }
        END { print (n == 29 && most > 0 && most < 10 * tol * 10 * 3 / 6.283) ? "ok" : most " " n }' out)" out err
done

compare() { # NAME REFERENCE LIMIT COLUMNS RUN
    found=$("$COMPARE" --reference --columns "$4" "$2" "$5" 2>&1)
    expect "$1" ok "$(echo "$found" | awk -v limit="$3" '{ print ($1 + 0 > 0 && $1 + 0 < limit) ? "ok" : $0 }')"
}
"$FMDSUB" run -q --set 'integrate={scheme: bdf, tolerance: 1.0e-9, until: 10}' "$ROOT/decks/pendulum.yaml" >out 2>err
compare "pendulum against its closed form" "$ROOT/tests/refdata/pendulum.csv" 1e-7 "ball.x ball.y ball.vx ball.vy" out
"$FMDSUB" run -q --set 'integrate={scheme: bdf, tolerance: 1.0e-9, until: 0.03}' "$ROOT/decks/andrews.yaml" >out 2>err
compare "Andrews' squeezer against its reference" "$ROOT/tests/refdata/andrews.csv" 1e-7 "O.angle F.angle" out

# A mass on a stiff damped spring that is shaken slowly: steps are those of the shaking.
cat >stiff.yaml <<'DECK'
fmdsub: 1
bodies: {base: {mass: 1, at: [0, 0]}, ball: {mass: 1, at: [1, 0]}}
constraints:
  shaker: {prismatic: [ground, base], at: [0, 0], axis: [1, 0]}
  rail: {prismatic: [base, ball], at: [1, 0], axis: [1, 0]}
drives: {shake: {drive: shaker.displacement, value: "0.1*sin(t)"}}
forces: {spring: {spring: rail.displacement, stiffness: 1.0e+8, damping: 1.0e+5}}
integrate: {scheme: bdf, tolerance: 1.0e-5, until: 20}
output: {every: 1, columns: [ball.x]}
DECK
"$FMDSUB" run stiff.yaml >out 2>err
steps=$(sed -n 's/.* \([0-9]*\) minor steps.*/\1/p' err)
expect "what is stiff and damped takes few steps" "0 ok" "$? $([ "${steps:-0}" -gt 20 ] && [ "$steps" -lt 500 ] && echo ok || echo "$steps steps")" err
expect "... and is right" ok "$(tail -n 1 out | awk -F, '{ e = $2 - 1 - .1 * sin(20) * (1 + 1e-8); print (e < 1e-6 && e > -1e-6) ? "ok" : e }')" out

# Without damping orders above 2 are held up by the fastest vibration.
long() { "$FMDSUB" run --set "integrate={scheme: bdf, tolerance: 1.0e-3, most_order: $1, until: 20}" "$ROOT/decks/spin-up.yaml" 2>&1 >out | sed -n 's/.* \([0-9]*\) minor steps.*/\1/p'; }
two=$(long 2) five=$(long 5)
expect "most_order 2 keeps steps long where nothing damps" ok "$([ "$two" -gt 100 ] && [ "$five" -gt $((5 * two)) ] && echo ok || echo "$two $five")"

# Loops that turn: through dead points of the tangent they stay in their posture; rotations: by charts of a radian.
for deck in four-bar slider-crank bricard heavy-top free-top; do
    file=$ROOT/decks/$deck.yaml
    [ -f "$file" ] || file=$ROOT/tests/decks/$deck.yaml
    "$FMDSUB" run -q --until 1 --set integrate.scheme=dop853 --set integrate.tolerance=1.0e-11 --every 0.1 "$file" >want 2>err
    "$FMDSUB" run -q --until 1 --set integrate.scheme=bdf --set integrate.tolerance=1.0e-7 --every 0.1 "$file" >out 2>err
    expect "$deck: as dop853" "0 ok" "$? $("$COMPARE" --reference --columns "$(head -n 1 out | tr , '\n' | grep -v '^t$\|^energy\|\.f[xyz]$\|\.m[xyz]$\|force\|moment' | tr '\n' ' ')" want out 2>&1 | awk '{ print ($1 + 0 > 0 && $1 + 0 < 1e-4) ? "ok" : $0 }')" err
done

# A corner of a drive and the edge of a stop: located, and behind them it begins again.
cat >corner.yaml <<'DECK'
fmdsub: 1
bodies: {base: {mass: 1, at: [0, 0]}, ball: {mass: 1, at: [1, 0]}}
constraints:
  shaker: {prismatic: [ground, base], at: [0, 0], axis: [1, 0]}
  rail: {prismatic: [base, ball], at: [1, 0], axis: [1, 0], range: {lower: -0.2, upper: 0.2, hold: {stiffness: 1.0e+4}}}
drives: {shake: {drive: shaker.displacement, value: {table: [[0, 0], [0.3, 0.3], [1.1, 0], [4, 0.5]]}}}
forces: {spring: {spring: rail.displacement, stiffness: 40}}
integrate: {scheme: bdf, tolerance: 1.0e-7, until: 3}
output: {every: 0.5, columns: [ball.x, ball.vx, energy.residual]}
DECK
"$FMDSUB" run -q corner.yaml >out 2>err
status=$?
"$FMDSUB" run -q --set integrate.scheme=dop853 --set integrate.tolerance=1.0e-11 corner.yaml >want
expect "corners and stops: as dop853" "0 ok" "$status $("$COMPARE" --reference --columns "ball.x ball.vx" want out 2>&1 | awk '{ print ($1 + 0 > 0 && $1 + 0 < 1e-5) ? "ok" : $0 }')" err

# Rigid contacts are midpoint's.
"$FMDSUB" check --set 'integrate={scheme: bdf, tolerance: 1.0e-6, until: 1}' "$ROOT/decks/bounce-and-roll.yaml" >out 2>err
expect "rigid contacts are refused by name" "3 1" "$? $(grep -c 'E-scheme-contact' err)" err

# What CVODE remembers is not in a state: the rest begins at order 1, says so, and is as good; between checkpoints of one run
# it is the same to the last byte, for there the run itself begins again.
cp "$ROOT/decks/double-pendulum.yaml" .
plan='integrate={scheme: bdf, tolerance: 1.0e-7, until: 1}'
"$FMDSUB" run -q --set "$plan" double-pendulum.yaml >whole
"$FMDSUB" run -q --set "$plan" --until 0.5 --final-state half.json double-pendulum.yaml >first
"$FMDSUB" run --set "$plan" --set 'initial={from: half.json, time: keep}' double-pendulum.yaml >rest 2>err
expect "a run from a state says that it begins at order 1" 1 "$(grep -c 'begins again at order 1' err)" err
{ cat first; sed 1,2d rest; } >both
expect "... and goes on as well" ok "$("$COMPARE" --reference --columns "link1.angle link2.angle" whole both 2>&1 | awk '{ print ($1 + 0 > 0 && $1 + 0 < 1e-5) ? "ok" : $0 }')" err

kept() { "$FMDSUB" run -q --set 'checkpoint={every: {steps: 20}, file: kept}' --set "$plan" "$@"; }
kept double-pendulum.yaml >all
bytes=$(awk '$1 == "run.bytes" { print $2 }' kept)
kept --resume kept double-pendulum.yaml >rest
{ head -c $((0x$bytes)) all; cat rest; } >both
same "from a checkpoint to the same bytes" all both
expect "... with records behind it" ok "$([ -s rest ] && echo ok)"

"$BUILD/tools/everyalloc" "$BUILD/tools/badalloc.so" "$work" 100000 "$FMDSUB" run -q --until 0.01 --every-steps 1 oscillator.yaml >refused
# SUNDIALS 6.4 itself does not look at two of its allocations, those of its logger.
expect "no memory at any allocation, CVODE's among them: it says so" ok "$(awk '/refused$/ || / 0 runs wrong/ { good = 1 } /runs wrong/ && $(NF - 2) + 0 <= 2 { good = 1 } END { print good ? "ok" : "no" }' refused)" refused

"$FMDSUB" study -q --repeats 0 --budget 20 --schemes bdf,radau5 --tolerances 1e-3,1e-5 stiff.yaml >out 2>err
expect "a study takes it by name" "0 2" "$? $(grep -c '^bdf,' out)" out err
"$FMDSUB" study -q --repeats 0 --budget 5 --set integrate.scheme=radau9 oscillator.yaml >out 2>err
expect "and not by itself" "0 0" "$? $(grep -c '^bdf,' out)" out err
