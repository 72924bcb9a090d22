# units.sh -- the same mechanism in other units: all that it does is the same number of other metres, kilograms and seconds, and
# it takes the same steps, iterations and evaluations.
#
# Units go by powers of two, which round nothing, so that what differs is a number of the program's own: a limit in metres, a
# scale left out or taken twice, things of two units added.
. tests/tools/lib.sh

counts() { grep -E '^(major_steps|minor_steps|slow_evaluations|fast_evaluations|factorizations|sweeps|rejected) ' "$1"; }

# try DECK OPTIONS LENGTH MASS TIME APART EFFORT: options of integrate; the share that columns and counts, of which a hundred more, may be apart.
try() {
    name="$1, $2, in units of $3 m, $4 kg, $5 s" apart=$6 effort=$7
    options=$(echo "$2" | tr , '\n' | sed 's/^/--set integrate./')
    "$FMDSUB" run -q --units -c '*' $options --stats="$work/stats.one" "tests/hard/units/$1.yaml" >"$work/one" 2>"$work/err" &&
        "$FMDSUB" run -q --units -c '*' $options --stats="$work/stats.two" --set "parameters.l=$3" --set "parameters.m=$4" \
            --set "parameters.s=$5" "tests/hard/units/$1.yaml" >"$work/two" 2>"$work/err" || { not_ok "$name: runs" "no" "$work/err"; return; }
    value() { echo "$1" | awk -F/ '{ printf "%.17g", (NF > 1 ? $1 / $2 : $1) }'; }
    awk -v l="$(value "$3")" -v m="$(value "$4")" -v s="$(value "$5")" -v apart="$apart" -f tests/hard/units.awk "$work/one" "$work/two" >"$work/differs" &&
        ok "$name: columns" || not_ok "$name: columns" "column, in metres, in those units" "$work/differs"
    counts "$work/stats.one" >"$work/a"
    counts "$work/stats.two" | paste -d ' ' "$work/a" - >"$work/both"
    awk -v effort="$effort" '{ d = $2 - $4; if ((d < 0 ? -d : d) > effort * ($2 + 100)) bad = 1 } END { exit bad || NR != 7 }' "$work/both" &&
        ok "$name: effort" || not_ok "$name: effort" "not the same" "$work/both"
}

for scheme in midpoint newmark hht generalized-alpha rk4 'midpoint,integrate.order=4' 'subcycle,ratio=4,step=s/1024' 'miao,ratio=4' \
    'daniel,ratio=4' 'neal-belytschko,ratio=4' 'midpoint,tolerance=1e-4' 'newmark,tolerance=1e-4'; do
    scheme=$(echo "scheme=$scheme" | sed 's/integrate\.//')
    try loop "$scheme" 1.0/1024 4096 1.0/64 1e-9 0.01
    try loop "$scheme" 4096 1.0/4096 64 1e-9 0.01
done
for scheme in midpoint newmark hht rk4 subcycle,ratio=4 midpoint,tolerance=1e-4; do
    try drive "scheme=$scheme" 1.0/1024 4096 1.0/64 1e-9 0.01
    try drive "scheme=$scheme" 4096 1.0/4096 64 1e-9 0.01
done
# What is left of a correction below 1e-10 m/s or rad/s ends an iteration in any units (engine/newton.c): these end by their
# tolerance before, of newmark all but a few.
try spatial scheme=midpoint,newton_tolerance=1e-8 1.0/1024 4096 1.0/64 1e-9 0.01
try spatial scheme=midpoint,newton_tolerance=1e-8 4096 1.0/4096 64 1e-9 0.01
try spatial scheme=newmark,newton_tolerance=1e-8 1.0/1024 4096 1.0/64 1e-6 0.01
try spatial scheme=newmark,newton_tolerance=1e-8 4096 1.0/4096 64 1e-6 0.01

# A first step by tolerance knows what a second is.
for scheme in dopri5,tolerance=1e-6 dop853,tolerance=1e-7; do
    for deck in loop drive; do
        try $deck "scheme=$scheme" 1.0/1024 4096 1 1e-9 0.01
        try $deck "scheme=$scheme" 4096 1.0/4096 1 1e-9 0.01
    done
done

# What pushes a box that stands on two feet is shared by pivots, which go by size.
for scheme in midpoint subcycle,ratio=4; do
    try touch "scheme=$scheme" 1.0/1024 4096 1.0/64 1e-8 0.04
    try touch "scheme=$scheme" 4096 1.0/4096 64 1e-8 0.04
done

# The ball turns by half of a step at the middle of one: the rod is closed there, too, or iterations stand still.
"$FMDSUB" run -q -c t --stats="$work/stats.one" tests/hard/units/spatial.yaml >/dev/null 2>&1 && grep -qx 'rejected 0' "$work/stats.one" &&
    ok "spatial, midpoint: no step is halved" || not_ok "spatial, midpoint: no step is halved" "iterations that do not end" "$work/stats.one"
