# state.sh -- where a run ended is where another one starts: --final-state and initial: {from: FILE}.
. tests/tools/lib.sh
cd "$work" || exit 1
cp "$ROOT"/decks/*.yaml .

# All kinds of coordinates, a universal and a free joint drawn the other way round, a body that nothing holds.
cat >all.yaml <<'END'
fmdsub: 1
gravity: [0, 0, -9.81]
bodies:
  a: {mass: 1, inertia: [0.1, 0.2, 0.25], at: [1, 0, 0]}
  b: {mass: 1, inertia: [0.1, 0.2, 0.25], at: [2, 0, 0]}
  c: {mass: 1, inertia: [0.1, 0.2, 0.25], at: [3, 0, 0]}
  d: {mass: 1, inertia: [0.1, 0.2, 0.25], at: [0, 3, 0]}
  e: {mass: 1, inertia: [0.1, 0.2, 0.25], at: [0, 4, 0]}
  alone: {mass: 1, inertia: [0.1, 0.2, 0.25], at: [0, 0, 5]}
constraints:
  u: {universal: [a, ground], at: [0.5, 0, 0], axis: [0, 1, 0], axis2: [0, 0, 1]}
  k: {cylindrical: [a, b], at: [1.5, 0, 0], axis: [1, 0, 0]}
  s: {spherical: [b, c], at: [2.5, 0, 0]}
  f: {free: [d, ground], at: [0, 3, 0]}
  p: {planar: [d, e], axis: [0, 0, 1]}
forces:
  hold: {spring: k.displacement, stiffness: 100}
initial:
  u.angle1: 0.3
  u.angle2_rate: 1
  k.angle_rate: 2
  s.omega: [1, 2, 3]
  f.omega: [0.1, 2, 0.1]
  f.rotation: {axis: [1, 1, 0], angle: 1}
integrate: {scheme: midpoint, step: 1.0e-3, until: 0.2}
output: {every: 0.1}
END

for deck in all pendulum chain bar-slider heavy-top spring-pendulum; do
    "$FMDSUB" run -q --until 0.2 --final-state end.json --every-steps 10 $deck.yaml >first.csv 2>err
    rc=$?
    [ $rc -le 1 ] && "$FMDSUB" run -q --until 0.2 --every-steps 10 -s 'initial={from: end.json}' $deck.yaml >second.csv 2>err
    [ $rc -le 1 ] || { not_ok "$deck: goes on" "exit $rc" err; continue; }
    # Positions, rates and what follows from them, but not the time, the energy since the start, and what Newton solves anew.
    awk -F, -v OFS=, 'NR == 1 { for (i = 2; i <= NF; i++) if ($i !~ /^energy|^step|_accel$|_rate_rate$|omega_._rate$|\.[fm][xyz]$|\.a[xyz]$/) keep[i] = 1 }
        { line = ""; for (i = 2; i <= NF; i++) if (i in keep) line = line OFS $i }
        FILENAME == "first.csv" { last = line }
        FILENAME == "second.csv" && FNR == 2 { same = line == last && length(line) > 3; exit } END { exit !same }' first.csv second.csv &&
        ok "$deck: the same bits" || not_ok "$deck: the same bits" "last and first record differ" first.csv second.csv
done

# Half a run and the other half are the whole.
"$FMDSUB" run -q --until 0.2 --final-state half.json all.yaml >/dev/null 2>&1
"$FMDSUB" run -q --until 0.2 --every 0.2 -s 'initial={from: half.json}' all.yaml 2>err | tail -n 1 >halves
"$FMDSUB" run -q --until 0.4 --every 0.4 all.yaml 2>err | tail -n 1 >whole
awk -F, 'NR == FNR { for (i = 1; i <= NF; i++) x[i] = $i; n = NF; next }
    { for (i = 2; i < NF; i++) { d = $i - x[i]; if (d < 0) d = -d; if (d > 1e-9) bad = 1 } fine = !bad && NF == n && n >= 40 } END { exit !fine }' whole halves &&
    ok "two halves are the whole" || not_ok "two halves are the whole" "more than 1e-9 apart" whole halves

# Drives, loads, tables and records that know the time: with 'time: keep' one run, byte for byte (restart.sh: all decks).
cat >clock.yaml <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies:
  crank: {mass: 1, inertia: 0.1, at: [0.5, 0]}
  rod:   {mass: 1, inertia: 0.1, at: [1.5, 0.5]}
  bob:   {mass: 1, inertia: 0.1, at: [2, 1]}
constraints:
  shaft: {revolute: [ground, crank], at: [0, 0]}
  elbow: {revolute: [crank, rod], at: [1, 0]}
  slot:  {prismatic: [rod, bob], at: [2, 1], axis: [0, 1]}
forces:
  push:  {force: slot, value: 3*sin(7*t)}
  hold:  {spring: slot, stiffness: 100}
  twist: {torque: elbow, value: {table: [[0, 0], [0.7, 2], [1.3, -2], [3, 1]]}}
drives:
  motor: {drive: shaft, value: "if(t < 1.2, 0.2*sin(3*t), 0.2*sin(3*t) + (t - 1.2)^2)"}
partition: {fast: [slot]}
integrate: {step: 1.0e-3, ratio: 5, until: 2}
output: {every: 0.05, columns: ["*.angle", "*_rate", slot.displacement, push.force, motor.force, energy.residual]}
END
for how in rk4 midpoint newmark subcycle dopri5; do
    keys="scheme: $how, step: 1.0e-3, newton_tolerance: 1.0e-14"
    [ $how = dopri5 ] && keys="$keys, tolerance: 1.0e-12"
    [ $how = subcycle ] && keys="$keys, ratio: 5"
    for until in 2 1; do
        "$FMDSUB" run -q -s "integrate={$keys, until: $until}" --final-state at$until.json clock.yaml >to$until.csv 2>err
    done
    "$FMDSUB" run -q -s "integrate={$keys, until: 2}" -s 'initial={from: at1.json, time: keep}' clock.yaml >rest.csv 2>err
    ended "$how goes on at t = 1: status" 0 $? rest.csv err
    awk -F, 'NR == FNR { line[$1] = $0; next } FNR > 1 { rows++; if ($0 != line[$1]) bad = 1 } END { exit bad || rows != 21 || $1 != 2 }' to2.csv rest.csv &&
        ok "$how goes on at t = 1: one run" || not_ok "$how goes on at t = 1: one run" "records differ" rest.csv
done
grep -q '^"last_step": "whole",$' at1.json && ok "the last step was whole" || not_ok "the last step was whole" "the state:" at1.json
# From between two steps, and between two records.
"$FMDSUB" run -q -s integrate.scheme=rk4 --until 1.00025 --final-state odd.json clock.yaml >out 2>err
grep -q '^"last_step": "cut",$' odd.json && ok "the last step was cut" || not_ok "the last step was cut" "the state:" odd.json
"$FMDSUB" run -q -s integrate.scheme=rk4 --until 1.01 -s integrate.ratio=1 --every 0.001 --columns t -s 'initial={from: odd.json, time: keep}' clock.yaml >out 2>err
expect "from between two steps" "1.00025 1.00125 1.01 12" "$(awk 'NR == 2 { a = $1 } NR == 3 { b = $1 } END { print a, b, $1, NR }' out)" err
"$FMDSUB" run -q -s integrate.scheme=rk4 --until 1.02 --final-state odd.json clock.yaml >out 2>err
"$FMDSUB" run -q -s integrate.scheme=rk4 --until 1.12 --columns t -s 'initial={from: odd.json, time: keep}' clock.yaml >out 2>err
expect "from between two records" "1.02 1.05 1.1 1.12 " "$(sed 1d out | tr '\n' ' ')" err
"$FMDSUB" run -q -s 'initial={from: at1.json}' clock.yaml >out 2>err
expect "the clock begins anew: status" 4 $? err
grep -q "W-time" err && grep -q "'time: keep' beside 'from' goes on" err && ok "the clock begins anew: told" || not_ok "the clock begins anew: told" "stderr:" err
"$FMDSUB" run -q -s 'initial={from: at1.json, time: zero}' clock.yaml >out 2>err
expect "the clock begins anew, as it is meant: nothing of the clock" "1 0" "$(grep -c "does not fit the loops" err) $(grep -c W-time err)" err

# Whole turns of a joint that closes a loop: the state holds its angle where a record asks for it.
"$FMDSUB" run -q --until 0.5 --final-state turned.json cardan.yaml >out 2>err
"$FMDSUB" run -q --until 1 --columns out.angle -s 'initial={from: turned.json, time: keep}' cardan.yaml 2>err >out
expect "whole turns of a joint that closes a loop" 30.02 "$(tail -n 1 out | cut -d , -f 2 | cut -c 1-5)" err

# A run that stops leaves the last state that was good.
"$FMDSUB" run -q --final-state stopped.json -s 'forces={f: {torque: pin, value: "sqrt(0.5 - t)"}}' pendulum.yaml >/dev/null 2>err
expect "stopped: status" 5 $?
awk '/^"t":/ { t = $2 + 0 } /nan|inf/ { bad = 1 } END { exit bad || t < 0.4 || t > 0.5 }' stopped.json && ok "stopped: the last good state" ||
    not_ok "stopped: the last good state" "the state:" stopped.json

wrong() { # NAME PATTERN SET: exit 3, one error
    "$FMDSUB" run -s "$3" pendulum.yaml >out 2>err
    rc=$?
    if [ $rc -eq 3 ] && [ ! -s out ] && [ "$(grep -c ': error: ' err)" = 1 ] && grep -q "$2" err; then ok "$1"
    else not_ok "$1" "exit $rc; expected 3 and one error with: $2" err; fi
}
wrong "a state of another deck" "unknown coordinate or rate 'u.angle1'" 'initial={from: half.json}'
echo '{"fmdsub_state": 1, "state": {"pin.angle": 1}}' >gap.json
echo '{"fmdsub_state": 1, "t": 20, "state": {"pin.angle": 1, "pin.angle_rate": 0}}' >then.json
wrong "a state with a gap" "the state has no 'pin.angle_rate'" 'initial={from: gap.json}'
wrong "an end before the start" "the run starts at t = 20 s, where its state was: it cannot end at 10 s" 'initial={from: then.json, time: keep}'
wrong "no time to keep" "no 't' to go on from" 'initial={from: gap.json, time: keep}'
wrong "neither kept nor zero" "unknown word 'kept' for 'time'" 'initial={from: then.json, time: kept}'
wrong "something else" "no final state" 'initial={from: chain.yaml}'
wrong "no such file" "No such file" 'initial={from: nothing.json}'
wrong "more beside it" "'pin.angle' cannot be set beside it" 'initial={from: gap.json, pin.angle: 1}'
echo '{"fmdsub_state": 1, "state": {"pin.angle": 1, "pin.angle_rate": nan}}' >nan.json
wrong "not a number" "'nan' is not a number" 'initial={from: nan.json}'
sed -e 's/"s.qw": [^,]*/"s.qw": 2/' -e '/^"deck"/d' -e '/^"memory"/,/^}/d' -e 's/^"check".*/"t": 0}/' -e '/^"t": 0.2/d' half.json >long.json
"$FMDSUB" run -s 'initial={from: long.json, deck: any}' all.yaml >out 2>err
expect "a quaternion of another length: status" 3 $? err
grep -q "quaternion of 's' has length" err && ok "a quaternion of another length" || not_ok "a quaternion of another length" "stderr:" err

