# headline.sh -- what a step costs in the decks that are compared with others, in instructions by callgrind: the same number
# every time.  Each limit that is passed fails; a goal that is not met yet is told, and may not get further off.
#
# A count is the difference of two runs over the steps between them.  The second column of `deck` is the count of b29caca,
# measured likewise: FMDSUB=.../fmdsub of that commit sh tests/bench/headline.sh.
. tests/tools/lib.sh
command -v valgrind >/dev/null || { skip headline "valgrind is not installed"; exit 0; }

collected() { # COMMAND...: instructions
    valgrind --tool=callgrind --callgrind-out-file=/dev/null "$@" 2>&1 >/dev/null | awk '/Collected/ { print $NF }'
}

until_step() { awk -v h="$1" -v n="$2" 'BEGIN { printf "%.12g", n * h }'; } # H STEPS

per_step() { # DECK H FROM TO [ARGUMENT...]
    deck=$1 h=$2 from=$3 to=$4
    shift 4
    a=$(collected "$FMDSUB" run -q --every-steps 100000000 --until "$(until_step "$h" "$from")" --set integrate.step="$h" "$@" "$deck")
    b=$(collected "$FMDSUB" run -q --every-steps 100000000 --until "$(until_step "$h" "$to")" --set integrate.step="$h" "$@" "$deck")
    awk -v a="$a" -v b="$b" -v n=$((to - from)) 'BEGIN { printf "%.0f\n", (b - a) / n }'
}

# at_most NAME COUNT LIMIT WAS [FOR_NOW]: FOR_NOW above the limit: what it may be until the limit is met.
at_most() {
    if ! awk -v x="$2" -v most="${5:-$3}" 'BEGIN { exit !(x > 0 && x <= most) }'; then not_ok "$1" "$2 is more than ${5:-$3} (b29caca $4)"
    elif ! awk -v x="$2" -v most="$3" 'BEGIN { exit !(x <= most) }'; then known "$1" "$2, wanted $3 (b29caca $4)"
    else ok "$1: $2, at most $3 (b29caca $4)"; fi
}

deck() { # NAME WAS LIMIT FOR_NOW DECK H FROM TO [ARGUMENT...]
    name=$1 was=$2 limit=$3 now=$4
    shift 4
    wanted "$name" || return 0
    at_most "$name" "$(per_step "$@")" "$limit" "$was" "$now"
}

newmark="--set integrate.scheme=newmark"
# shellcheck disable=SC2086 # several words
{
    deck chain-8 16234 12500 12500 decks/chain.yaml 1.0e-3 500 2500 $newmark --set parameters.N=8 --columns pin1.angle
    deck chain-32 115370 57685 57685 decks/chain.yaml 2.0e-3 500 2500 $newmark --set parameters.N=32 --columns pin1.angle
    deck chain-128 683369 273347 273347 decks/chain.yaml 5.0e-3 200 1000 $newmark --set parameters.N=128 --columns pin1.angle
    deck four-bar-10 113405 70000 70000 decks/windows.yaml 2.0e-3 100 400 $newmark --set parameters.N=10 --columns foot1.angle
    deck flexible-crank 77887 45000 45000 decks/flexible-crank.yaml 5.0e-5 500 1500 $newmark --columns slider.x
    deck blade 49617 26000 26000 decks/spin-up.yaml 1.0e-2 500 1500 $newmark --columns arm.tip.dy
    deck rotating-blade 152401 120000 120000 decks/rotating-blade.yaml 2.0e-4 200 600 --columns blade.tip.dz
}

# A long chain, per link and evaluation, against one of 128.
per_link() { # N
    n=$1
    steps=4
    [ "$n" -lt 1000 ] && steps=40
    for k in $steps $((3 * steps)); do
        collected "$FMDSUB" run -q --every-steps 100000000 --until "$(until_step 1.0e-4 "$k")" --columns pin1.angle $newmark \
            --set parameters.N="$n" --set integrate.step=1.0e-4 --stats="$work/stats" decks/chain.yaml
        awk '$1 == "slow_evaluations" { print $2 }' "$work/stats"
    done | awk -v n="$n" '{ x[NR] = $1 } END { printf "%.1f\n", (x[3] - x[1]) / (x[4] - x[2]) / n }'
}
if wanted long-chain; then
    few=$(per_link 128)
    many=$(per_link 20000)
    at_most "long-chain: link and evaluation of 20000, of 128" "$(awk -v a="$many" -v b="$few" 'BEGIN { printf "%.3f", a / b }')" 1.4 "takes 16 GB"
fi

# A row of CSV, of the columns of the deck.
if wanted rows; then
    set -- --set integrate.scheme=rk4 --set integrate.step=1.0e-3 --until 2 decks/double-pendulum.yaml
    a=$(collected "$FMDSUB" run -q --every-steps 100000000 "$@")
    b=$(collected "$FMDSUB" run -q --every-steps 1 "$@")
    rows=$("$FMDSUB" run -q --every-steps 1 "$@" | wc -l) # names, start and end are in both
    at_most "rows: a row of nine numbers" "$(awk -v a="$a" -v b="$b" -v n=$((rows - 3)) 'BEGIN { printf "%.0f", (b - a) / n }')" 3042 5070
fi
