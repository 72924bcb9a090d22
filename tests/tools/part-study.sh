# part-study.sh -- statements about accuracy and cost, shown by `fmdsub study` itself.
. tests/tools/lib.sh
need_program study

# The fast error of `subcycle` at n = $3 in table $2 (deck $1) is at most 1.5 times that of the single rate at the small
# step, and with $4 = slow so is the slow one; `miao` is shown beside it.
as_near() {
    awk -F, -v n="$3" -v both="${4:-}" '
        $1 == "midpoint" { fast = $7; slow = $8 }
        $1 == "subcycle" && $4 == n { f = $7; s = $8; state = $16 }
        $1 == "miao" && $4 == n { mf = $7; ms = $8; mstate = $16 }
        END {
            printf "fast error %.3g against %.3g (%.2f), slow %.3g against %.3g; miao fast %.3g, slow %.3g (%s)\n",
                f, fast, f / fast, s, slow, mf, ms, mstate
            exit !(fast > 0 && f <= 1.5 * fast && (both == "" || s <= 1.5 * slow) && state == "ok")
        }' "$2" >"$work/line"
    if [ $? = 0 ]; then ok "$1 n=$3: $(cat "$work/line")"; else not_ok "$1 n=$3" "$(cat "$work/line")" "$work/err"; fi
}

# The chain with stiff leaf joints, plucked.
"$FMDSUB" study -q --schemes midpoint,subcycle,miao --ratios 5,10,20 --steps 1.0e-4 --repeats 1 \
    decks/stiff-leaf-chain.yaml >"$work/chain.csv" 2>"$work/err"
for n in 5 10 20; do as_near stiff-leaf-chain "$work/chain.csv" $n; done

# Two references, by different schemes, agree on every shipped deck that is studied.
for deck in bar-slider double-pendulum stiff-leaf-chain heavy-top; do
    "$FMDSUB" study --schemes newmark --steps 1.0e-3 --repeats 1 --set integrate.ratio=1 --until 0.5 decks/$deck.yaml \
        >"$work/table" 2>"$work/err"
    awk '/^reference:/ { for (i = 1; i <= NF; i++) if ($i == "by") d = $(i + 1) } END { exit !(d + 0 < 1e-6 && d != "") }' "$work/err"
    if [ $? = 0 ]; then ok "$deck: references agree"; else not_ok "$deck: references agree" "no, or not told" "$work/err"; fi
done

# Records of a run and of the reference are compared at the instants that they have in common, whatever the deck says of
# records: nothing, every third step, or a time.  Errors fall with h^2 then, and agree.
errors_of() { # SETTINGS...
    "$FMDSUB" study -q --schemes midpoint --steps 2.0e-3,1.0e-3,5.0e-4 --repeats 1 --until 1.2 "$@" "$work/bare.yaml" 2>"$work/err" |
        awk -F, 'NR > 1 { printf "%s ", $5 }'
}
sed '/^output:/,$d' decks/double-pendulum.yaml >"$work/bare.yaml"
errors_of >"$work/none"
errors_of --set 'output.every={steps: 3}' >"$work/steps"
errors_of --set output.every=0.012 >"$work/time"
cat "$work/none" "$work/steps" "$work/time" | tr ' ' '\n' | awk '
    NF { e[++n] = $1 }
    END {
        for (i = 1; i <= 9; i += 3) if (!(e[i] / e[i + 1] > 3.6 && e[i] / e[i + 1] < 4.4 && e[i + 1] / e[i + 2] > 3.6 && e[i + 1] / e[i + 2] < 4.4)) bad = 1
        for (i = 4; i <= 9; i++) if (!(e[i] / e[(i - 1) % 3 + 1] > .9 && e[i] / e[(i - 1) % 3 + 1] < 1.1)) bad = 1
        printf "%d errors, the first %s %s %s\n", n, e[1], e[4], e[7]
        exit n != 9 || bad
    }' >"$work/line"
if [ $? = 0 ]; then ok "instants in common: $(cat "$work/line")"; else
    not_ok "instants in common" "$(cat "$work/line")" "$work/err" "$work/none" "$work/steps" "$work/time"; fi

# The answer in sentences, the cheapest setting as lines of a deck that meet the error, and the same counts twice.
"$FMDSUB" study --repeats 1 --until 1 decks/double-pendulum.yaml >"$work/one.csv" 2>"$work/answer"
"$FMDSUB" study -q --repeats 1 --until 1 decks/double-pendulum.yaml >"$work/two.csv" 2>"$work/err"
for level in 1e-02 1e-04 1e-06; do
    expect "error below $level: a sentence" 1 "$(grep -c "^error below $level: .* work of .* evaluations" "$work/answer")" "$work/answer"
