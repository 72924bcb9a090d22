# split.sh -- what sub-cycling at 10:1 costs beside its ideal, in instructions by callgrind: the same number every time.
#
# The ideal is (c_L/n + c_S)/(c_L + c_S) of the single rate at the small step, c_L and c_S what an evaluation of the slow and of
# the fast class takes.  Each limit that is passed fails; a goal that is not met yet is told, and may not get further off.
# Decks with loops, where the limit ends with `single`, may not take more than the single rate.  Evaluations alone, at the same
# prices, are wanted at EVALUATIONS of their ideal; where a deck is above one of the two a table says what they are for.
#
#     BUILD=build [D=arms,telescope] sh tests/bench/split.sh
. tests/tools/lib.sh
command -v valgrind >/dev/null || { skip split "valgrind is not installed"; exit 0; }
n=10
EVALUATIONS=1.15

collected() { # DECK PART: instructions
    valgrind --tool=callgrind --callgrind-out-file=/dev/null "$BUILD/bench/subcycling" "$1" 1 $n "$2" 2>&1 >/dev/null |
        awk '/Collected/ { print $NF }'
}

split() { # NAME DECK LIMIT FOR_NOW [single]
    wanted "$1" || return 0
    for part in open open-subcycle slow fast midpoint subcycle; do collected "$2" $part; done >"$work/counts"
    set -- "$@" -
    awk -v n=$n '{ x[NR] = $1 }
        END { slow = x[3] - x[1]; fast = x[4] - x[1]; single = x[5] - x[1]; two = x[6] - x[2]
              if (NR < 6 || slow <= 0 || single <= 0) exit 1
              ratio = two / single; printf "%.3f %.3f %d %d\n", ratio, ratio * (slow + fast) / (slow / n + fast), slow, fast }' "$work/counts" >"$work/ratio" ||
        { bad=1; not_ok "$1" "not counted" "$work/counts"; return 0; }
    read -r of_single over slow fast <"$work/ratio"
    "$BUILD/bench/subcycling" "$2" 1 $n spent "$slow" "$fast" >"$work/spent"
    evaluations=$(awk '$1 == "all" { print $NF }' "$work/spent")
    said="$over times the ideal, $of_single of the single rate; in evaluations $evaluations times"
    if ! awk -v x="$over" -v most="$4" 'BEGIN { exit !(x <= most) }'; then bad=1; not_ok "$1" "$said: more than $4"
    elif [ "$5" = single ] && ! awk -v x="$of_single" 'BEGIN { exit !(x <= 1) }'; then bad=1; not_ok "$1" "$said: more than that"
    elif ! awk -v x="$over" -v most="$3" 'BEGIN { exit !(x <= most) }'; then known "$1" "$said, wanted $3"
    elif ! awk -v x="$evaluations" -v most=$EVALUATIONS 'BEGIN { exit !(x <= most) }'; then
        known "$1" "$said, wanted $EVALUATIONS"
    else ok "$1: $said, at most $3"; return 0; fi
    sed 's/^/    /' "$work/spent"
}

split arms tests/bench/arms.yaml 1.30 1.30
split long-chain tests/bench/long-chain.yaml 1.30 1.30
split stiff-leaf-chain decks/stiff-leaf-chain.yaml 1.30 1.30
split turbine-blade decks/turbine-blade.yaml 1.30 1.30
split light-hub decks/light-hub.yaml 1.40 1.40
split telescope decks/telescope.yaml 1.40 1.40 single
split driven-telescope decks/driven-telescope.yaml 1.45 1.45 single
split geared-pendulum decks/geared-pendulum.yaml 1.65 1.65 single
exit ${bad:-0}
