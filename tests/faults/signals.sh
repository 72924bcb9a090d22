# signals.sh -- SIGINT, SIGTERM, SIGHUP and SIGXCPU finish the step, write what is due, and leave by their own code.
. tests/tools/lib.sh
deck=$ROOT/decks/pendulum.yaml

# Every record has as many fields as the header, and the last one ends its line.
whole() { # NAME FILE
    if [ "$(tail -c 1 "$2" | od -An -c | tr -d ' ')" = '\n' ] && awk -F, 'NR == 1 { n = NF } NF != n { bad = 1 } END { exit bad || NR < 2 }' "$2"
    then ok "$1"
    else tail -n 2 "$2" >"$work/tail"; not_ok "$1" "the last record is cut" "$work/tail"; fi
}

for signal in INT:130 TERM:143 HUP:129 XCPU:7; do
    name=SIG${signal%:*}
    timeout --preserve-status -s "${signal%:*}" 0.5 "$FMDSUB" run --every 1.0e-3 --until 1.0e+5 "$deck" >"$work/out.csv" 2>"$work/err"
    expect "$name: status" "${signal#*:}" $? "$work/err"
    whole "$name: records whole" "$work/out.csv"
done

# One record in a day: a scheme of own steps ends after one of these, with a record and a state that goes on.
for scheme in dopri5 dop853 radau5 radau9; do
    chaos() { timeout --preserve-status -k 3 -s INT "$@" decks/double-pendulum.yaml; }
    chaos 0.5 "$FMDSUB" run -q -s "integrate={scheme: $scheme, tolerance: 1.0e-9, until: 86400}" --every 86400 \
        --columns pin1.angle --final-state "$work/day.json" >"$work/out.csv" 2>"$work/err"
    expect "SIGINT within a step of a day, $scheme: status" 130 $? "$work/err"
    t=$(tail -n 1 "$work/out.csv" | cut -d , -f 1)
    expect "SIGINT within a step of a day, $scheme: the record where it ended, and its state" "3 $t cut" \
        "$(wc -l <"$work/out.csv") $(sed -n 's/^"t": \(.*\),$/\1/p' "$work/day.json") $(sed -n 's/^"last_step": "\(.*\)",$/\1/p' "$work/day.json")" "$work/out.csv"
    until=$(awk "BEGIN { printf \"%.3f\", $t + 0.1 }")
    cp decks/double-pendulum.yaml "$work"
    (cd "$work" && "$FMDSUB" run -q -s "integrate={scheme: $scheme, tolerance: 1.0e-9, until: $until}" --every 86400 \
        --columns pin1.angle -s 'initial={from: day.json, time: keep}' double-pendulum.yaml) >"$work/on.csv" 2>"$work/err"
    expect "SIGINT within a step of a day, $scheme: it goes on" "0 $(tail -n 1 "$work/out.csv") $until" \
        "$? $(sed -n 2p "$work/on.csv") $(tail -n 1 "$work/on.csv" | cut -d , -f 1 | awk '{ printf "%.3f", $1 }')" "$work/err"
done

# A major step of a million minor ones, of 2 to 20 s, is given up: the run ends where that began, with its record.
for scheme in subcycle 'subcycle, order: 4' 'subcycle, symmetric: true' miao daniel neal-belytschko; do
    began=$(date +%s%N)
    timeout --preserve-status -k 60 -s TERM 0.3 "$FMDSUB" run -q -s "integrate={scheme: $scheme, step: 1.0e-7, ratio: 1000000, until: 2}" \
        --every 2 --columns hub.angle --final-state "$work/major.json" decks/bar-slider.yaml >"$work/out.csv" 2>"$work/err"
    expect "SIGTERM within a major step, $scheme: status" 143 $? "$work/err"
    took=$((($(date +%s%N) - began) / 1000000))
    [ $took -lt 1300 ] && [ -s "$work/out.csv" ] && ok "SIGTERM within a major step, $scheme: at once" || not_ok "SIGTERM within a major step, $scheme: at once" "$took ms"
    t=$(tail -n 1 "$work/out.csv" | cut -d , -f 1) # 0, or where the first major step ended, of a scheme that had it behind it
    expect "SIGTERM within a major step, $scheme: a record where that began, a state that says so" "1 $t cut" \
        "$(awk -F, 'NR > 1 && ($1 != 0.1 * (NR - 2) || NR == 2 && $2 != 0) { bad = 1 } END { print !bad && (NR == 2 || NR == 3) }' "$work/out.csv") $(sed -n 's/^"t": \(.*\),$/\1/p' "$work/major.json") $(sed -n 's/^"last_step": "\(.*\)",$/\1/p' "$work/major.json")" "$work/out.csv"