done
expect "does sub-cycling pay: a sentence" 1 "$(grep -c '^subcycle .* pay' "$work/answer")" "$work/answer"
cut -d, -f1-9,12-16 "$work/one.csv" >"$work/one"
cut -d, -f1-9,12-16 "$work/two.csv" >"$work/two"
same "a study twice, apart from times" "$work/one" "$work/two"
"$FMDSUB" study -q --pick 1e-5 --repeats 1 --until 1 decks/double-pendulum.yaml >"$work/pick.yaml" 2>"$work/err"
ended "--pick" 0 $? "$work/pick.yaml" "$work/err"
scheme=$(awk '$1 == "scheme:" { print $2 }' "$work/pick.yaml") tolerance=$(awk '$1 == "tolerance:" { print $2 }' "$work/pick.yaml")
"$FMDSUB" study -q --schemes "${scheme:-none}" --tolerances "${tolerance:-0}" --repeats 1 --until 1 decks/double-pendulum.yaml 2>"$work/err" |
    awk -F, 'NR == 2 { e = $5 } END { exit !(e > 0 && e <= 1e-5) }'
expect "--pick meets its error" 0 $? "$work/pick.yaml" "$work/err"
"$FMDSUB" study -q --pick 1e-15 --schemes midpoint --repeats 1 --until 1 decks/double-pendulum.yaml >"$work/out" 2>"$work/err"
expect "--pick: nothing that good" 1 $? "$work/out" "$work/err"

# Without times the table is the same whatever the machine does: a golden file, to a quarter of errors and work, which other
# libraries of functions may move; the other forms have the same numbers.
simple() { "$FMDSUB" study -q --repeats 0 --until 1 --schemes midpoint,dop853,radau9 "$@" decks/pendulum.yaml 2>"$work/err"; }
simple >"$work/golden.csv"
awk -F, '
    function near(a, b) { return a == b || (a > .75 * b && b > .75 * a) }
    NR == FNR { line[FNR] = $0; n = FNR; next }
    { split(line[FNR], was, ",") }
    FNR == 1 { bad = $0 != line[1]; next }
    $1 != was[1] || $2 != was[2] || $3 != was[3] || $4 != was[4] || $10 != "" || $16 != was[16] ||
        !near($5, was[5]) || !near($9, was[9]) || !near($12, was[12]) { print "was: " line[FNR]; print "is:  " $0; bad = 1 }
    END { exit bad || FNR != n }' tests/refdata/study-pendulum.csv "$work/golden.csv" >"$work/line"
expect "a study without times" 0 $? "$work/line"
simple -f json >"$work/rows.json"
simple -f ndjson >"$work/rows.ndjson"
sed -e '1d' -e '$d' -e 's/^,//' "$work/rows.json" >"$work/inner"
same "-f json, ndjson: the same rows" "$work/inner" "$work/rows.ndjson"
awk -F, 'NR > 1 { print $1, $5, $16 }' "$work/golden.csv" >"$work/a"
sed 's/.*"scheme":"\([^"]*\)".*"error":\([^,]*\),.*"status":"\([^"]*\)".*/\1 \2 \3/' "$work/rows.ndjson" >"$work/b"
same "-f ndjson: the numbers of the CSV" "$work/a" "$work/b"
simple -f json --schemes newmark --steps 1.0e-2 --absolute >"$work/unit"
expect "--absolute: the unit" 1 "$(grep -c '"worst":"pin.fx".*"unit":"N"}' "$work/unit")" "$work/unit"
simple -o "$work/file.csv" >"$work/out"
expect "-o FILE: nothing else" "0 0 rows" "$? $(wc -c <"$work/out") $([ -s "$work/file.csv" ] && echo rows)" "$work/out"
same "-o FILE" "$work/golden.csv" "$work/file.csv"

# The budget is counted: too small a one brings the end forward, and says what it leaves out; the same bytes twice.
for i in 1 2; do
    "$FMDSUB" study --repeats 0 --budget 0.5 decks/flexible-crank.yaml >"$work/tight$i.csv" 2>"$work/tight$i"
    ended "--budget: status" 0 $? "$work/tight$i.csv" "$work/tight$i"
