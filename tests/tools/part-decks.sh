# part-decks.sh -- every shipped deck and every deck of tests/decks: checked, run, compared with its golden
# record (NAME.csv, tolerances NAME.tol) and, where NAME.ref gives options of `compare --reference`, with
# the reference solution of the same name; what is said of each, with what is said by tests/said/runs.txt. Of these, those that D names.
. tests/tools/lib.sh
. tests/tools/sums.sh
need_program decks

compare_golden() { # NAME RUN
    golden=tests/decks/$1.csv
    if [ ! -f "$golden" ]; then not_ok "$1 golden" "no golden record $golden; make golden WRITE=1 makes it"; return; fi
    set -- "$1" "$2" "$golden"
    [ -f "tests/decks/$1.tol" ] && tol="--tol tests/decks/$1.tol" || tol=
    if "$COMPARE" $tol "$3" "$2" >"$work/cmp" 2>&1; then ok "$1 golden"
    else not_ok "$1 golden" "records differ from $3" "$work/cmp"; fi
}

compare_reference() { # NAME RUN
    [ -f "tests/decks/$1.ref" ] || return 0
    map=
    [ -f "tests/refdata/$1.map" ] && map="--map tests/refdata/$1.map"
    eval "set -- '$1' '$2' $(grep -v '^#' "tests/decks/$1.ref" | tr '\n' ' ')"
    name=$1 run=$2
    shift 2
    if "$COMPARE" --reference --all $map "$@" "tests/refdata/$name.csv" "$run" >"$work/cmp" 2>&1; then ok "$name reference"
    else not_ok "$name reference" "too far from tests/refdata/$name.csv" "$work/cmp"; fi
}

# What it takes, counted, is what tests/decks/counts.txt says, by a fiftieth and three: NAME slow fast factors sweeps rejected.  So are
# the smallest step and the error that it estimates, by a fiftieth, and of a deck under another scheme the sum of what is
# written of its last record, by 1e-6.  More of it is slower; less is better only if nothing was lost: iterations, estimates of
# error, steps.  Then it is written down anew: COUNTS=FILE: all lines go there.
compare_counts() { # NAME [RECORDS]
    { [ $# = 1 ] || tail -n 1 "$2"; } | awk -F, '{ for (i = 2; i <= NF; i++) sum += $i < 0 ? -$i : $i } END { printf "sum %s\n", NR ? sprintf("%.12g", sum) : "-" }' >"$work/last"
    awk -v name="$1" '{ x[$1] = $2 } END {
        n = split("slow_evaluations fast_evaluations factorizations sweeps rejected smallest_step estimated_error sum", key, " ")
        printf "%s", name
        for (i = 1; i <= n; i++) printf " %s", x[key[i]] == "" ? "-" : x[key[i]]
        print "" }' "$work/stats" "$work/last" >"$work/counts"
    [ -z "${COUNTS:-}" ] || cat "$work/counts" >>"$COUNTS"
    grep "^$1 " tests/decks/counts.txt >"$work/was" || { not_ok "$1 effort" "has no line in tests/decks/counts.txt" "$work/counts"; return; }
    awk '
        function apart(a, b, part, more,    d) { d = a < b ? b - a : a - b; return a != b && !(d <= part * (b < 0 ? -b : b) + more) }
        NR == 1 { for (i = 2; i <= 9; i++) was[i] = $i; next }
        { for (i = 2; i <= 9; i++) if (apart($i, was[i], i == 9 ? 1e-6 : .02, i < 7 ? 3 : i == 9 ? 1e-9 : 0)) bad = 1; n = NF }
        END { exit bad || n != 9 }' "$work/was" "$work/counts" &&
        ok "$1 effort" || not_ok "$1 effort" "not tests/decks/counts.txt: slow, fast, factors, sweeps, rejected, smallest step, estimated error, sum, as it was and is" "$work/was" "$work/counts"
}

for deck in decks/*.yaml decks/*/*.yaml tests/decks/*.yaml; do
    [ -f "$deck" ] || continue
    name=${deck##*/}
    name=${name%.yaml}
    wanted "$name" || continue
    timeout "${CHECK_SECONDS:-60}" "$FMDSUB" check "$deck" >"$work/out" 2>"$work/err" </dev/null
    expect "$name check" "0 $name" "$? $(sed -n '1s/:.*//p' "$work/out")" "$work/err"
    timeout "${DECK_SECONDS:-60}" "$FMDSUB" run --stats="$work/stats" "$deck" >"$work/$name.csv" 2>"$work/err" </dev/null
    rc=$?
    ended "$name run" 0 $rc "$work/$name.csv" "$work/err"
    heard "$name" "$work/err"
    [ $rc = 0 ] || continue
    compare_golden "$name" "$work/$name.csv"
    compare_reference "$name" "$work/$name.csv"
    compare_counts "$name"