done

# Writing to a pipe that nobody reads: still whole records, and it ends.
{ timeout --preserve-status -k 5 -s INT 0.5 "$FMDSUB" run --every 1.0e-3 --until 1.0e+5 "$deck" 2>/dev/null; echo $? >"$work/rc"; } |
    { sleep 1; cat >"$work/out.csv"; }
expect "SIGINT on a blocked pipe: status" 130 "$(cat "$work/rc")"
whole "SIGINT on a blocked pipe: records whole" "$work/out.csv"

# -o after SIGINT: the part file stays under its own name.
(cd "$work" && timeout --preserve-status -s INT 0.5 "$FMDSUB" run --every 1.0e-3 --until 1.0e+5 -o out.dat "$deck" 2>err)
expect "SIGINT with -o: status" 130 $? "$work/err"
if [ -s "$work/out.dat.part" ] && [ ! -e "$work/out.dat" ]; then ok "SIGINT with -o: kept as .part"
else not_ok "SIGINT with -o: kept as .part" "$(ls "$work" | tr '\n' ' ')" "$work/err"; fi

# timeout(1) tells its child and then its group: one wish, said twice within microseconds.  What must close is closed.
for signal in INT:130 TERM:143 HUP:129 XCPU:7; do
    for format in json ndjson; do
        timeout --preserve-status -s "${signal%:*}" 0.3 "$FMDSUB" run -f $format --every 1.0e-3 --until 1.0e+5 "$deck" >"$work/out" 2>"$work/err"
        expect "SIG${signal%:*}, $format: status" "${signal#*:}" $? "$work/err"
        tail -n 1 "$work/out" | grep -q '"exit":'"${signal#*:}"'.*}$' && ok "SIG${signal%:*}, $format: closed by its summary" ||
            not_ok "SIG${signal%:*}, $format: closed by its summary" "the last line is another" "$work/err"
    done
done

# A second signal, later, ends at once.  timeout(1) hands it on; a job in the background alone would have it ignored.
mkfifo "$work/pipe"
sleep 2 <"$work/pipe" &
timeout --foreground --preserve-status 60 "$FMDSUB" run --every 1.0e-3 --until 1.0e+5 "$deck" >"$work/pipe" 2>"$work/err" &
pid=$!
sleep 0.5
kill -INT $pid
sleep 0.3
kill -INT $pid
wait $pid
expect "a second SIGINT ends a run that waits for its reader" 130 $?
wait

# While the deck is still to come: from a pipe that says nothing, or one that nobody opens.
mkfifo "$work/silent"
sleep 3 >"$work/silent" &
timeout --preserve-status -k 1 -s INT 0.3 "$FMDSUB" run - <"$work/silent" 2>"$work/err"
expect "SIGINT while standard input is read" 130 $? "$work/err"
wait
timeout --preserve-status -k 1 -s TERM 0.3 "$FMDSUB" run "$work/silent" 2>"$work/err"
expect "SIGTERM while a named pipe waits for its writer" 143 $? "$work/err"

# A limit says which it is, also without the end line; in the summary, too.
limited() { timeout --preserve-status -s XCPU 0.3 "$FMDSUB" "$@" "$deck" >"$work/out" 2>"$work/err"; }
limited run -q --every 1.0e-3 --until 1.0e+5
expect "run -q, SIGXCPU: one line that says so" "7 1 1" \
    "$? $(wc -l <"$work/err") $(grep -c 'stopped at t = .* s: the limit of CPU time is reached' "$work/err")" "$work/err"