done
same "--budget: rows twice" "$work/tight1.csv" "$work/tight2.csv"
same "--budget: words twice" "$work/tight1" "$work/tight2"
expect "--budget: the end is told" 1 "$(grep -c '^the budget takes it to t = 0.0[0-9]* s of 0.1' "$work/tight1")" "$work/tight1"
expect "--budget: what is left out is told" 0 "$(grep -q '^left out: .* budget' "$work/tight1"; echo $?)" "$work/tight1"

# A pick by a part of the run says so in its lines, and beside them even with -q; by less than a tenth there is none.
"$FMDSUB" study -q --repeats 0 --budget 1.5 --pick 0.5 decks/flexible-crank.yaml >"$work/pick.yaml" 2>"$work/err"
expect "--pick, part of the run: status, lines, words" "0 1 1" "$? $(grep -c '^# its error was measured up to t = 0.0[0-9]* s only, of 0.1 s' "$work/pick.yaml") $(grep -c 'picked by errors up to .*budget' "$work/err")" "$work/pick.yaml" "$work/err"
"$FMDSUB" study -q --repeats 0 --budget 0.1 --pick 0.5 decks/flexible-crank.yaml >"$work/pick.yaml" 2>"$work/err"
expect "--pick, less than a tenth: status, lines, words" "5 0 1" "$? $(wc -l <"$work/pick.yaml") $(grep -c 'nothing is picked: .*--budget' "$work/err")" "$work/pick.yaml" "$work/err"
expect "as much work, not 1 times the work" 0 "$(cat "$work"/tight1 "$work/answer" | grep -c ' 1 times')" "$work/answer"

# What stands still: round-off is not chaos.
"$FMDSUB" study -q --repeats 0 --schemes midpoint,radau9 --set 'initial={static: true}' --until 0.04 decks/cantilever.yaml >"$work/rest.csv" 2>"$work/err"
expect "at rest: status, errors" "0 0" "$? $(awk -F, 'NR > 1 { n++; if (!($5 < 1e-6)) bad++ } END { print bad + !n }' "$work/rest.csv")" "$work/rest.csv" "$work/err"
expect "at rest: a tolerance that changes nothing has no row" 1 "$(grep -c '^radau9' "$work/rest.csv")" "$work/rest.csv"

# The deck's own setting has its sentence, and --pick lines that a deck includes.
"$FMDSUB" study --repeats 0 --until 1 decks/pendulum.yaml >"$work/own.csv" 2>"$work/err"
expect "the deck's own setting" 1 "$(grep -c "^the deck's own setting, newmark at step 0.001 s: error .* work of .* times that of " "$work/err")" "$work/err"
sed -e '/^integrate:/d' -e 's/^gravity:/include: pick.yaml\nintegrate: {until: 1}\n&/' decks/pendulum.yaml >"$work/with.yaml"
"$FMDSUB" study -q --repeats 0 --until 1 --pick 1e-6 decks/pendulum.yaml >"$work/pick.yaml" 2>"$work/err"
"$FMDSUB" run "$work/with.yaml" >"$work/out" 2>"$work/err"
expect "--pick, included: status, its scheme runs" "0 1" "$? $(grep -c ", $(awk '$1 == "scheme:" { print $2 }' "$work/pick.yaml") to tolerance " "$work/err")" "$work/err" "$work/pick.yaml"

# Ended on the way, the rows that are done are there, and the sentences on them; no process stays.
"$FMDSUB" study --repeats 100000 --schemes midpoint,dop853 --until 1 decks/pendulum.yaml >"$work/some.csv" 2>"$work/err" &
pid=$!
for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do
    grep -q '^reference: ' "$work/err" && break
    sleep 0.2
done
sleep 0.5
kill -TERM $pid
wait $pid
expect "ended: status, rows" "143 0" "$? $(awk -F, 'NR > 1 && $5 > 0 { n++ } END { print !(n > 3) }' "$work/some.csv")" "$work/some.csv" "$work/err"

# The advice of `check`, followed: found errors at most five times what was promised (make advice: on all decks).
MOST=2e5 sh tests/tools/advice.sh decks/pendulum.yaml decks/bar-slider.yaml decks/chain.yaml decks/slider-crank.yaml \
    decks/spin-up-slow.yaml >"$work/advice" 2>&1
rc=$?
expect "advice followed on five decks: $(tail -n 1 "$work/advice")" 0 $rc "$work/advice"

