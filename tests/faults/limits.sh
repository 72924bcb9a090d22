# limits.sh -- memory in proportion to the scene; --max-memory and --max-time end in good order.
. tests/tools/lib.sh
cd "$work" || exit 1

chain() { # N: a chain of so many links; stdout
    cat <<EOF
fmdsub: 1
gravity: [0, -9.81]
bodies:
  link\$(i): {repeat: {i: [1, $1]}, mass: 1, inertia: 1/12, at: [i - 0.5, 0]}
constraints:
  pin: {revolute: [ground, link1], at: [0, 0]}
  pin\$(i): {repeat: {i: [2, $1]}, revolute: [link\$(i-1), link\$(i)], at: [i - 1, 0]}
integrate: {scheme: newmark, step: 1.0e-3, until: 0.01}
output: {every: 0.01, columns: [pin.angle, energy.residual]}
EOF
}
chain 10000 >chain.yaml
cat >free.yaml <<EOF
fmdsub: 1
gravity: [0, -9.81]
bodies:
  b\$(i): {repeat: {i: [1, 10000]}, mass: 1, inertia: 1/12, at: [i - 0.5, 0]}
constraints:
  f\$(i): {repeat: {i: [1, 10000]}, free: [ground, b\$(i)], at: [i - 0.5, 0]}
integrate: {scheme: newmark, step: 1.0e-3, until: 0.01}
output: {every: 0.01, columns: [f1.x]}
EOF
for deck in chain free; do
    "$FMDSUB" run -q --max-memory 300M $deck.yaml >out 2>err
    ended "$deck of 10 000 bodies in 300 MB: run" 0 $? out err
    "$FMDSUB" check -q --max-memory 300M $deck.yaml >out 2>err
    ended "$deck of 10 000 bodies in 300 MB: check" 0 $? out err
    (ulimit -t 2; exec "$FMDSUB" run -q --set integrate.until=1.0e-3 --set output.every=1.0e-3 --max-memory 300M $deck.yaml) >out 2>err
    ended "$deck of 10 000 bodies: its first step within 2 s of CPU time" 0 $? out err
done

"$FMDSUB" check --max-memory 60M chain.yaml >out 2>err
expect "more than --max-memory: status" 7 $? err
grep -q 'MB more were needed, and the limit is 60 MB in all (--max-memory' err && ok "more than --max-memory: told" ||
    not_ok "more than --max-memory: told" "stderr:" err

# A spring to the second body makes the iteration matrix a full one: 4 matrices of 72 MB, asked for in the first step.
{ chain 3000; echo 'forces: {tie: {spring: [[0, 1], link3], stiffness: 100}}'; } >full.yaml
"$FMDSUB" run --max-memory 175M --final-state full.json -o full.csv full.yaml 2>err
expect "a matrix that is too large: status" 7 $? err
grep -q 'stopped at t = 0 s: a matrix of all freedoms would take 72 MB' err && ok "a matrix that is too large: told" ||
    not_ok "a matrix that is too large: told" "stderr:" err
expect "a matrix that is too large: the records so far are whole" "t,pin.angle,energy.residual 0,0,0" "$(tr '\n' ' ' <full.csv.part | sed 's/ $//')"
grep -q '"t": 0,' full.json && ok "a matrix that is too large: the state is saved" || not_ok "a matrix that is too large: the state is saved" "no state" err

"$FMDSUB" run --max-time 0.3 --every 1.0e-3 --until 1.0e+6 --final-state late.json "$ROOT/decks/pendulum.yaml" >late.csv 2>err
expect "--max-time: status" 7 $? err
grep -q 'stopped at t = .* s: the limit of time (--max-time) is reached' err && grep -q '^time limit reached at' err &&
    ok "--max-time: told" || not_ok "--max-time: told" "stderr:" err
expect "--max-time: the last record is whole" yes "$(awk -F, 'NR == 1 { n = NF } END { print (NR > 1 && NF == n ? "yes" : NF) }' late.csv)"
expect "--max-time: the state is that of the last record" "t $(tail -n 1 late.csv | cut -d , -f 1)" "$(sed -n 's/^"\(t\)": \(.*\),$/\1 \2/p' late.json)"
"$FMDSUB" study -q --max-time 0.3 --until 1.0e+4 "$ROOT/decks/pendulum.yaml" >out 2>err
expect "--max-time: study" 7 $? err

for wrong in "--max-memory 5" "--max-memory much" "--max-memory -1G" "--max-memory 1GG" "--max-time 0" "--max-time 1s"; do
    "$FMDSUB" check $wrong "$ROOT/decks/pendulum.yaml" >out 2>err
    expect "$wrong: status" 2 $? err
    grep -q "$(echo "$wrong" | cut -d ' ' -f 1 | sed 's/^--//') takes" err && ok "$wrong: told" || not_ok "$wrong: told" "stderr:" err
done

# Wrong decks as large as a deck may be: an answer within seconds of CPU time, memory in proportion.
wrong() { # NAME STATUS
    (ulimit -t 4; exec "$FMDSUB" check --max-memory 220M wrong.yaml) >out 2>err
    expect "$1: status" "$2" $? err
}
{ echo 'fmdsub: 1'; awk 'BEGIN { for (i = 0; i < 900000; i++) print "k" i ": 1" }'; } >wrong.yaml
wrong "900 000 unknown keys" 3
grep -q '^after 1000 errors the rest of the deck was not looked at$' err && ok "900 000 unknown keys: told" || not_ok "900 000 unknown keys: told" "stderr:" err
{ echo 'fmdsub: 1'; echo 'bodies:'; awk 'BEGIN { for (i = 0; i < 300000; i++) print "  b" i ": {masss: 1}" }'; } >wrong.yaml
wrong "300 000 wrong bodies" 3
{ echo 'fmdsub: 1'; echo 'bodies: {'; awk 'BEGIN { for (i = 0; i < 8000; i++) print "  b" i ": {mass: 1, at: [0, 0]}," }'; echo '}'; echo 'constraints:'
    awk 'BEGIN { for (i = 0; i < 8000; i++) print "  j" i ": {free: [ground, c" i "]}" }'; } >wrong.yaml
wrong "8000 joints of unknown bodies" 3
{ echo 'fmdsub: 1'; printf 'x: ['; awk 'BEGIN { for (i = 0; i < 8000000; i++) printf "1," }'; echo '1]'; } >wrong.yaml
wrong "8 000 000 values" 7
