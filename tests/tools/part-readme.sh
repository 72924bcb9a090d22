# part-readme.sh -- what the README shows, typed: its decks run as they stand, its tour goes on the first of them; and the three
# commands that the demo ends with.
. tests/tools/lib.sh
need_program readme
mkdir "$work/x"
cp -r decks README.md "$work/x"
cd "$work/x" || exit 1
PATH=$BUILD:$PATH

awk '/^```yaml/ { n++; inside = 1; next } /^```/ { inside = 0 } inside { print >("deck" n ".yaml") }' README.md
expect "decks in the README" 2 "$(ls deck?.yaml | wc -l)"
for deck in deck?.yaml; do
    timeout 60 fmdsub run "$deck" >out 2>err
    ended "$deck runs as it stands" 0 $? out err
    expect "$deck: its balance is kept" 1 "$(grep -c 'energy balance kept' err)" err
done

# The tour: each line up to two blanks in a row; wishes of other files and of parameters that the deck has not are met first.
mkdir tour
sed 's/stiffness: 100/stiffness: k/; s/^title/parameters: {k: 100}\n&/' deck1.yaml >tour/deck.yaml
cd tour || exit 1
cp ../deck2.yaml bent.yaml
fmdsub run -q deck.yaml >golden.csv 2>/dev/null
sed -n '/^## A tour/,/^## /s/^    \(fmdsub .*\)$/\1/p' ../README.md | sed 's/  .*//' >tour.txt
expect "the tour has its commands" yes "$([ "$(wc -l <tour.txt)" -ge 15 ] && echo yes)" tour.txt
while IFS= read -r line; do
    deck=deck.yaml
    case $line in *arm.*) line=$(echo "$line" | sed 's/deck\.yaml/bent.yaml/; s/--over k=[^ ]*/--over bodies.arm.modes=[4,6]/') ;; esac
    case $line in
    fmdsub-reduce*) continue ;; # of a job of CalculiX: tests/reduce
    *plot*) command -v gnuplot >/dev/null || continue ;;
    *study*) line="$line --budget 5 --repeats 0" ;;
    esac
    timeout 120 sh -c "$line" >out 2>err </dev/null
    status=$?
    case $line in *" -o "*) out=$(echo "$line" | sed 's/.* -o \([^ ]*\).*/\1/') ;; *) out=out ;; esac
    ended "tour: $line" 0 $status "$out" err
done <tour.txt

cd "$ROOT" || exit 1
BUILD=$BUILD sh tests/tools/demo.sh >"$work/demo" 2>&1
expect "the demo" 0 $? "$work/demo"
sed -n '/^next:/,$s/^    //p' "$work/demo" >"$work/next"
expect "the demo ends with three commands" 3 "$(wc -l <"$work/next")" "$work/demo"
mkdir -p "$work/home"
ln -s "$ROOT/decks" "$work/home/decks"
case $BUILD in "$ROOT"/*) mkdir -p "$work/home/$(dirname "${BUILD#"$ROOT"/}")" && ln -s "$BUILD" "$work/home/${BUILD#"$ROOT"/}" ;; esac
while IFS= read -r line; do
    (cd "$work/home" && timeout 120 sh -c "$line") >"$work/out" 2>"$work/err" </dev/null
    expect "as printed: ${line%%    *}" 0 $? "$work/err"
done <"$work/next"
