# prices.sh -- what the kernels of a step take, in instructions by callgrind: the same number every time.
#
# Prices of an evaluation are differences between scenes that differ in one thing, so that a body, an equation of a loop and a
# mode have their shares of all that a step does; factors of matrices are counted apart.  Compares with the table that
# `fmdsub explain DECK` reads, src/study/price_table.h: a price that is a fifth off fails.  With WRITE=1 the table is written.
. tests/tools/lib.sh
command -v valgrind >/dev/null || { skip prices "valgrind is not installed"; exit 0; }
scenes=tests/bench/prices
table=src/study/price_table.h

# run_of DECK UNTIL [ARGUMENT...]: instructions of all, of factors; evaluations, factorizations, steps.
run_of() {
    deck=$1 until=$2
    shift 2
    valgrind --tool=callgrind --compress-strings=no --compress-pos=no --callgrind-out-file="$work/cg" "$FMDSUB" run -q \
        --every-steps 100000000 --until "$until" --stats="$work/stats" "$@" "$deck" >/dev/null 2>"$work/err" || cat "$work/err" >&2
    awk 'NR == FNR { x[$1] = $2; next }
        /^totals:/ || /^summary:/ { all = $2 } /^cfn=/ { factor = $0 ~ /^cfn=(matrix_factor|stage_matrix_factor)$/; next }
        /^calls=/ { getline; if (factor) factors += $2 }
        END { print all, factors + 0, x["slow_evaluations"], x["factorizations"], x["major_steps"] }' "$work/stats" "$work/cg"
}

# count NAME DECK FROM TO [ARGUMENT...]: into $work/NAME, of the steps between: instructions of an evaluation without factors, of
# one factorization, evaluations, factorizations, instructions and steps.
count() {
    name=$1 deck=$2 from=$3 to=$4
    shift 4
    run_of "$deck" "$from" "$@" >"$work/a"
    run_of "$deck" "$to" "$@" >"$work/b"
    paste -d' ' "$work/a" "$work/b" | awk '{ e = $8 - $3; f = $9 - $4
        printf "%.10g %.10g %d %d %d %d\n", ($6 - $1 - $7 + $2) / e, f ? ($7 - $2) / f : 0, e, f, $6 - $1, $10 - $5 }' >"$work/$name"
    [ "${SHOW:-}" = 1 ] && echo "$name $(cat "$work/$name")"
}

of() { # NAME FIELD
    awk -v k="$2" '{ print $k }' "$work/$1"
}

# price SPACE NAME FORMULA
price() { printf '%s %s %s\n' "$1" "$2" "$(reckon "$3")" | tee -a "$work/prices"; }

reckon() { awk "BEGIN { printf \"%.4g\", $1 }"; }

for space in plane space; do
    chain="$scenes/chain-$space.yaml .05 .15"
    beam="$scenes/beam-$space.yaml .1 .3"
    count n2 $chain --set parameters.N=2
    count n18 $chain --set parameters.N=18
    count four-bar tests/bench/effects/fourbar-$space.yaml .1 .3 --set effects.out_of_plane=true
    count crank tests/bench/effects/crank-$space.yaml .02 .03 --set effects.out_of_plane=true
    count m4 $beam --set parameters.n=4
    count m8 $beam --set parameters.n=8
    count m16 $beam --set parameters.n=16
    body=$(reckon "($(of n18 1) - $(of n2 1)) / 16")
    any=$(reckon "$(of n2 1) - 2 * $body")
    # A four-bar of three bodies with 2 or 5 equations; a crank with 3 and 7 modes, in space 6 and 10.
    case $space in plane) rows=2 held=3 bend=7 ;; *) rows=5 held=6 bend=10 ;; esac
    row=$(reckon "($(of four-bar 1) - $any - 3 * $body) / $rows")
    # c + mode n + pair n^2 at n = 4, 8 and 16
    pair=$(reckon "(($(of m16 1) - $(of m8 1)) / 8 - ($(of m8 1) - $(of m4 1)) / 4) / 12")
    mode=$(reckon "($(of m8 1) - $(of m4 1)) / 4 - 12 * $pair")
    price $space any "$any"
    price $space body "$body"
    price $space row "$row"
    price $space mode "$mode"
    price $space pair "$pair"
    price $space bent "($(of crank 1) - $any - 3 * $body - $held * $row - $bend * ($mode + $bend * $pair)) / $held / $bend"
    price $space structured "$(of m8 2) / $(of m8 1)"
