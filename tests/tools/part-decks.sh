# part-decks.sh -- every shipped deck and every deck of tests/decks: checked, run, compared with its golden
# record (NAME.csv, tolerances NAME.tol) and, where NAME.ref gives options of `compare --reference`, with
# the reference solution of the same name. Of these, those that D names.
. tests/tools/lib.sh
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

for deck in decks/*.yaml decks/*/*.yaml tests/decks/*.yaml; do
    [ -f "$deck" ] || continue
    name=${deck##*/}
    name=${name%.yaml}
    wanted "$name" || continue
    timeout 20 "$FMDSUB" check "$deck" >"$work/out" 2>"$work/err" </dev/null
    expect "$name check" "0 $name" "$? $(sed -n '1s/:.*//p' "$work/out")" "$work/err"
    timeout "${DECK_SECONDS:-60}" "$FMDSUB" run "$deck" >"$work/$name.csv" 2>"$work/err" </dev/null
    rc=$?
    ended "$name run" 0 $rc "$work/$name.csv" "$work/err"
    [ $rc = 0 ] || continue
    compare_golden "$name" "$work/$name.csv"
    compare_reference "$name" "$work/$name.csv"
done

[ -z "$D" ] || exit 0

# Same deck, same bytes; from a file and from stdin.
"$FMDSUB" run decks/bar-slider.yaml >"$work/one.csv" 2>/dev/null
"$FMDSUB" run - <decks/bar-slider.yaml >"$work/two.csv" 2>/dev/null
same "same deck, same bytes, from a file and from stdin" "$work/one.csv" "$work/two.csv"
