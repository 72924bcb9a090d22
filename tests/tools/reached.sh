# reached.sh -- runs every test of `make test` and of `make long` on a build with --coverage, two at a time, each with counters of its own.
#
#     BUILD=build/coverage sh tests/tools/reached.sh [ITEM...]      default: those whose files are newer than their counters
#
# BUILD/reached/ITEM/ROOM/*.gcda are the counters, BUILD/reached/ITEM/seconds the time of the processor that it took.
set -u
case $BUILD in /*) ;; *) BUILD=$PWD/$BUILD ;; esac
GCOV_PREFIX_STRIP=$(echo "$BUILD/obj" | tr -cd / | wc -c)
UNIT_SECONDS=900 DECK_SECONDS=600 BAD_SECONDS=60 WHOLE=1
export BUILD GCOV_PREFIX_STRIP UNIT_SECONDS DECK_SECONDS BAD_SECONDS WHOLE
mkdir -p "$BUILD/reached"

# Counters of other code count nothing.
touch "$BUILD/reached/begun"
[ -z "$(find "$BUILD/obj" -name '*.gcno' -newer "$BUILD/reached/built" 2>/dev/null | head -n 1)" ] && [ -f "$BUILD/reached/built" ] ||
    rm -rf "$BUILD"/reached/*/
mv "$BUILD/reached/begun" "$BUILD/reached/built"

# Files of an item; those of a part that are many are a folder.
files() {
    case $1 in
    t-*) echo "tests/unit/$1.c" ;;
    decks-*) ls -d decks/"${1#decks-}".yaml decks/*/"${1#decks-}".yaml tests/decks/"${1#decks-}".yaml 2>/dev/null ;;
    faults-* | hard-* | study-* | long-*) echo "tests/${1%%-*}/${1#*-}.sh" ;;
    bad | random | effects | fuzz | reduce | validation) echo "tests/tools/part-$1.sh tests/$1" ;;
    *) echo "tests/tools/part-$1.sh" ;;
    esac
}
for item in ${*:-$(sh tests/tools/item.sh)}; do
    [ $# = 0 ] && [ -f "$BUILD/reached/$item/seconds" ] && [ -z "$(find $(files "$item") -newer "$BUILD/reached/$item/seconds")" ] && continue
    echo "$item"
done | xargs -P 2 -I{} sh -c '
    folder=$BUILD/reached/$1
    rm -rf "$folder"
    mkdir -p $(cd "$BUILD/obj" && find . -type d | sed "s|^|$folder/|") # a program that is confined makes no folder
    GCOV_PREFIX=$folder timeout 1500 sh tests/tools/item.sh "$1" >"$folder/said" 2>&1 </dev/null || echo "$1 is not ok"
    times >"$folder/times"
    awk "END { gsub(/[ms]/, \" \"); print \$1 * 60 + \$2 + \$3 * 60 + \$4 }" "$folder/times" >"$folder/seconds"' sh {}
