# split.sh -- what sub-cycling at N:1 (10:1) costs beside its ideal, in instructions by callgrind: the same number every time.
#
# The ideal is (c_L/n + c_S)/(c_L + c_S) of the single rate at the small step, c_L and c_S what an evaluation of the slow and of
# the fast class takes.  Each limit that is passed fails, that on instructions at 10:1 only, that on evaluations alone, at the same
# prices, at any ratio; a table says what they are for then.  Decks with loops, whose line ends with `single`, may not take more
# than the single rate at 10:1 to 20:1.
#
#     BUILD=build [D=arms,telescope] [N=20] sh tests/bench/split.sh
. tests/tools/lib.sh
command -v valgrind >/dev/null || { skip split "valgrind is not installed"; exit 0; }
n=${N:-10}

collected() { # DECK PART: instructions
    valgrind --tool=callgrind --callgrind-out-file=/dev/null "$BUILD/bench/subcycling" "$1" 1 $n "$2" 2>&1 >/dev/null |
        awk '/Collected/ { print $NF }'
}

split() { # NAME DECK INSTRUCTIONS EVALUATIONS [single]
    wanted "$1" || return 0
    for part in open open-subcycle slow fast midpoint subcycle; do collected "$2" $part; done >"$work/counts"
    set -- "$@" -
    awk -v n=$n '{ x[NR] = $1 }
        END { slow = x[3] - x[1]; fast = x[4] - x[1]; single = x[5] - x[1]; two = x[6] - x[2]
              if (NR < 6 || slow <= 0 || single <= 0) exit 1
              ratio = two / single; printf "%.3f %.3f %d %d\n", ratio, ratio * (slow + fast) / (slow / n + fast), slow, fast }' "$work/counts" >"$work/ratio" ||
        { [ $n = 10 ] || { skip "$1" "steps of $n do not fit its records"; return 0; }; bad=1; not_ok "$1" "not counted" "$work/counts"; return 0; }
    read -r of_single over slow fast <"$work/ratio"
    "$BUILD/bench/subcycling" "$2" 1 $n spent "$slow" "$fast" >"$work/spent"
    evaluations=$(awk '$1 == "all" { print $NF }' "$work/spent")
    said="$over times the ideal, $of_single of the single rate; in evaluations $evaluations times"
    above() { awk -v x="$1" -v most="$2" 'BEGIN { exit !(!(x <= most)) }'; }
    if [ $n = 10 ] && above "$over" "$3"; then said="$said: more than $3"
    elif [ -z "$evaluations" ] || above "$evaluations" "$4"; then said="$said: more than $4"
    elif [ "$5" = single ] && [ $n -ge 10 ] && [ $n -le 20 ] && above "$of_single" 1; then said="$said: more than that"
    else ok "$1: $said"; return 0; fi
    bad=1
    not_ok "$1" "$said" "$work/spent"
}

[ $n -lt 10 ] && few=1.35 || few=1.15
split arms tests/bench/arms.yaml 1.20 $few
split long-chain tests/bench/long-chain.yaml 1.25 $few
split stiff-leaf-chain decks/stiff-leaf-chain.yaml 1.30 $few
split turbine-blade decks/turbine-blade.yaml 1.30 $few
split light-hub decks/light-hub.yaml 1.40 1.5
split telescope decks/telescope.yaml 1.40 1.7 single
split driven-telescope decks/driven-telescope.yaml 1.45 1.7 single
split geared-pendulum decks/geared-pendulum.yaml 1.65 1.7 single
exit ${bad:-0}
