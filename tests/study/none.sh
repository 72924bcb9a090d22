# none.sh -- studies of which nothing comes: they do not pass for whole.
. tests/tools/lib.sh
cd "$work" || exit 1
cp "$ROOT"/decks/*.yaml .

# Settings that the deck's records do not take: told before anything is run, no heading on stdout, no file.
nothing() { # NAME STATUS PATTERN ARGUMENT...
    nothing_name=$1 want=$2 pattern=$3
    shift 3
    for form in csv json ndjson; do
        "$FMDSUB" study -q --repeats 0 -f $form "$@" >out 2>err
        expect "$nothing_name, $form: status, bytes, words" "$want 0 1" "$? $(wc -c <out) $(grep -c "$pattern" err)" out err
    done
}
nothing "steps longer than records are apart" 3 'every 0.5 s is shorter than the major step, 1 s' --steps 1 pendulum.yaml
nothing "one of the steps" 3 'every 0.5 s is shorter than the major step, 1 s' --steps 1e-3,1 --schemes midpoint pendulum.yaml
"$FMDSUB" study -q --repeats 0 --steps 1 -o none.csv pendulum.yaml >out 2>err
expect "with -o: status, no file" "3 none" "$? $([ -e none.csv ] && echo file || echo none)" err

# Every run stops: the rows say so, and so does the status.
stiff="--schemes rk4 --until 10 --set output.every=1 stiff-leaf-chain.yaml"
"$FMDSUB" study -q --repeats 0 --steps 0.5 $stiff >out 2>err
expect "every run stops: status, rows, words" "5 2 1 1" "$? $(wc -l <out) $(grep -c '^rk4,,0.5,.*,stopped,' out) $(grep -c 'no setting ran to its end' err)" out err
"$FMDSUB" study -q --repeats 0 --steps 0.5 -o all.csv $stiff >out 2>err
expect "every run stops, -o: status" 5 $? err
"$FMDSUB" study -q --repeats 0 --steps 0.5 --until 10 --schemes midpoint,rk4 --set output.every=1 stiff-leaf-chain.yaml >out 2>err
expect "one of two runs stops: status, rows" "0 1 1" "$? $(grep -c "^midpoint,,0.5,.*,[ou][kn][a-z]*," out) $(grep -c '^rk4,,0.5,.*,stopped,' out)" out err

# Nothing but the heading: no setting was worth a run.
"$FMDSUB" study -q --repeats 0 --schemes rk4 --steps 1.0e-6 --budget 0.1 stiff-leaf-chain.yaml >out 2>err
expect "nothing within the budget: status, rows, words" "7 1 1" "$? $(wc -l <out) $(grep -c 'no setting was run: ' err)" out err

# Not even that: the reference does not reach a record behind the start.
"$FMDSUB" study -q --repeats 0 --schemes rk4 --budget 0.02 flexible-crank.yaml >out 2>err
expect "no record within the budget: status, rows, words" "7 0 1" "$? $(wc -l <out) $(grep -c '^fmdsub: no reference: the budget .*--budget' err)" out err

# No column by which errors could be known: it says so, and what to do, and promises no error.
cat >none.yaml <<'YAML'
fmdsub: 1
bodies: {m: {mass: 1, inertia: 1, at: [0, 0]}}
constraints: {r: {prismatic: [ground, m], axis: [1, 0]}}
forces: {k: {spring: r, stiffness: 100}}
initial: {r.displacement: 0.1}
integrate: {scheme: newmark, step: 0.01, until: 2}
output: {every: 0.02, columns: [r.displacement]}
YAML
for columns in '[step.h]' '[energy.residual, step.ratio]' '[energy.drive]'; do
    "$FMDSUB" study --repeats 0 --steps 1e-2,1e-3 --set "output.columns=$columns" none.yaml >out 2>err
    expect "nothing to compare, $columns: words" "1 1 0" "$(grep -c 'none of the deck.s columns can be compared' err) $(grep -c 'let it write places, angles or rates' err) $(grep -c 'none of these runs\|error nan' err)" err
done
"$FMDSUB" study --repeats 0 --steps 1e-2,1e-3 none.yaml >out 2>err
expect "something to compare: words" "0 3" "$(grep -c 'can be compared' err) $(grep -c '^error below' err)" err
