# flexible.sh -- mechanisms with flexible bodies: CPU time of a step, against the bare loop of bare_chain.c at N = 8 in the
# same run, and instructions a step where valgrind is installed.
#
# Flexible slider-crank: 8 elements and 8 modes, 11 coordinates in a loop, h = 5e-5, 2000 steps.  Spin-up of an arm: 8
# elements, 4 modes and the statics of its tip, h = 0.01, 2000 steps.  The last column compares with the CPU time of 2000
# steps that other programs took on a like machine, the faster of Exudyn and MBDyn: 0.073 s and 0.144 s.
#
# Of the eight modes two do as well at this step: against 14 modes of 32 elements at h = 1e-6, and the sizes of the
# columns, slider and middle of the rod are off by 0.8e-4 and 1.5e-4 with either number, the bending stress by 4 % with
# eight modes and by 7 % with two; a Newton tolerance of 1e-6 changes none of these digits.  crank-8 and crank-2 take that.
. tests/tools/lib.sh
BARE=$BUILD/bench/bare_chain

deck() { # NAME DECK OPTIONS...
    name=$1 deck=$2
    shift 2
    "$FMDSUB" run -q --every-steps 100000000 --stats="$work/stats" "$@" "$deck" >/dev/null || exit 1
    awk -v name="$name" '{ x[$1] = $2 }
        END { s = x["minor_steps"]; print name, 1e6 * x["cpu_seconds"] / s, x["slow_evaluations"] / s, x["factorizations"] / s }' \
        "$work/stats" >>"$work/times"
}

both() { # RUN OPTIONS...: one scheme
    run=$1
    shift
    for scheme in midpoint newmark; do
        $run "crank:$scheme" decks/flexible-crank.yaml --set integrate.scheme=$scheme --set integrate.step=5.0e-5 \
            --columns slider.x "$@"
        for modes in 8 2; do
            $run "crank-$modes:$scheme" decks/flexible-crank.yaml --set integrate.scheme=$scheme --set integrate.step=5.0e-5 \
                --set integrate.newton_tolerance=1.0e-6 --set bodies.rod.modes=$modes --columns slider.x "$@"
        done
        $run "spin-up:$scheme" decks/spin-up.yaml --set integrate.scheme=$scheme --set integrate.step=0.01 \
            --set bodies.arm.beam.elements=8 --columns arm.tip.dy "$@"
    done
}

# Instructions of the steps alone: those of the whole run less those of half of it.
count() { # NAME DECK OPTIONS...
    name=$1
    shift
    case $name in crank*) half=0.05 all=0.1 ;; *) half=10 all=20 ;; esac
    for t in $half $all; do
        valgrind --tool=callgrind --callgrind-out-file=/dev/null "$FMDSUB" run -q --every-steps 100000000 --until $t "$@" \
            2>&1 >/dev/null | awk '/Collected/ { print $4 }'
    done | awk -v name="$name" '{ n[NR] = $1 } END { print name, (n[2] - n[1]) / 1000 }' >>"$work/counts"
}
count_deck() {
    name=$1 deck=$2
    shift 2
    count "$name" "$@" "$deck"
}

for r in $(seq "${REPEATS:-7}"); do
    "$BARE" 8 1.0e-3 20000 | awk '{ print "bare:N=8", $1, $5, $7 }' >>"$work/times"
    both deck
done
: >"$work/counts"
command -v valgrind >/dev/null && both count_deck

awk '
    NR == FNR { instructions[$1] = $2; next }
    !($1 in us) { order[++kinds] = $1 }
    { if (!($1 in us) || $2 < us[$1]) us[$1] = $2; evals[$1] = $3; factors[$1] = $4 }
    END {
        limit["crank"] = limit["crank-8"] = limit["crank-2"] = 0.073; limit["spin-up"] = 0.144
        print "flexible bodies: CPU time of a step"
        printf "%-18s %10s %13s %12s %14s %13s %14s\n", "", "us a step", "of bare loop", "evaluations", "factorizations", "instructions", "others/ours"
        for (i = 1; i <= kinds; i++) {
            key = order[i]; split(key, part, ":")
            printf "%-18s %10.3f %13.2f %12.2f %14.3f", key, us[key], us[key] / us["bare:N=8"], evals[key], factors[key]
            if (key in instructions) printf " %13.0f", instructions[key]
            else printf " %13s", "-"
            if (part[1] in limit) printf " %14.1f", 1e6 * limit[part[1]] / 2000 / us[key]
            print ""
        }
    }' "$work/counts" "$work/times"