# The same where loads and drives have corners in time, forces jump by the state, or the deck has a tolerance.
MOST=5e5 sh tests/tools/advice.sh tests/advice/*.yaml >"$work/advice" 2>&1
rc=$?
expect "advice followed where forces jump: $(tail -n 1 "$work/advice")" 0 $rc "$work/advice"
advised() { # NAME DECK PATTERN COUNT
    "$FMDSUB" check -q "tests/advice/$2.yaml" >"$work/out" 2>"$work/err"
    expect "$1" "$4" "$(grep -c -- "$3" "$work/out")" "$work/out" "$work/err"
}
advised "no step that there was no time to try with a pulse in it" late-pulse 'at step ' 0
advised "that is said" late-pulse 'no fixed step: those that there was time to try' 1
advised "corners in steps that are too many, and where" driven-crank 'no fixed step: .* such as t = 0.05 s; schemes with a tolerance' 1
advised "corners as ends of steps" jumps '1e-04: midpoint at step 0.0001 ' 1
advised "no step beside a tolerance" tolerance 'no fixed step: the deck has a tolerance' 1

# Chaos: the references part, errors are taken up to there, and it is told; far beyond, nothing is left to compare.
sed 's/^gravity:.*/gravity: [0, -981]/' decks/double-pendulum.yaml >"$work/wild.yaml"
chaos() { "$FMDSUB" study --schemes midpoint --steps 1.0e-4 --repeats 1 --set output.every=0.1 --until "$1" "$work/wild.yaml"; }
chaos 12 >"$work/out" 2>"$work/err"
rc=$?
expect "chaos: the horizon is told" "0 1" "$rc $(grep -c '^they part after t = ' "$work/err")" "$work/err"
awk -F, 'NR == 2 { e = $5 } END { exit !(e > 0 && e < 10) }' "$work/out"
expect "chaos: errors up to there" 0 $? "$work/out" "$work/err"

# The same for a flexible arm on a hub with a hundredth of its inertia: the recoil of the arm moves the hub more than
# anything else.
"$FMDSUB" study -q --schemes midpoint,subcycle,miao --ratios 5,20 --steps 2.0e-5 --until 0.2 --repeats 1 \
    decks/light-hub.yaml >"$work/hub.csv" 2>"$work/err"
for n in 5 20; do as_near light-hub "$work/hub.csv" $n slow; done

# Simeon's slider-crank to the digits of its references: coordinates to 1e-9 of their largest value, rates and
# accelerations of the stiff shapes, whose own digits are fewer, to what the tolerance leaves.
crank() { # DECK WITHIN COLUMNS
    "$FMDSUB" run -q --set integrate.tolerance=1.0e-13 "tests/decks/$1.yaml" >"$work/$1.csv" 2>"$work/err"
    if "$COMPARE" --reference --map "tests/refdata/$1.map" --within "$2" --columns "$3" "tests/refdata/$1.csv" \
        "$work/$1.csv" >"$work/cmp" 2>&1; then ok "$1 within $2"
    else not_ok "$1 within $2" "too far from the reference" "$work/cmp" "$work/err"; fi
}
crank crank-consistent 1e-8 "rod.angle slider.x rod.wz slider.vx rod.mode* slider.ax lambda*"
crank crank-testset 1e-9 "rod.angle slider.x rod.wz slider.vx rod.mode1 rod.mode2 rod.mode3 rod.mode4 slider.ax lambda*"

# A beam of eight elements and the four shapes, two models of one rod made apart: rigid motion to 1e-4 of the
# mechanism, the rod's middle to 1/50 of its largest deflection.
"$FMDSUB" run -q --every 0.01 decks/flexible-crank.yaml >"$work/beam.csv" 2>"$work/err"
"$FMDSUB" run -q tests/decks/crank-stiffened.yaml >"$work/shapes.csv" 2>>"$work/err"
awk -F, '
    function bow(t, x, mx, my,    px, py, l) { # of the middle from the chord
        px = .15 * cos(150 * t); py = .15 * sin(150 * t); l = sqrt((x - px) ^ 2 + py ^ 2)
        return ((mx - px) * py + (my - py) * (x - px)) / l
    }
    $1 == "t" { for (i = 1; i <= NF; i++) at[$i] = i; next }
    { x = $at["slider.x"]; w = bow($1, x, $at["rod.middle.x"], $at["rod.middle.y"]); k = sprintf("%.4f", $1) }
    NR == FNR { X[k] = x; W[k] = w; if (w > most) most = w; if (-w > most) most = -w; next }
    k in X { n++; dx = x - X[k]; dw = w - W[k]; if (dx < 0) dx = -dx; if (dw < 0) dw = -dw
             if (dx > ex) ex = dx; if (dw > ew) ew = dw }
    END { printf "slider within %.2g m, middle within %.2g of %.2g m\n", ex, ew, most; exit !(n == 11 && ex < 4.5e-5 && ew < most / 50) }
    ' "$work/shapes.csv" "$work/beam.csv" >"$work/line"
