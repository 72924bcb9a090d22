# resume.sh -- checkpoints: runs that are killed at random and go on are byte for byte those that were not, until KILLS (9)
# have been survived, from SEED (1) on; what is no checkpoint of this run is refused, and the records stay as they are.
. tests/tools/lib.sh
cd "$work" || exit 1
KILLS=${KILLS:-9} SEED=${SEED:-1}

# DECK, form, major steps between checkpoints, settings: rigid, loops, flexible, of two rates, steps of their own, impacts.
cat >scenes <<SCENES
$ROOT/decks/four-bar.yaml csv 5 integrate={scheme: dop853, tolerance: 1.0e-7, until: 20}
$ROOT/decks/four-bar.yaml csv 3 integrate={scheme: dop853, tolerance: 1.0e-6, until: 20}
$ROOT/decks/four-bar.yaml csv 7 integrate={scheme: dop853, tolerance: 1.0e-8, until: 20}
$ROOT/decks/double-pendulum.yaml csv 50 integrate.until=3
$ROOT/decks/four-bar.yaml ndjson 40 integrate.until=1
$ROOT/decks/flexible-robot.yaml csv 25 integrate.until=0.3
$ROOT/decks/suspension.yaml ndjson 30 integrate.until=2
$ROOT/decks/bar-slider.yaml csv 20 integrate.until=5
$ROOT/decks/heavy-top.yaml csv 20 integrate={scheme: dopri5, tolerance: 1.0e-9, until: 1.5}
$ROOT/decks/heavy-top.yaml csv 5 integrate={scheme: radau9, tolerance: 1.0e-7, until: 1}
$ROOT/decks/telescope.yaml csv 5 integrate={scheme: auto, tolerance: 1.0e-5, until: 4}
$ROOT/decks/soft-pendulum.yaml ndjson 20 integrate={scheme: subcycle, step: 1.0e-3, ratio: 5, until: 3}
$ROOT/decks/bearing.yaml csv 20 integrate.until=0.5
SCENES
cat >ball.yaml <<'DECK'
fmdsub: 1
gravity: [0, -9.81]
bodies: {ball: {mass: 1, at: [0, 1]}}
constraints:
  rail: {prismatic: [ground, ball], at: [0, 0], axis: [0, 1], range: {lower: -1, upper: 10, hold: {restitution: 0.8}}}
integrate: {scheme: midpoint, step: 1.0e-3, until: 6}
output: {every: 0.01, columns: [rail.*, energy.*]}
DECK
echo "$work/ball.yaml ndjson 20 integrate.until=6" >>scenes # bodies that strike
echo "$ROOT/decks/bounce-and-roll.yaml csv 5 integrate={tolerance: 1.0e-6, until: 2}" >>scenes # ... in steps of their own
sed 's/integrate: .*/integrate: {scheme: subcycle, step: 1.0e-4, ratio: 10, until: 6}/; s/^  rail:/  knob: {prismatic: [ball, pea], axis: [0, 1]}\n&/; s/^bodies: {/&pea: {mass: 0.1, at: [0, 1.2]}, /; $a forces: {s: {spring: knob.displacement, stiffness: 4000}}\npartition: {fast: [knob]}' ball.yaml >peas.yaml
echo "$work/peas.yaml csv 20 integrate.until=3" >>scenes # ... at two rates

sed -n '/^fmdsub: 1$/,/^DECK$/p' "$ROOT/tests/hard/coupler.sh" | sed '/^DECK$/d' >coupler.yaml
echo "$work/coupler.yaml csv 10 integrate={scheme: subcycle, step: 1.0e-3, ratio: 20, guard: act, until: 0.3}" >>scenes # damped on the way

# A run that may be killed after so many seconds; 137 when it was.
keep() { # SECONDS ARGUMENT...
    seconds=$1
    shift
    for wait in 1 2 3 4 5 6 7 8 9; do # one that was killed may still be about to die, with its files open
        timeout -s KILL "$seconds" "$FMDSUB" run -q -f "$form" --set "checkpoint={every: {steps: $every}, file: kept}" --set "$set" -o part "$@" "$deck" >/dev/null 2>err
        kept_rc=$?
        [ $kept_rc = 6 ] && grep -q 'another process' err || return $kept_rc
        sleep 0.2
    done
}

dice() { awk -v seed="$1" 'BEGIN { srand(seed); printf "%.4f\n", rand() }'; }

