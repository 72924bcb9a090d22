# models.sh -- models made apart, beside each other: references of a slider-crank, beams and shapes, balance and rest.
. tests/tools/lib.sh

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