if [ $? = 0 ]; then ok "flexible-crank, beam and shapes: $(cat "$work/line")"; else
    not_ok "flexible-crank, beam and shapes" "$(cat "$work/line")" "$work/err"; fi

# The balance of energy falls with the square of the step.
for run in "flexible-pendulum 2.0e-3 4.0e-3 0.4 0.04" "flexible-crank 1.0e-5 2.0e-5 0.1 0.02"; do
    set -- $run
    deck=$1
    for h in $2 $3; do
        "$FMDSUB" run -q --set "integrate.step=$h" --until "$4" --every "$5" --stats="$work/stats" decks/$deck.yaml \
            >/dev/null 2>"$work/err"
        awk '$1 == "energy_residual_worst" { print $2 }' "$work/stats"
    done >"$work/residuals"
    awk '{ r[NR] = $1 } END { printf "%.3g at h, %.3g at 2 h\n", r[1], r[2]; exit !(r[1] > 0 && r[2] / r[1] > 3.2 && r[2] / r[1] < 4.8) }' \
        "$work/residuals" >"$work/line"
    if [ $? = 0 ]; then ok "$deck, energy residual: $(cat "$work/line")"; else
        not_ok "$deck, energy residual" "$(cat "$work/line")" "$work/err"; fi
done

# The robot at rest after its move: each drive holds the weight beyond its joint.
"$FMDSUB" run -q --set bodies.link1.damping.ratio=0.3 --set bodies.link2.damping.ratio=0.3 --until 6 \
    --columns link1.x,link2.x,shoulder_motor.force,elbow_motor.force,link2.tip.x,link2.tip.y decks/flexible-robot.yaml >"$work/robot.csv" 2>"$work/err"
awk -F, '
    { t = $1; x1 = $2; x2 = $3; s = $4; e = $5; dx = $6 - 1.2 * cos(1.2) - cos(.3); dy = $7 - 1.2 * sin(1.2) - sin(.3) }
    END {
        pi = atan2(0, -1); g = 9.81
        m1 = 2 + 2700 * pi * (.02 ^ 2 - .0175 ^ 2) * 1.2; m2 = 1.5 + 2700 * pi * (.015 ^ 2 - .013 ^ 2)
        want = g * (m1 * x1 + m2 * x2)
        printf "torque %.6g N m, weight %.6g N m, the payload %.2g m from where stiff links hold it\n", s, want, sqrt(dx ^ 2 + dy ^ 2)
        exit !(t == 6 && (s / want - 1) ^ 2 < 1e-12 && dy < -2e-3 && dy > -2e-2)
    }' "$work/robot.csv" >"$work/line"
if [ $? = 0 ]; then ok "flexible-robot at rest: $(cat "$work/line")"; else
    not_ok "flexible-robot at rest" "$(cat "$work/line")" "$work/err"; fi

# A page of it: whole, nothing from outside, the deck and the command in it, markup in the deck as text; the same twice.
cat >"$work/page.yaml" <<'YAML'
fmdsub: 1
title: "a <b> & c"
bodies: {ball: {mass: 1, inertia: 0.1, at: [1, 0]}}
constraints: {pin: {revolute: [ground, ball], at: [0, 0]}}
forces: {spring: {spring: pin, stiffness: 10}}
initial: {pin.angle: 0.3}
integrate: {scheme: newmark, step: 1.0e-2, until: 1}
output: {every: 0.1, columns: [pin.angle, "energy.*"]}
YAML
for i in 1 2; do
    (cd "$work" && "$FMDSUB" study -q --budget 5 --repeats 0 --report page.html page.yaml >page.csv 2>err)
    expect "a page, $i" 0 $? "$work/err"
    mv "$work/page.html" "$work/page$i.html"
done
same "the same page twice" "$work/page1.html" "$work/page2.html"
expect "the page has what it says" "1 2 1 0 0" "$(grep -c '</html>' "$work/page1.html") $(grep -c '<svg' "$work/page1.html") $(grep -c '^title: &quot;a &lt;b&gt; &amp; c&quot;' "$work/page1.html") $(grep -c 'https*://\|src=' "$work/page1.html") $(grep -c 'nan\|inf' "$work/page1.html")" "$work/page1.html"
expect "and the command" 1 "$(grep -c 'fmdsub study -q --budget 5 --repeats 0 --report page.html page.yaml' "$work/page1.html")"
