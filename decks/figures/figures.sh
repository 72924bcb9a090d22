# figures.sh -- figures 3 to 6 and the times of Miao, Zhu, Shi and Chen (2007), drawn anew: make figures
#
#     BUILD=build sh decks/figures/figures.sh [svg|png]
#
# Runs the bar-slider by newmark at 1:1, by miao and subcycle at 5:1 and 10:1 with the minor step of the deck, and by dop853
# to 1e-12 as the reference; writes figure-3.svg ... figure-6.svg, costs.svg and costs.txt beside itself (png: into the
# build folder, to look at).  Needs gnuplot (Debian: gnuplot-nox).
set -eu
BUILD=${BUILD:-build} form=${1:-svg}
here=decks/figures
data=$BUILD/figures
command -v gnuplot >/dev/null || { echo "figures: gnuplot is missing (Debian: gnuplot-nox)" >&2; exit 2; }
mkdir -p "$data"
[ "$form" = svg ] && out=$here || out=$data

# run NAME DECK SCHEME RATIO [SET...]: records and counts.
run() {
    name=$1 deck=$2 scheme=$3 ratio=$4
    shift 4
    set -- $(for s in "$@"; do printf -- '--set %s ' "$s"; done)
    "$BUILD/fmdsub" run -q -o "$data/$name.csv" --stats="$data/$name.stats" --every 0.01 \
        --columns t,hub.angle,guide.displacement,energy.residual --set integrate.scheme=$scheme --set integrate.ratio=$ratio \
        "$@" "decks/$deck.yaml" 2>/dev/null
}
run reference bar-slider dop853 1 integrate.tolerance=1e-12
run reference-constant bar-slider-constant dop853 1 integrate.tolerance=1e-12
run newmark-1 bar-slider newmark 1
run newmark-fixed-1 bar-slider newmark 1 integrate.iteration=fixed-point
for n in 5 10; do
    for scheme in miao subcycle daniel; do run $scheme-$n bar-slider $scheme $n; done
done

# Each run's columns beside the reference's: t, angle, displacement, their differences, residual of the balance.
for name in newmark-1 miao-5 miao-10 subcycle-5 subcycle-10; do
    paste -d, "$data/$name.csv" "$data/reference.csv" | awk -F, -v OFS=, '
        NR == 1 { print "t,angle,displacement,angle_error,displacement_error,residual"; next }
        { print $1, $2, $3, $2 - $6, $3 - $7, $4 }' >"$data/$name.near.csv"
done

fact() { awk -v key="$2" '$1 == key { print $2 }' "$data/$1.stats"; }
worst() { # NAME COLUMN: largest difference over the column's range
    awk -F, -v e="$2" -v c="$(($2 - 2))" 'NR > 1 { d = $e < 0 ? -$e : $e; if (d > most) most = d; if (NR == 2 || $c < low) low = $c; if ($c > high) high = $c }
        END { printf "%.1e", most / (high - low) }' "$data/$1.near.csv"
}

# What is printed, and what is counted: sweeps over slow and fast bodies, their sum (a slow one at the price of a fast one)
# and the share of 1:1, the least share that any price of a slow sweep gives, errors.
table() {
    echo "Bar-slider to t = 2 s, minor step 1.0e-3 s.  In print: 218 s, 118 s (54 %), 44 s (20.2 %)."
    echo
    printf '%-13s %7s %7s %7s %7s %9s %9s %8s %9s\n' run printed slow fast share least angle slider balance
    n0=$(fact newmark-1 slow_evaluations)
    for row in newmark-1:100% miao-5:54% miao-10:20.2% subcycle-5:- subcycle-10:-; do
        name=${row%:*}
        printf '%-13s %7s %7d %7d %7s %9s %9s %8s %9.1e\n' "$name" "${row#*:}" "$(fact $name slow_evaluations)" \
            "$(fact $name fast_evaluations)" \
            "$(awk "BEGIN { printf \"%.0f%%\", 100 * ($(fact $name slow_evaluations) + $(fact $name fast_evaluations)) / (2 * $n0) }")" \
            "$(awk "BEGIN { printf \"%.0f%%\", 100 * $(fact $name slow_evaluations) / $n0 }")" \
            "$(worst $name 4)" "$(worst $name 5)" "$(fact $name energy_share)"
    done
    echo
    echo "newmark by the iteration (2-9) of the paper: $(fact newmark-fixed-1 slow_evaluations) sweeps in place of $n0."
    echo "daniel, explicit: slow and fast sweeps $(fact daniel-5 slow_evaluations) and $(fact daniel-5 fast_evaluations) at 5:1, $(fact daniel-10 slow_evaluations) and $(fact daniel-10 fast_evaluations) at 10:1."
}
table >"$data/costs.txt"
[ "$form" = svg ] && cp "$data/costs.txt" "$here/costs.txt"
cat "$data/costs.txt"

draw() { # SCRIPT OUTPUT VARIABLES
    gnuplot -e "form='$form'; data='$data'; out='$out/$2.$form'; $3" "$here/$1.gp"
    echo "$out/$2.$form"
}
draw motion figure-3 "n=5; which=2; errors=4; what='Figure 3: rotational angle of the bar (5:1)'; unit='angle [rad]'"
draw motion figure-4 "n=10; which=2; errors=4; what='Figure 4: rotational angle of the bar (10:1)'; unit='angle [rad]'"
draw motion figure-5 "n=5; which=3; errors=5; what='Figure 5: vibration of the slider (5:1)'; unit='displacement [m]'"
draw motion figure-6 "n=10; which=3; errors=5; what='Figure 6: vibration of the slider (10:1)'; unit='displacement [m]'"
for n in 1 5 10; do
    [ $n = 1 ] && name=newmark-1 || name=miao-$n
    echo "$n $(fact $name slow_evaluations) $(fact $name fast_evaluations)"
done >"$data/costs.dat"
draw costs costs ""