done

# Decks under other schemes, by their lines there: NAME is DECK,KEY=VALUE,KEY=VALUE..., all keys of integrate.
for case in $(awk '$1 ~ /,/ { print $1 }' tests/decks/counts.txt); do
    name=${case%%,*}
    wanted "$name" || continue
    deck=$(ls "decks/$name.yaml" "tests/decks/$name.yaml" 2>/dev/null)
    timeout "${DECK_SECONDS:-60}" "$FMDSUB" run --stats="$work/stats" --every-steps 5 \
        --set "integrate={$(echo "${case#*,}" | sed 's/=/: /g; s/,/, /g')}" "$deck" >"$work/out" 2>"$work/err" </dev/null
    rc=$?
    ended "$case run" 0 $rc "$work/out" "$work/err"
    heard "$case" "$work/err"
    [ $rc = 0 ] && compare_counts "$case" "$work/out"
done

sums_judge tests/said/runs.txt "${D:+some}" 6 # some say what is round-off
[ -z "$D" ] || exit 0

# Same deck, same bytes; from a file and from stdin.
"$FMDSUB" run decks/bar-slider.yaml >"$work/one.csv" 2>/dev/null
"$FMDSUB" run - <decks/bar-slider.yaml >"$work/two.csv" 2>/dev/null
same "same deck, same bytes, from a file and from stdin" "$work/one.csv" "$work/two.csv"

# Signals, helpers, named tables, a drive from where it is drawn: the same motion as with all of it written out.
sed -e '/^signals:/,/^tables:/d' -e 's/, late, road, {both: push + late}//' \
    -e 's/value: push/value: "3*((G) - pin.angle) - d*pin.angle_rate + if(t < 0.5505, 0, if(t < 0.5705, -0.4, 0))"/' \
    -e 's/late > 0.0495/(G) - pin.angle > 0.0495/' -e 's/value: half, from: drawn/value: {table: [[0, 2], [1, 2.5]]}/' \
    -e 's/table: bumps/table: [[0, 0], [0.25, 0.1], [0.5, 0]]/' -e 's/value: road/value: {table: [[0, 0], [0.25, 0.1], [0.5, 0]]}/' \
    -e 's/when: \([^,]*\)/when: "\1"/' tests/decks/signals.yaml |
    sed -e 's/(G)/(0.05*S*if(t < 0.6, 1, 0) + if(pin.angle < 0, 0, if(pin.angle < 0.02, pin.angle\/2, 0.01)))/' \
        -e 's/S\*/if(t < 0.1, 0, if(t < 0.4, ((t - 0.1)\/0.3)^3*(10 - 15*(t - 0.1)\/0.3 + 6*((t - 0.1)\/0.3)^2), 1))*/' >"$work/out.yaml"
"$FMDSUB" run -q "$work/out.yaml" >"$work/long.csv" 2>"$work/err"
ended "signals written out" 0 $? "$work/long.csv" "$work/err"
"$FMDSUB" run -q -c pin.angle,slide.displacement tests/decks/signals.yaml >"$work/short.csv" 2>"$work/err"
"$COMPARE" --reference --within 1e-9 --columns "pin.angle slide.displacement" "$work/long.csv" "$work/short.csv" >"$work/diff" 2>&1
expect "signals are what they stand for" "0 10" "$? $(wc -l <"$work/short.csv")" "$work/diff" "$work/err"
