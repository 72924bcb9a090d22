# counts.sh -- instructions of a step, by callgrind, of a program against those of another.
#
#     sh tests/tools/counts.sh REFERENCE [PROGRAM]                    default: build/fmdsub
#
# Short runs that stand for the benches and for what they leave out.  A count is the difference of a run and of one of a
# fifth of its length, divided by the steps between them, so that the start drops out.  Counts repeat where times do not.
# Fails when one is more than LIMIT (default 1.02) times the other's.
. tests/tools/lib.sh
LIMIT=${LIMIT:-1.02}

[ $# -gt 0 ] && [ -x "$1" ] || { echo "usage: counts.sh REFERENCE [PROGRAM]" >&2; exit 2; }
reference=$1 program=${2:-$FMDSUB}
[ -x "$program" ] || { echo "counts: no program $program" >&2; exit 2; }
command -v valgrind >/dev/null || { echo "counts: valgrind is not installed" >&2; exit 2; }

# name, deck, scheme, minor step [s], steps (a multiple of 5 ratios), settings
cat >"$work/runs" <<'RUNS'
chain-8          decks/chain.yaml                 newmark   1.0e-3  2500  parameters.N=8
chain-32         decks/chain.yaml                 newmark   2.0e-3  500   parameters.N=32
chain-8-rk4      decks/chain.yaml                 rk4       1.0e-3  2500  parameters.N=8
pendulum         decks/pendulum.yaml              midpoint  1.0e-3  5000
windows-1        decks/windows.yaml               newmark   2.0e-3  2000  parameters.N=1
windows-10       decks/windows.yaml               newmark   2.0e-3  200   parameters.N=10
four-bar         decks/four-bar.yaml              midpoint  1.0e-3  1000
driven           decks/driven-slider-crank.yaml   midpoint  1.0e-3  1000
crank-8-midpoint decks/flexible-crank.yaml        midpoint  5.0e-5  500   integrate.newton_tolerance=1.0e-6 bodies.rod.modes=8
crank-2-newmark  decks/flexible-crank.yaml        newmark   5.0e-5  1000  integrate.newton_tolerance=1.0e-6 bodies.rod.modes=2
spin-up          decks/spin-up.yaml               midpoint  0.01    1000  bodies.arm.beam.elements=8
whip             decks/whip.yaml                  midpoint  2.5e-4  400
roll-up          decks/roll-up.yaml               midpoint  1.0e-4  400
governor         decks/governor.yaml              midpoint  1.0e-3  1000
heavy-top        decks/heavy-top.yaml             midpoint  1.0e-4  5000
satellite        decks/floating-satellite.yaml    midpoint  2.0e-3  800
rotating-blade   decks/rotating-blade.yaml        newmark   2.0e-4  800
arms             tests/bench/arms.yaml            subcycle  2.0e-4  2000
long-chain       tests/bench/long-chain.yaml      subcycle  2.0e-4  1000
telescope        decks/telescope.yaml             subcycle  2.0e-4  500
bar-slider-miao  decks/bar-slider.yaml            miao      1.0e-3  2000
ball-chain       tests/decks/audit-ball-chain.yaml dopri5   1.0e-3  200   integrate.tolerance=1.0e-9
RUNS

instructions() { # PROGRAM STEPS: of one run
    valgrind --tool=callgrind --callgrind-out-file=/dev/null "$1" run -q --every-steps 100000000 --columns energy.residual \
        --set integrate.scheme=$scheme --set integrate.step=$h $sets \
        --until "$(awk -v h="$h" -v n="$2" 'BEGIN { printf "%.12g", h * n }')" "$deck" 2>"$at/err" >/dev/null ||
        { grep -v '^==' "$at/err" | sed 's/^/    | /' >&2; echo failed; return; }
    awk '/Collected/ { print $NF }' "$at/err"
}

half() { # 0 or 1
    at=$work/$1
    mkdir "$at"
    awk "NR % 2 == $1" "$work/runs" | while read -r name deck scheme h steps settings; do
        sets=
        for setting in $settings; do sets="$sets --set $setting"; done
        few=$((steps / 5))
        echo $name $((steps - few)) $(instructions "$reference" $few) $(instructions "$reference" $steps) \
            $(instructions "$program" $few) $(instructions "$program" $steps)
    done >"$at/counts"
}
half 0 &
half 1
wait
printf '%-18s %14s %14s %8s\n' "" reference program ratio
awk 'NR == FNR { order[NR] = $1; next } { row[$1] = $0 } END { for (i = 1; i in order; i++) print row[order[i]] }' \
    "$work/runs" "$work"/?/counts | awk -v limit="$LIMIT" '
    NF != 6 || !($4 > $3 && $6 > $5) { print $1 ": a run failed"; bad++; next }
    {
        was = ($4 - $3) / $2; is = ($6 - $5) / $2
        printf "%-18s %14.0f %14.0f %8.4f%s\n", $1, was, is, is / was, (is / was > limit ? "  more than " limit : "")
        if (is / was > limit) bad++
    }
    END { printf "%d passed, %d failed\n", NR - bad, bad; exit bad > 0 || NR == 0 }'