# A state that was changed, another deck, other steps.
state() { # NAME STATUS PATTERN FILE SETTINGS...
    name=$1 want=$2 pattern=$3
    sed "s/FILE/$4/" clock.yaml >other.yaml
    shift 4
    "$FMDSUB" run --until 1.5 --every 0.5 --columns t "$@" other.yaml >out 2>err
    rc=$?
    if [ $rc = $want ] && { [ $want != 0 ] || [ -s out ]; } && { [ -z "$pattern" ] || grep -q -e "$pattern" err; }; then ok "$name"
    else not_ok "$name" "exit $rc; expected $want and: $pattern" err; fi
}
I='initial={from: at1.json, time: keep' ONE='coordinates and rates alone'
sed 's/\("elbow.angle": -*[0-9]*\.[0-9]\)./\17/' at1.json >digit.json
cmp -s digit.json at1.json && not_ok "a digit" "sed has changed nothing"
sed 's/^"t": 1,/"t": 1e300,/' at1.json >late.json
awk '/"newton.top"|"dopri5.h"/ { sub(/[0-9a-f]"/, "z\"") } { print }' at1.json >inside.json
sed '/"slot.displacement"/d' at1.json >less.json
for f in digit inside; do
    state "a state that was changed: $f" 3 "the state is not as it was written" "" -s "initial={from: $f.json, time: keep}"
    state "a state that was changed, any deck: $f" 3 "the state is not as it was written" "" -s "initial={from: $f.json, time: keep, deck: any}"