done
count with decks/floating-satellite.yaml .2 .6 --columns t --set effects.momentum=true
count without decks/floating-satellite.yaml .2 .6 --columns t --set effects.momentum=false
price both balance "$(of with 1) / $(of without 1) - 1"
count with tests/bench/effects/chain-plane.yaml .2 .6 --columns t --set effects.ledger=true
count without tests/bench/effects/chain-plane.yaml .2 .6 --columns t --set effects.ledger=false
price both look "($(of with 5) - $(of without 5)) / $(of with 6) / .875 / $(of without 1)"
count stages $scenes/chain-plane.yaml .05 .15 --set parameters.N=32 --set integrate.scheme=radau5 --set integrate.tolerance=1.0e-6
price both full "$(of stages 2) / 32^3"

row_of() { # SPACE: the values in the order of the table's columns
    for name in any body row mode pair bent structured; do awk -v s="$1" -v n="$name" '$1 == s && $2 == n { printf "%s, ", $3 }' "$work/prices"; done
}
value() { awk -v n="$1" '$2 == n { print $3 }' "$work/prices"; }
{
    echo "/* price_table.h -- what the kernels of a step take, in instructions.  Written by \`make prices WRITE=1\` from counts by"
    echo " * callgrind (tests/bench/prices.sh); do not edit. */"
    echo "#ifndef FMDSUB_STUDY_PRICE_TABLE_H"
    echo "#define FMDSUB_STUDY_PRICE_TABLE_H"
    echo
    echo "/* any, body, row, mode, pair, bent; structured in evaluations */"
    echo "#define PRICE_PLANAR $(row_of plane | sed 's/, $//')"
    echo "#define PRICE_SPATIAL $(row_of space | sed 's/, $//')"
    echo "/* balance, look in evaluations; full of n^3 */"
    echo "#define PRICE_SHARED $(value balance), $(value look), $(value full)"
    echo
    echo "#endif"
} >"$work/table.h"
[ "${WRITE:-}" = 1 ] && cp "$work/table.h" $table && exit 0 # a program of this table is yet to be built

# Both as numbers in order.
numbers() { sed -n 's/^#define PRICE_[A-Z]* //p' "$1" | tr -d , | tr '\n' ' '; }
awk -v now="$(numbers "$work/table.h")" -v was="$(numbers $table)" 'BEGIN {
    n = split(now, a); m = split(was, b)
    if (n != 17 || m != n) { print "n has", n, "numbers, the table", m; exit }
    for (i = 1; i <= n; i++) { d = a[i] - b[i]; if (d < 0) d = -d; if (!(a[i] > 0) || d > .2 * b[i]) print "number", i, "is", a[i], "now,", b[i], "in the table" } }' >"$work/off"
expect "prices of the table are those counted, within a fifth" 0 "$(wc -l <"$work/off")" "$work/off"

# What explain tells of a step, from that table and a run's counts, against instructions counted of the run.
while read -r deck from to args; do
    count run "$deck" "$from" "$to" $args
    told=$("$FMDSUB" explain --format json "$deck" 2>"$work/err" | sed -n 's/.*"instructions_per_step":[[:space:]]*\([0-9.e+]*\).*/\1/p')
    ratio=$(awk -v told="${told:-0}" -v a="$(of run 5)" -v n="$(of run 6)" 'BEGIN { printf "%.2f", told * n / a }')
    expect "$deck: instructions told, of those counted: $ratio, within a factor of 2" yes "$(awk -v r="$ratio" 'BEGIN { print (r > .5 && r < 2) ? "yes" : "no" }')" "$work/err"
done <<'DECKS'
decks/pendulum.yaml .2 .6
decks/chain.yaml .2 .6
decks/four-bar.yaml .2 .6
decks/bricard.yaml .2 .6
decks/heavy-top.yaml .02 .06
decks/flexible-crank.yaml .02 .06
decks/flexible-pendulum.yaml .02 .06
decks/cantilever.yaml .02 .04
decks/rotating-blade.yaml .04 .08
decks/floating-satellite.yaml .2 .6
DECKS