limited run -f ndjson --every 1.0e-3 --until 1.0e+5
tail -n 1 "$work/out" | grep -q '"status":"CPU time limit reached","exit":7' && ok "SIGXCPU in the summary" ||
    not_ok "SIGXCPU in the summary" "the last line:" "$work/err"

# A study ends by the same codes.
for signal in INT:130 TERM:143 HUP:129 XCPU:7; do
    timeout --preserve-status -s "${signal%:*}" 0.3 "$FMDSUB" study -q --repeats 1000 --until 10 "$deck" >"$work/out" 2>"$work/err"
    expect "study, SIG${signal%:*}: status" "${signal#*:}" $? "$work/err"
done
grep -q 'the limit of CPU time is reached' "$work/err" && ok "study, SIGXCPU: says so" || not_ok "study, SIGXCPU: says so" "stderr:" "$work/err"

# What the caller had ignored, as nohup does, stays so.
for signal in INT HUP TERM; do
    (trap '' $signal; exec "$FMDSUB" run -q --every 10 --until 1000 "$deck" >"$work/out" 2>"$work/err") &
    sleep 0.1
    kill -$signal $!
    wait $!
    expect "SIG$signal, ignored by the caller" "0 1000" "$? $(tail -n 1 "$work/out" | cut -d , -f 1)" "$work/err"
done

# A static start that is not found for 66 steps of 768 coordinates, 4 s and more: given up at once.  Blades 80 m long at 8000 rpm.
sed 's/to: .R, 0./to: [R, 80]/; s/i: .1, 2./i: [1, 4]/' tests/decks/airscrew-pull.yaml >"$work/blade.yaml"
for verb in run 'check --no-trial'; do
    timeout --preserve-status -k 60 -s INT 0.5 "$FMDSUB" $verb "$work/blade.yaml" >"$work/out" 2>"$work/err"
    expect "SIGINT on the way to rest, ${verb%% *}: status, words" "130 0" "$? $(grep -c 'equilibrium' "$work/err")" "$work/err"
done
(ulimit -S -t 1 && exec "$FMDSUB" check --no-trial "$work/blade.yaml") >"$work/out" 2>"$work/err"
expect "the limit of CPU time on the way to rest" "7 1" "$? $(grep -c 'the limit of CPU time is reached' "$work/err")" "$work/err"

# Verbs that solve for eigenvalues, of some hundred numbers for seconds to minutes, or run a deck many times: given up at once.
cat >"$work/many.yaml" <<E
fmdsub: 1
gravity: [0, -9.81]
bodies:
  link\$i: {repeat: {i: [1, 200]}, mass: 1, inertia: 1/12, at: [i - 0.5, 0]}
constraints:
  pin1: {revolute: [ground, link1], at: [0, 0]}
  pin\$i: {repeat: {i: [2, 200]}, revolute: [link\$(i-1), link\$i], at: [i - 1, 0]}
forces:
  jet: {force: link200, value: [5, 0], frame: body}
integrate: {until: 1}
E
for verb in 'stability decks/soft-pendulum.yaml' 'modes decks/many.yaml' 'explain decks/bent-arm.yaml'; do
    began=$(date +%s%N)
    timeout --preserve-status -k 20 -s TERM 0.5 "$FMDSUB" ${verb%% *} "$(echo "${verb#* }" | sed "s|decks/many|$work/many|")" >"$work/out" 2>"$work/err"
    expect "SIGTERM, ${verb%% *}: status, no rows" "143 0" "$? $(wc -l <"$work/out")" "$work/err"
    took=$((($(date +%s%N) - began) / 1000000))
    [ $took -gt 400 ] && [ $took -lt 3000 ] && ok "SIGTERM, ${verb%% *}: at once" || not_ok "SIGTERM, ${verb%% *}: at once" "$took ms"
done
