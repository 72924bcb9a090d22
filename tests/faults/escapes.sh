# escapes.sh -- texts of a deck, names of files and arguments reach the terminal without control characters.
. tests/tools/lib.sh
cd "$work" || exit 1
esc=$(printf '\033')
name="q$esc]0;x"
sed 's/^title:.*/title: "\\e]0;x\\a \\u009b31m \\u202e \\u2028 \\x7f"/' "$ROOT/decks/pendulum.yaml" >"$name.yaml"

# clean NAME STATUS COMMAND: no control byte but the newline, neither as one byte nor in UTF-8.
clean() {
    eval "$3" >out 2>&1 </dev/null
    rc=$?
    if [ $rc != "$2" ]; then not_ok "$1" "exit $rc, expected $2"
    elif [ ! -s out ]; then not_ok "$1" "nothing was said"
    elif LC_ALL=C tr -d '\12\40-\176\200-\377' <out | grep -q . || LC_ALL=C grep -q "$(printf '\302[\200-\237]')" out ||
        LC_ALL=C grep -q "$(printf '\342\200\256')" out; then cat -v out >seen; not_ok "$1" "control characters:" seen
    else ok "$1"; fi
}
clean "title and name of the deck, check" 0 '"$FMDSUB" check "$name.yaml"'
for form in json ndjson; do
    clean "title and name of the deck, $form" 0 '"$FMDSUB" run -q -f '$form' "$name.yaml"'
    grep -q 'u001b\]0;x\\u0007 \\u009b31m \\u202e \\u2028 \\u007f"' out && ok "the title in $form" || not_ok "the title in $form" "got:" out
done
clean "title and name of the deck, check -f json" 0 '"$FMDSUB" check -f json "$name.yaml" | tr -d "\\t"'
clean "title and name of the deck, check -f csv" 0 '"$FMDSUB" check --no-trial -f csv "$name.yaml"'
clean "name of the deck, plan line" 0 '"$FMDSUB" run -o out.csv "$name.yaml"'
clean "name of the deck, modes" 0 '"$FMDSUB" modes "$name.yaml"'
clean "name of the deck, not there" 6 '"$FMDSUB" check "no$name"'
clean "name of an output, not writable" 6 '"$FMDSUB" run -q -o "no/$name" "$name.yaml"'
clean "condition that ends the run" 0 '"$FMDSUB" run -o out.csv -s "integrate.until={when: \"t >\\r 0.1\", latest: 1}" "$name.yaml"'
clean "condition that does not" 0 '"$FMDSUB" run -o out.csv -s "integrate.until={when: \"t >\\n 2\", latest: 1}" "$name.yaml"'
clean "verb" 2 '"$FMDSUB" "$name"'
clean "option" 2 '"$FMDSUB" run "--$name"'
clean "column" 2 '"$FMDSUB" run --columns "$name" "$name.yaml"'
clean "code" 2 '"$FMDSUB" explain "$name"'
[ -x "$BUILD/fmdsub-reduce" ] && clean "fmdsub-reduce: name of a job" 6 '"$BUILD/fmdsub-reduce" -i root=root "$name"'
grep -q '\\x1b\]0;x' out && ok "the characters are shown as escapes" || not_ok "the characters are shown as escapes" "got:" out
