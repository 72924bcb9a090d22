# golden.sh -- what would change in the golden records, column by column; WRITE=1 rewrites them.
. tests/tools/lib.sh

for deck in decks/*.yaml decks/*/*.yaml tests/decks/*.yaml; do
    [ -f "$deck" ] || continue
    name=${deck##*/}
    name=${name%.yaml}
    golden=tests/decks/$name.csv
    if ! "$FMDSUB" run "$deck" >"$work/run.csv" 2>"$work/err" </dev/null; then
        echo "$name: the run failed"
        cat "$work/err"
        continue
    fi
    if cmp -s "$golden" "$work/run.csv"; then echo "$name: same bytes"; continue; fi
    if [ -f "$golden" ]; then
        echo "$name:"
        tol=
        [ -f "tests/decks/$name.tol" ] && tol="--tol tests/decks/$name.tol"
        "$COMPARE" $tol --all "$golden" "$work/run.csv" | grep -v 'difference 0,' | sed 's/^/    /'
    else
        echo "$name: new"
    fi
    if [ "${WRITE:-}" = 1 ]; then cp "$work/run.csv" "$golden" && echo "    written: $golden"; fi
done
