# item.sh -- the tests in pieces, for what looks at each alone (reached.sh, mutants.sh).
#
#     BUILD=build sh tests/tools/item.sh              their names: t-NAME, decks-NAME, faults-NAME, hard-NAME, study-NAME, long-NAME, or a part
#     BUILD=build sh tests/tools/item.sh NAME         runs one: its lines, and ends with 1 where one is `not ok`
#
# The first that is not ok ends the item, unless WHOLE=1.
BUILD=${BUILD:-build}
if [ $# = 0 ]; then
    printf '%s\n' bad random validation order effects airscrew users plot sweep animate diff man install fuzz reduce
    for script in tests/faults/*.sh tests/hard/*.sh tests/study/*.sh tests/long/*.sh; do
        name=${script#tests/}
        name=${name%.sh}
        echo "${name%/*}-${name#*/}"
    done
    for deck in decks/*.yaml decks/*/*.yaml tests/decks/*.yaml; do
        name=${deck##*/}
        echo "decks-${name%.yaml}"
    done
    for test in tests/unit/t-*.c; do
        name=${test##*/}
        echo "${name%.c}"
    done
    exit
fi
stop="-m 1"
[ -z "${WHOLE:-}" ] || stop=
# Whole stops the pipe at the first that is not ok; what the item says is seen where nothing stops it.
judge() { if [ "$stop" ]; then ! grep -m 1 '^not ok'; else awk '{ print } /^not ok/ { bad = 1 } END { exit bad }'; fi; }
case $1 in
t-*) "$BUILD/unit/$1" 2>&1 ;;
decks-*) D=${1#decks-} sh tests/tools/part-decks.sh | judge ;;
faults-* | hard-* | study-* | long-*) sh "tests/${1%%-*}/${1#*-}.sh" | judge ;;
*) sh "tests/tools/part-$1.sh" | judge ;;
esac
