# chain.sh -- the planar chain: CPU time of a step against the bare loop of bare_chain.c.
#
# The program runs decks/chain.yaml with N links; both do the same steps from the same start to the same
# Newton tolerance and take turns, REPEATS times (default 7); the least counts.  For the program it is the
# CPU time of its stepping, with two records written.
. tests/tools/lib.sh
BARE=$BUILD/bench/bare_chain
"$BARE" --check tests/refdata/double-pendulum.csv || exit 1

# One run of a scheme: appends `N scheme microseconds evaluations factors` per step.
program() { # N SCHEME h T
    "$FMDSUB" run -q --set parameters.N="$1" --set integrate.scheme="$2" --set integrate.step="$3" --until "$4" \
        --every-steps 100000000 --columns pin1.angle --stats="$work/stats" decks/chain.yaml >/dev/null || exit 1
    awk -v n="$1" -v scheme="$2" '{ x[$1] = $2 }
        END { s = x["minor_steps"]; print n, scheme, 1e6 * x["cpu_seconds"] / s, x["slow_evaluations"] / s, x["factorizations"] / s }' \
        "$work/stats" >>"$work/times"
}

bare() { # N h STEPS
    "$BARE" "$1" "$2" "$3" | awk -v n="$1" '{ print n, "bare", $1, $5, $7 }' >>"$work/times"
}

for r in $(seq "${REPEATS:-7}"); do
    while read -r n h t steps; do
        bare "$n" "$h" "$steps"
        program "$n" newmark "$h" "$t"
        program "$n" rk4 "$h" "$t"
    done <<'CASES'
2 1.0e-3 100 100000
8 1.0e-3 20 20000
32 2.0e-3 4 2000
CASES
done

awk '
    { key = $1 " " $2; if (!(key in us) || $3 < us[key]) us[key] = $3; evals[key] = $4; factors[key] = $5 }
    END {
        print "planar chain: CPU time of a step"
        printf "%4s %-8s %10s %14s %12s %14s\n", "N", "", "us a step", "of bare loop", "evaluations", "factorizations"
        split("2 8 32", size, " ")
        split("bare newmark rk4", kind, " ")
        for (i = 1; i <= 3; i++)
            for (k = 1; k <= 3; k++) {
                key = size[i] " " kind[k]
                printf "%4d %-8s %10.3f %14.2f %12.2f %14.3f\n", size[i], kind[k], us[key], us[key] / us[size[i] " bare"], evals[key], factors[key]
            }
    }' "$work/times"
