# sweeps.sh -- two sweeps of subcycle against its Newton iterated to 1e-12, on mechanisms drawn at random (tests/random):
# `N=270 SEED=1 sh tests/bench/sweeps.sh`.  Errors at records, of each column over its range, the largest, against radau9 at 1e-10;
# the balance's residual, over the largest energy.  A mechanism is left out, and counted, that no such reference follows, or
# where the iteration does not come to 1e-10 without steps being halved.  Fails where an error is above 1.05 times that of the
# iterated one, or a residual above 1.1 times and by more than what a step may leave by its norm of energy, 4e-9 a minor step
# (multirate/subcycle.c): linear motions are kept to round-off when iterated.
. tests/tools/lib.sh
N=${N:-270} SEED=${SEED:-1}

# error A: of the records in A against those in $work/exact
error() {
    paste -d , "$work/exact" "$1" | awk -F , '
        NR == 1 { n = NF / 2; next }
        {
            for (i = 2; i <= n; i++) {
                if (NR == 2 || $i < low[i]) low[i] = $i
                if (NR == 2 || $i > high[i]) high[i] = $i
                d = $i - $(n + i); if (d < 0) d = -d
                if (d > off[i]) off[i] = d
                if ($(n + i) == "") bad = 1
            }
        }
        END {
            for (i = 2; i <= n; i++) {
                size = high[i] > -low[i] ? high[i] : -low[i]
                if (high[i] - low[i] > 1e-6 * size && off[i] / (high[i] - low[i]) > most) most = off[i] / (high[i] - low[i])
            }
            printf "%.9e\n", bad || NR < 3 ? "nan" : most
        }'
}
run() { # OUT NEWTON [--set ...]
    run_to=$1
    shift
    timeout 20 "$FMDSUB" run -q --stats="$run_to.stats" "$@" "$work/deck.yaml" >"$run_to" 2>"$work/err"
    run_status=$?
    [ $run_status -le 1 ] && [ -s "$run_to" ]
}
stat() { awk -v key="$2" '$1 == key { print $2 }' "$1.stats"; }

# To 1e-12, or as far as the iteration comes without steps being halved for it.
iterate() {
    for newton in 1.0e-12 1.0e-11 1.0e-10; do
        run "$work/newton" --set integrate.newton_tolerance=$newton || return 1
        [ "$(stat "$work/newton" rejected)" = "$(stat "$work/two" rejected)" ] && return
    done
}

echo "seeds $SEED to $((SEED + N - 1))"
seed=$SEED
while [ "$seed" -lt $((SEED + N)) ]; do
    "$BUILD/random/mechanism" "$seed" | sed 's/, energy.kinetic\]/]/' >"$work/deck.yaml"
    if run "$work/exact" --set integrate.scheme=radau9 --set integrate.tolerance=1e-10 &&
        run "$work/two" && iterate; then
        echo "$seed $(error "$work/two") $(error "$work/newton") $(stat "$work/two" energy_share) $(stat "$work/newton" energy_share)" \
            "$(stat "$work/two" sweeps) $(stat "$work/newton" sweeps) $(stat "$work/two" minor_steps) $(stat "$work/two" rejected) $(stat "$work/newton" rejected)"
    else
        echo "$seed left out"
    fi
    seed=$((seed + 1))
done >"$work/rows"
awk '
    $2 == "left" { left++; next }
    $9 != $10 { halved++; next } # not the same steps
    $3 > .5 || $3 != $3 + 0 { wild++; next } # the steps do not follow the motion
    {
        n++
        e = $3 > 1e-9 ? $2 / $3 : 1
        bound = 4e-9 * $8
        b = $5 > bound ? $4 / $5 : 1
        if ($4 > $5) left_by = ($4 - $5) / bound
        if (left_by > most_left) most_left = left_by
        if (e > 1.05 && $2 - $3 > 1e-9) { wrong++; print "seed " $1 ": error " $2 ", iterated " $3 " (" e ")" }
        if ($4 > 1.1 * $5 && $4 - $5 > bound) { drift++; print "seed " $1 ": residual " $4 ", iterated " $5 " (" b ")" }
        if (e > worst) { worst = e; whose = $1 }
        if (b > worst_b) { worst_b = b; whose_b = $1 }
        two += $6; newton += $7
    }
    END {
        printf "%d mechanisms, %d without a reference, %d beyond what their steps follow, %d where not the same steps were halved\n", n, left,
            wild, halved
        printf "errors: at most %.4f times those of Newton to 1e-12 (seed %d), %d above 1.05\n", worst, whose, wrong
        printf "residuals of the balance: at most %.4f times (seed %d), %d above 1.1\n", worst_b, whose_b, drift
        printf "what they leave in the balance: at most %.2f of 4e-9 a minor step\n", most_left
        printf "sweeps: %.3f of those of Newton to 1e-12\n", newton ? two / newton : 0
        exit n == 0 || wrong + drift > 0
    }' "$work/rows"
