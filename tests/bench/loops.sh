# loops.sh -- N four-bar windows (decks/windows.yaml) by Newmark at h = 2e-3: the cost of a loop.
#
# Times: CPU time of a step at N = 1, 10 and 40 and its ratio to the bare loop of bare_chain.c for a chain of 8 links at
# h = 1e-3, which takes about 1 us on the machine that the wanted times, 4, 25 and 100 us, are meant for.  Both take
# turns, REPEATS times (default 7); the least counts.
#
# Instructions: by callgrind (package valgrind; left out where it is not installed) per loop and step at N = 10, 100 and
# 1000, the difference of runs of 60 and of 20 steps, so that the start-up drops out; what is left of it is the start-up.
# The cost is linear when the counts lie within 20 % of the one at N = 10.
. tests/tools/lib.sh

run() { # N STEPS OPTIONS...
    n=$1 until=$(awk -v s="$2" 'BEGIN { printf "%.10g", 2e-3 * s }')
    shift 2
    $under "$FMDSUB" run -q --set parameters.N="$n" --set integrate.step=2.0e-3 --until "$until" \
        --every-steps 100000000 --columns foot1.angle "$@" decks/windows.yaml
}

under=
for r in $(seq "${REPEATS:-7}"); do
    while read -r n steps; do
        "$BUILD/bench/bare_chain" 8 1.0e-3 20000 | awk '{ print 0, $1 }' >>"$work/times"
        run "$n" "$steps" --stats="$work/stats" >/dev/null || exit 1
        awk -v n="$n" '{ x[$1] = $2 } END { print n, 1e6 * x["cpu_seconds"] / x["minor_steps"] }' "$work/stats" >>"$work/times"
    done <<'CASES'
1 10000
10 2000
40 1000
CASES
done
awk '
    !($1 in us) || $2 < us[$1] { us[$1] = $2 }
    END {
        printf "windows: CPU time of a step (bare loop of 8 links: %.3f us)\n", us[0]
        printf "%6s %10s %14s %10s\n", "N", "us a step", "of bare loop", "wanted"
        split("1 10 40", size, " "); split("4 25 100", wanted, " ")
        for (i = 1; i <= 3; i++)
            printf "%6d %10.2f %14.1f %10d  %s\n", size[i], us[size[i]], us[size[i]] / us[0], wanted[i], \
                us[size[i]] / us[0] <= wanted[i] ? "" : "too slow"
    }' "$work/times"

echo
if ! command -v valgrind >/dev/null; then
    echo "windows: instructions not counted, valgrind is not installed"
    exit 0
fi
under="valgrind --tool=callgrind --callgrind-out-file=/dev/null"
for n in 10 100 1000; do
    for steps in 20 60; do
        run "$n" "$steps" 2>"$work/err" >/dev/null || exit 1
        awk -v n="$n" '/Collected/ { print n, $NF }' "$work/err" >>"$work/counts"
    done
done
awk '
    NR % 2 { few = $2; next }
    { n[NR / 2] = $1; per[NR / 2] = ($2 - few) / 40 / $1; start[NR / 2] = few - ($2 - few) / 2 }
    END {
        print "windows: instructions"
        printf "%6s %16s %12s %14s\n", "N", "a loop and step", "of N = 10", "start-up"
        for (i = 1; i <= 3; i++) {
            part = per[i] / per[1]
            if (!(part > .8 && part < 1.2)) bad = 1
            printf "%6d %16.0f %12.3f %14.3g\n", n[i], per[i], part, start[i]
        }
        print bad ? "not linear within 20 %" : "linear within 20 %"
        exit bad
    }' "$work/counts"