done
state "a state that was changed: its time" 3 "the state is not as it was written" "" -s 'initial={from: late.json}'
tr -d '\n' <at1.json | sed 's/": /":/g' >packed.json
K='integrate={scheme: dopri5, step: 1.0e-3, newton_tolerance: 1.0e-14, tolerance: 1.0e-12, until: 2}' # as at1.json
state "the same in other lines" 0 "" "" -s "$K" -s 'initial={from: packed.json, time: keep}' -s output.every=0.05
grep -q "$ONE" err || [ ! -s out ] && not_ok "the same in other lines: one run" "stderr:" err || ok "the same in other lines: one run"
state "another scheme" 0 "$ONE (scheme, step or partition are others)" "" -s integrate.scheme=midpoint -s "$I}"
state "another deck" 3 "the state is of another deck, or this one has been changed since" "" -s forces.hold.stiffness=101 -s "$I}"
state "another deck, and that is meant" 0 "$ONE (it is another deck's)" "" -s forces.hold.stiffness=101 -s "$I, deck: any}"
state "the same deck in other words" 0 "(scheme, step or partition are others)" "" -s forces.hold.stiffness=50+50 -s title=Other -s "$I}"
sed -e '/^"deck"/d' -e '/^"memory"/,/^}/d' -e 's/^"check".*/"last_step": "whole"}/' -e '/^"last_step": "whole",/d' at1.json >edited.json
state "a state without a deck" 3 "the state does not tell which deck it is of" "" -s 'initial={from: edited.json, time: keep}'
state "a state without a deck, any deck" 0 "$ONE" "" -s 'initial={from: edited.json, time: keep, deck: any}'

