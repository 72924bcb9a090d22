# refused.sh -- what verbs do not take: the status, one line that says why, nothing on stdout, and both sides of each limit.
. tests/tools/lib.sh
deck=$ROOT/decks/pendulum.yaml
cd "$work" || exit 1
cp "$deck" deck.yaml
"$FMDSUB" run -q --every 1 -o rec.csv deck.yaml
many() { seq -s , 1 "$1"; }

# Lists of choices.
refuse 2 '--steps: more than 64' study --steps "$(many 65)" deck.yaml
refuse 2 '--schemes names no scheme' study --schemes , deck.yaml
refuse 2 '--tolerances: at most 0.1' study --tolerances 1e-3,0.2 deck.yaml
refuse 2 '--tolerances: at least 1e-14' study --tolerances 1e-3,1e-15 deck.yaml
refuse 2 '--repeats takes one number' study --repeats 1,2 deck.yaml
refuse 2 '--script and --pick both print on stdout' study --script --plot x.svg --pick 1e-3 deck.yaml
refuse 2 "budget takes seconds, or none, not 'x'" study --budget x deck.yaml
refuse 2 "budget takes seconds, or none, not '0'" study --budget 0 deck.yaml
refuse 2 "budget takes seconds, or none, not 'inf'" study --budget inf deck.yaml
refuse 2 "pick takes one error, not '1e-3,1e-4'" study --pick 1e-3,1e-4 deck.yaml
refuse 2 'chooses its own steps: it has no map' stability --schemes dopri5 deck.yaml
refuse 2 'prints csv or json' stability -f ndjson deck.yaml
refuse 4 'no coordinate of this deck moves freely' stability -s 'drives={d: {drive: pin.angle, value: t}}' -s initial.pin.angle=0 deck.yaml

# Numbers of diff.
refuse 2 '--rel names no number' diff --rel , rec.csv rec.csv
refuse 2 '--abs names no number' diff --abs , rec.csv rec.csv

# Words.
refuse 2 "no code 'E-nothing'" explain E-nothing
refuse 2 "are for 'fmdsub explain DECK'" explain -f json E-tab
refuse 2 "no list of 'wheels'" list wheels
refuse 2 "no list of 'joint'.*joints" list joint
refuse 2 "only 'fmdsub list columns DECK' reads one" list -s a=1 joints
refuse 2 "no starter deck 'house'" new house
refuse 2 "no starter deck 'pendulm'.*pendulum" new pendulm
refuse 2 "unknown verb 'zzz' (fmdsub --help)" zzz
refuse 2 "unknown option '--zzzzzz' (fmdsub --help)" run --zzzzzz deck.yaml
refuse 2 "option '--until' needs a value" run deck.yaml --until
refuse 2 '--columns names no column' run --columns '' deck.yaml
refuse 2 "takes no argument: it is the same for all decks" schema deck.yaml

# Instants and records.
refuse 2 "at takes a time, not '-1'" modes --at -1 deck.yaml
refuse 7 'major steps away: the limit is' modes --at 1e20 deck.yaml
refuse 2 "is for decks: 'rec.csv' holds records already" plot --script --until 1 rec.csv
refuse 2 'checkpoints are of records as csv or ndjson' run -f json -o x.json -s 'checkpoint={file: c.json, every: 1}' deck.yaml
"$FMDSUB" animate -q --every 20 --until 20 -o one.html deck.yaml >out 2>err
ended "two records move" 0 $? one.html err
refuse 6 'none/x.csv' run -q -o none/x.csv deck.yaml
refuse 6 'none/x.csv' diff -o none/x.csv rec.csv rec.csv

# --strict counts warnings about the deck.
for verb in 'check -q --no-trial' 'run -q'; do
    "$FMDSUB" $verb --strict -s 'bodies.ball.inertia=0' -s 'partition={fast: [pin]}' deck.yaml >out 2>err
    rc=$?
    n=$(grep -c ': warning: ' err)
    expect "--strict, ${verb%% *}: status, the count" "1 1" "$rc $(grep -c "strict: $n warning(s) about the deck" err)" err
done

# Sweeps.
cat >swept.yaml <<'DECK'
fmdsub: 1
parameters: {k: 10}
bodies: {ball: {mass: 1, inertia: 0.1, at: [1, 0]}}
constraints: {pin: {revolute: [ground, ball], at: [0, 0]}}
forces: {s: {spring: pin, stiffness: k}}
initial: {pin.angle: 0.3}
integrate: {scheme: midpoint, step: 1.0e-2, until: 0.1}
output: {every: 0.1, columns: [pin.angle]}
DECK
over="--over parameters.k=1:2:2"
refuse 2 'goes on with the rows of --output FILE' sweep $over --of 'last(pin.angle)' --resume swept.yaml
refuse 2 'reads its deck anew at each point: a file' sweep $over --of 'last(pin.angle)' -
refuse 2 "no column matches 'pin.angel'; did you mean 'pin.angle'" sweep $over --of 'last(pin.angel)' swept.yaml
refuse 2 'nothing is drawn; --over' sweep $over --of 'last(pin.angle)' --sample 3 swept.yaml
: >none.csv
refuse 6 'the files are empty' sweep --merge none.csv

# A zero byte in a number: told once, not as a wrong number besides.
sed 's/mass: 1,/mass: "1\\0x",/' swept.yaml >zero.yaml
"$FMDSUB" check zero.yaml >out 2>err
expect "a zero byte in a number: status, one error" "3 1 1" "$? $(grep -c ': error: ' err) $(grep -c 'E-character' err)" err
