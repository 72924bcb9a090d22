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
        FILENAME == "second.csv" && FNR == 2 { exit !(line == last && length(line) > 3) }' first.csv second.csv &&
        ok "$deck: the same bits" || not_ok "$deck: the same bits" "last and first record differ" first.csv second.csv
done

# Half a run and the other half are the whole.
"$FMDSUB" run -q --until 0.2 --final-state half.json all.yaml >/dev/null 2>&1
"$FMDSUB" run -q --until 0.2 --every 0.2 -s 'initial={from: half.json}' all.yaml 2>err | tail -n 1 >halves
"$FMDSUB" run -q --until 0.4 --every 0.4 all.yaml 2>err | tail -n 1 >whole
awk -F, 'NR == FNR { for (i = 1; i <= NF; i++) x[i] = $i; n = NF; next }
    { for (i = 2; i < NF; i++) { d = $i - x[i]; if (d < 0) d = -d; if (d > 1e-9) bad = 1 } exit bad || NF != n || n < 40 }' whole halves &&
    ok "two halves are the whole" || not_ok "two halves are the whole" "more than 1e-9 apart" whole halves

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
wrong "a state with a gap" "the state has no 'pin.angle_rate'" 'initial={from: gap.json}'
wrong "something else" "no final state" 'initial={from: chain.yaml}'
wrong "no such file" "No such file" 'initial={from: nothing.json}'
wrong "more beside it" "'pin.angle' cannot be set beside it" 'initial={from: gap.json, pin.angle: 1}'
echo '{"fmdsub_state": 1, "state": {"pin.angle": 1, "pin.angle_rate": nan}}' >nan.json
wrong "not a number" "'nan' is not a number" 'initial={from: nan.json}'
sed 's/"s.qw": [^,]*/"s.qw": 2/' half.json >long.json
"$FMDSUB" run -s 'initial={from: long.json}' all.yaml >out 2>err
expect "a quaternion of another length: status" 3 $? err
grep -q "quaternion of 's' has length" err && ok "a quaternion of another length" || not_ok "a quaternion of another length" "stderr:" err
"$FMDSUB" run -q --final-state no/such/folder.json pendulum.yaml >/dev/null 2>err
expect "--final-state where nothing can be written" 6 $? err