kills=0 trial=0 wrong=0
while [ "$kills" -lt "$KILLS" ] && [ "$trial" -lt $((3 * KILLS + 20)) ]; do
    line=$(awk -v n="$trial" '{ l[NR - 1] = $0 } END { print l[n % NR] }' scenes)
    deck=${line%% *} rest=${line#* }
    form=${rest%% *} rest=${rest#* }
    every=${rest%% *} set=${rest#* }
    whole=whole.$(echo "$line" | cksum | cut -d ' ' -f 1)
    rm -f part part.part kept
    if [ ! -f "$whole" ]; then
        start=$(date +%s%N)
        keep 60
        rc=$?
        [ $rc -le 1 ] && [ -s part ] || { not_ok "resume: ${deck##*/}" "exit $rc without being killed" err; trial=$((trial + 1)); continue; }
        echo $((($(date +%s%N) - start) / 1000000)) >"$whole.time"
        mv part "$whole"
        rm -f kept
    fi
    died=0
    for try in 1 2 3 4 5 6 7 8 9; do
        # Between a tenth of the run's time and all of it, in seconds.
        seconds=$(awk -v ms="$(cat "$whole.time")" -v x="$(dice $((SEED * 1000003 + trial * 101 + try)))" 'BEGIN { printf "%.4f", ms / 1000 * (.1 + .9 * x) + .005 }')
        [ $try = 9 ] && seconds=60
        if [ -f kept ]; then keep "$seconds" --resume kept
        else keep "$seconds"; fi
        rc=$?
        [ $rc = 137 ] || break
        died=$((died + 1))
        printf '0.123,4' >>part.part # a record that is cut
    done
    kills=$((kills + died))
    cmp -s "$whole" part || { wrong=$((wrong + 1)); not_ok "resume: ${deck##*/} killed $died times" "exit $rc, bytes differ, trial $trial" err; }
    trial=$((trial + 1))
done
[ "$wrong" = 0 ] && [ "$kills" -ge "$KILLS" ] && ok "resume: $kills kills in $trial runs of $(wc -l <scenes) scenes, all byte-identical"
[ "$kills" -ge "$KILLS" ] || not_ok "resume: kills" "only $kills of $KILLS runs could be killed"

# One that is written at the end holds what the final state remembers, under the same names, and what the run says of itself; and what
# has been factored last, which at the end of a run is something else.
for line in "double-pendulum 50 until=1" "four-bar 20 until=1" "flexible-robot 10 until=0.1" "bearing 10 until=0.02"; do
    deck=$ROOT/decks/${line%% *}.yaml rest=${line#* }
    rm -f kept end.json
    "$FMDSUB" run -q --stats --set "checkpoint={every: {steps: ${rest% *}}, file: kept}" --set "integrate.${rest#* }" --final-state end.json "$deck" >all 2>stats
    sed -n '/"memory": {/,/}/p' end.json | tr -d '{},"' | sed 's/^ *//; s/: */ /; s/^memory *//; s/^of_steps 0*/owner.steps /; s/ *$//; /^$/d' | sort >want
    sed '1d; s/ *$//; /^run\./d; /^owner\.[df]/d; /^loops.tangent.f/d' kept | sort >got
    grep -q . want && same "checkpoint at the end: ${line%% *}, what the final state remembers" want got
    for pair in major_steps:step minor_steps:effort.minors slow_evaluations:effort.slow fast_evaluations:effort.fast \
        factorizations:effort.factors sweeps:effort.sweeps rejected:effort.rejected rows:rows; do
        is=$(awk -v name="run.${pair#*:}" '$1 == name { print $2 }' kept)
        told=$(awk -v name="${pair%%:*}" '$1 == name { print $2 }' stats)
        [ $((0x$is)) = "$told" ] || echo "$pair $is $told"
    done >wrong
    expect "checkpoint at the end: ${line%% *}, what the run says of itself" "" "$(cat wrong)" stats
    expect "checkpoint at the end: ${line%% *}, bytes and rows of records" "$(wc -c <all) $(($(wc -l <all) - 1))" \
        "$((0x$(awk '$1 == "run.bytes" { print $2 }' kept))) $((0x$(awk '$1 == "run.rows" { print $2 }' kept)))"
done

# On standard output the rest comes alone, without a head.
deck=$ROOT/decks/double-pendulum.yaml form=csv every=50 set=integrate.until=1
kept() { "$FMDSUB" run -q -f "$form" --set "checkpoint={every: {steps: $every}, file: kept}" --set "$set" "$@"; }
rm -f kept
kept "$deck" >all 2>err
bytes=$(awk '$1 == "run.bytes" { print $2 }' kept)
kept --resume kept "$deck" >rest 2>err
head -c $((0x$bytes)) all >joined; cat rest >>joined
[ $((0x$bytes)) -gt 0 ] && same "resume on standard output: the first part and the rest" all joined

refuse() { # NAME STATUS PATTERN ARGUMENT...
    name=$1 want=$2 pattern=$3
    shift 3
    kept "$@" >out 2>err
    rc=$?
    if [ $rc = "$want" ] && grep -q -- "$pattern" err; then ok "resume refused: $name"; else not_ok "resume refused: $name" "exit $rc, expected $want and: $pattern" err; fi
}
cp kept good
sed '6s/$/0/' good >bad; refuse "a figure changed" 6 "damaged" --resume bad "$deck"
head -c 300 good >bad; refuse "cut" 6 "damaged" --resume bad "$deck"
echo something >bad; refuse "no checkpoint" 6 "no checkpoint" --resume bad "$deck"
refuse "no file" 6 "cannot read" --resume none "$deck"
refuse "what does not end" 6 "no plain file" --max-memory 100M --resume /dev/zero "$deck"
refuse "another deck" 4 "another deck" --resume good --set gravity.1=-9 "$deck"
refuse "another end" 4 "another deck.*--set and --until as they were" --resume good --until 2 "$deck"
refuse "json" 2 "csv or ndjson" -f json "$deck"
refuse "records of another form" 4 "not in form" --resume good -f ndjson "$deck"
refuse "no part to go on with" 6 "nothing to go on with" --resume good -o nowhere "$deck"
echo "0,1" >short.part; refuse "a part that is too short" 6 "when the checkpoint was written" --resume good -o short "$deck"
expect "and the part stays as it was" "0,1" "$(cat short.part)"
echo mine >kept; refuse "a file that is something else" 6 "something else" "$deck"
expect "and that stays, too" mine "$(cat kept)"
rm -f kept
"$FMDSUB" check --set "checkpoint={every: 1, file: ../x}" "$deck" >out 2>err
expect "resume: a plain name" "3 1" "$? $(grep -c 'E-checkpoint' err)" err
"$FMDSUB" run -q --set "checkpoint={every: 0.25, file: kept}" "$deck" >out 2>err
expect "resume: every so many seconds" "0 1" "$? $(grep -c '^run.t ' kept)" err
