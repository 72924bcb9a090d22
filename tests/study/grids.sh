# grids.sh -- what a study tries, by what the deck and the options say of steps, tolerances and ratios; what it leaves out of a
# comparison; a run of which nothing can be compared.
. tests/tools/lib.sh
cd "$work" || exit 1
cp "$ROOT"/decks/*.yaml .
tried() { awk -F, 'NR > 1 { print $1 ($19 > 2 ? "-" $19 : "") ($4 > 1 ? ":" $4 : "") }' rows | sort | uniq -c | awk '{ printf "%s%s", sep, $2; sep = " " }'; }

# Ratios by name are all tried, of order 2 and of order 4; with steps there is order 2 alone, at those steps.
"$FMDSUB" study -q --repeats 0 --until 0.1 --schemes subcycle --ratios 2,4 bar-slider.yaml >rows 2>err
expect "--ratios: status, what is tried" "0 subcycle subcycle-4:2 subcycle-4:4" "$? $(tried)" rows err
"$FMDSUB" study -q --repeats 0 --until 0.1 --schemes daniel --ratios 2,5 --steps 0.001 bar-slider.yaml >rows 2>err
expect "--ratios and --steps: status, what is tried" "0 daniel:2 daniel:5" "$? $(tried)" rows err

# Without, order 4 is tried at the deck's ratio, and at a fifth of it where that is more than one.
for ratio in 5 10; do
    "$FMDSUB" study -q --repeats 0 --until 0.1 --schemes subcycle -s integrate.ratio=$ratio bar-slider.yaml >rows 2>err
    expect "a deck of ratio $ratio: order 4 at it, at a fifth of it, at 1" "1 $((ratio / 10)) 0" \
        "$(tried | tr ' ' '\n' | grep -c "^subcycle-4:$ratio\$") $(tried | tr ' ' '\n' | grep -c '^subcycle-4:2$') $(tried | tr ' ' '\n' | grep -c '^subcycle-4$')" rows err
done

# The deck's own setting by a tolerance is the first row and has its sentence.
"$FMDSUB" study --repeats 0 --until 0.1 -s 'integrate={scheme: dop853, tolerance: 3.0e-5, until: 1}' pendulum.yaml >rows 2>err
expect "a deck with a tolerance: status, its row, its sentence" "0 1 1" \
    "$? $(grep -c '^dop853,0.00003,,1,' rows) $(grep -c "^the deck's own setting, dop853 at tolerance 3e-05: error " err)" rows err

# Its own setting by order 4.
"$FMDSUB" study --repeats 0 --until 0.1 -s integrate.order=4 bar-slider.yaml >rows 2>err
expect "a deck of order 4: status, its sentence" "0 1" "$? $(grep -c "^the deck's own setting, subcycle of order 4 at step 0.001 s, ratio 5: " err)" rows err

# Rigid contacts: schemes that cut their steps at them, and no other.
"$FMDSUB" study --repeats 0 --until 0.5 bounce-and-roll.yaml >rows 2>err
expect "contacts: status, schemes" "0 midpoint" "$? $(tried)" rows err

# An error that a pick of order 4 meets is in its lines, which a deck includes.
"$FMDSUB" study -q --repeats 0 --until 0.1 --schemes subcycle --ratios 3 --pick 1e-3 bar-slider.yaml >pick.yaml 2>err
expect "--pick of order 4: status, its lines" "0   ratio: 3   order: 4" "$? $(sed -n '/ratio:/p; /order:/p' pick.yaml | tr '\n' ' ' | sed 's/ $//')" pick.yaml err

# Chaos far beyond its horizon: no reference, and what parted is named.
sed 's/^gravity:.*/gravity: [0, -981]/' double-pendulum.yaml >wild.yaml
"$FMDSUB" study -q --schemes midpoint --steps 1.0e-3 --repeats 0 --budget 1 --set output.every=0.1 --until 200 wild.yaml >rows 2>err
expect "chaos far beyond: status, rows, words" "5 0 1" "$? $(wc -l <rows) $(grep -c '^fmdsub: dop853 and dopri5 part after t = [0-9.]* s: nothing to compare with' err)" rows err

