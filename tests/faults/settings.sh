# settings.sh -- one value of a shipped deck changed: one error of these words, one warning, or nothing to say.
#
# settings.txt has them; words that begin with `warning: ` are of a warning, `-` is a value that is right.
. tests/tools/lib.sh

# setting DECK PATH=VALUE WORDS
setting() {
    "$FMDSUB" check --no-trial --set "$2" "decks/$1.yaml" >"$work/out" 2>"$work/err" </dev/null
    rc=$?
    case $3 in
    -) want=0 count=0 words= ;;
    'warning: '*) want=0 count=1 words=$3 ;;
    *) want=3 count=1 words="error: $3" ;;
    esac
    if [ $rc != $want ]; then not_ok "$1 $2" "exit $rc, expected $want" "$work/err"
    elif [ $want = 3 ] && [ -s "$work/out" ]; then not_ok "$1 $2" "words on standard output" "$work/out"
    elif [ "$(grep -c ': error: \|: warning: ' "$work/err")" != $count ]; then not_ok "$1 $2" "expected $count to be told" "$work/err"
    elif ! grep -qF -- "$words" "$work/err" "$work/out"; then not_ok "$1 $2" "expected: $words" "$work/err"
    else ok "$1 $2"; fi
}

tab=$(printf '\t')
while IFS=$tab read -r deck set words; do
    case $deck in '' | '#'*) continue ;; esac
    setting "$deck" "$set" "$words"
done <tests/faults/settings.txt

# Characters: the first and last of each length, and what is none: halves of pairs, longer forms, above U+10FFFF.
for letter in 302\\241=00A1 337\\277=07FF 340\\240\\200=0800 355\\237\\277=D7FF 356\\200\\200=E000 357\\277\\275=FFFD 360\\220\\200\\200=10000 364\\217\\277\\275=10FFFD; do
    "$FMDSUB" check --set "$(printf "parameters.a\\${letter%=*}=1")" decks/pendulum.yaml 2>&1 >"$work/out" | grep -q "it holds the letter U+${letter#*=}, which" &&
        ok "the letter U+${letter#*=}" || not_ok "the letter U+${letter#*=}" "not told as such"
done
for bytes in 355\\240\\200 355\\277\\277 300\\200 301\\277 340\\237\\277 360\\217\\277\\277 364\\220\\200\\200 370\\210\\200\\200 200 302 342\\202; do
    setting pendulum "$(printf "title=\\$bytes")" "a character that cannot be in a deck"
done | sed "s/^ok.*/ok no character/"