"$FMDSUB" run -q --final-state no/such/folder.json pendulum.yaml >/dev/null 2>err
expect "--final-state where nothing can be written" 6 $? err

# Turns are kept of angles in space, which a posture does not tell; not of distances, nor in the plane.
"$FMDSUB" run -q -s 'measures={far: {distance: [ball, [2, 1]]}, lean: {angle: [ground, ball]}}' -s 'output.columns=[far, lean]' --until 1 --final-state flat.json pendulum.yaml >out 2>err
expect "turns in the plane: none are kept" "0 0" "$? $(grep -c '"angles"' flat.json)" err
cat >spun.yaml <<'DECK'
fmdsub: 1
bodies: {wheel: {mass: 1, inertia: [1, 1, 2], at: [0, 0, 0]}}
constraints: {spin: {spherical: [ground, wheel], at: [0, 0, 0]}}
measures: {turn: {angle: [ground, wheel], axis: [0, 0, 1]}, far: {distance: [wheel, [2, 0, 0]]}}
initial: {spin.omega: [0, 0, 10]}
integrate: {scheme: midpoint, step: 1.0e-3, until: 1}
output: {every: 0.5, columns: [turn, far]}
DECK
"$FMDSUB" run -q --final-state spun.json spun.yaml >out 2>err
expect "turns in space: those of an angle alone" "0 1 0" "$? $(sed -n '/"angles"/,/}/p' spun.json | grep -c '"turn"') $(sed -n '/"angles"/,/}/p' spun.json | grep -c '"far"')" spun.json err
awk -F, 'END { exit !($2 > 9.99 && $2 < 10.01) }' out && ok "turns in space: 10 rad" || not_ok "turns in space: 10 rad" "got:" out

# A quaternion of a state has length 1 but for round-off: its square to 1e-9.
for square in 0.9999999992:0 1.0000000008:0 0.999999998:3 1.000000002:3; do
    cat >long.json <<STATE
{"fmdsub_state": 2, "t": 0, "state": {"spin.qw": $(awk "BEGIN { printf \"%.15g\", sqrt(${square%:*}) }"), "spin.qx": 0, "spin.qy": 0,
    "spin.qz": 0, "spin.omega_x": 0, "spin.omega_y": 0, "spin.omega_z": 0}}
STATE
    "$FMDSUB" run -q -s 'initial={from: long.json, deck: any}' --until 1.001 spun.yaml >out 2>err
    expect "a quaternion of square ${square%:*}" "${square#*:} $((${square#*:} / 3)) $((${square#*:} == 0))" "$? $(grep -c E-quaternion err) $(grep -c '^t,' out)" out err
done