# Where no column is of the motion there is no error to rank by: no number, and nothing picked.
"$FMDSUB" study -q --repeats 0 --schemes rk4 --steps 0.01 --until 1 -s output.columns=[energy.residual] pendulum.yaml >rows 2>err
expect "no column of the motion: status, rows, error" "0 2 " "$? $(wc -l <rows | tr -d ' ') $(awk -F, 'NR == 2 { print $5 }' rows)" rows err
"$FMDSUB" study -q --repeats 0 --schemes rk4 --steps 0.01 --until 1 -s output.columns=[energy.residual] --absolute --pick 1 pendulum.yaml >rows 2>err
expect "no column of the motion: nothing is picked" "1 0" "$? $(wc -l <rows)" rows err

# How often a run is timed where --repeats does not say: the fastest of the times, and the same rows.
"$FMDSUB" study -q --until 0.1 --schemes rk4 --steps 0.01 pendulum.yaml >rows 2>err
expect "timed: status, a time, its ratio to the first" "0 1 1" "$? $(awk -F, 'NR == 2 { print ($10 > 0), $11 }' rows)" rows err
"$FMDSUB" study -q --until 0.1 --schemes rk4 --steps 0.01 --absolute -f json pendulum.yaml >rows 2>err
expect "timed, --absolute, -f json: status, a unit" "0 1" "$? $(grep -c '"unit":"N"' rows)" rows err

# What is left out is looked at by a second run by the scheme that auto has chosen for the first.
"$FMDSUB" run -s effects.rotary=false -s integrate.scheme=auto -s integrate.tolerance=1e-4 --until 0.01 flexible-crank.yaml >rows 2>err
expect "left out, beside scheme: auto: status, words" "0 1 1" "$? $(grep -c '^auto: ' err | awk '{ print ($1 > 0) }') $(grep -c '^left out: rotary: about .* by a second run with it' err)" err

# With scheme: auto and a step, for a short run: a relay where order 8 takes less than half the midpoint rule at that step, and it if not.
cat >spring.yaml <<'YAML'
fmdsub: 1
bodies: {b: {mass: 1, inertia: 1, at: [0, 0]}}
constraints: {rail: {prismatic: [ground, b], axis: [1, 0], at: [0, 0]}}
forces: {f: {spring: rail, stiffness: 10}}
initial: {rail.displacement: 0.1}
integrate: {scheme: auto, step: 1.0e-3, until: 2}
output: {every: 0.5, columns: [rail.displacement]}
YAML
for step in '1.0e-3 a relay of dop853 and radau9' '0.1 midpoint'; do
    "$FMDSUB" run -s "integrate.step=${step%% *}" spring.yaml >rows 2>err
    expect "auto by a step of ${step%% *} s: status, what is taken" "0 1" "$? $(grep -c "^auto: ${step#* } .*: too short a run for trials to pay" err)" err
done

# Contacts and a budget for a part of the run: the end of what is compared is told.
"$FMDSUB" study --repeats 0 --budget 0.001 bounce-and-roll.yaml >rows 2>err
expect "contacts, a small budget: status, words" "0 1" "$? $(grep -c '^the budget takes it to t = [0-9.]* s of 3: errors are compared up to there' err)" rows err

# A deck that damps what is fast: order 4, which cannot, is not tried, and the rest is.
for scheme in subcycle generalized-alpha; do
    "$FMDSUB" study --repeats 0 --until 0.2 -s integrate.scheme=$scheme -s integrate.rho_infinity=0.8 bar-slider.yaml >rows 2>err
    expect "$scheme that damps: status, its sentence, rows of order 4" "0 1 0" \
        "$? $(grep -c "^the deck's own setting, $scheme at step 0.001 s" err) $(awk -F, 'NR > 1 && $19 > 2 { n++ } END { print n + 0 }' rows)" rows err
done
