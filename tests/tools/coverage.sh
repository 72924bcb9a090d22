# coverage.sh -- lines and branches of src that the tests of `make test` reach, by folder; then the functions that none does.
#
#     BUILD=build/coverage sh tests/tools/coverage.sh          after reached.sh
#
# Lines are those of src/*/*.c that gcov finds code in.  Branches are its ways out of a condition, both of every TRY among them,
# so those that only a refused allocation, a full disk or a limit takes; not those of an assert, of which one cannot be taken.
# BUILD/missed lists what none reaches, FILE:LINE: a line that does not run, FILE:LINE N of M: ways not taken, by folder.
# The aims: lines 97 percent, branches 87; exit 1 below them.
. tests/tools/lib.sh
for tool in gcov gcov-tool; do command -v $tool >/dev/null || { echo "coverage: $tool is not installed" >&2; exit 2; }; done

for item in "$BUILD"/reached/*/seconds; do
    case $item in */long-*) continue ;; esac
    [ -f "$item" ] || { echo "coverage: nothing has run in $BUILD" >&2; exit 2; }
    [ "$(find "${item%/*}" -name '*.gcda' | head -n 1)" ] || continue
    [ -d "$work/sum" ] || { cp -r "${item%/*}" "$work/sum"; continue; }
    gcov-tool merge "$work/sum" "${item%/*}" -o "$work/next" 2>"$work/merged" || { cat "$work/merged" >&2; exit 2; }
    rm -rf "$work/sum"
    mv "$work/next" "$work/sum"
done
(cd "$BUILD/obj" && find . -name '*.gcno') | while read -r graph; do
    mkdir -p "$work/sum/${graph%/*}"
    cp "$BUILD/obj/$graph" "$work/sum/$graph"
    gcov -t -b -c "$work/sum/${graph%.gcno}.gcda" 2>/dev/null
done >"$work/said"

awk -v missed="$BUILD/missed" '
    function of_line() {
        if (ways && text !~ /(^|[^a-z_])assert\(/) {
            branches[room] += ways; taken[room] += ways - not
            if (not && count != "#####") print file ":" line ": " not " of " ways ": " text >missed
        } else asserted += ways
        ways = not = 0
    }
    /^ +-: +0:Source:/ { of_line(); file = $0; sub(/.*:Source:/, "", file); own = file ~ /^src\/.*\.c$/; split(file, part, "/"); room = part[2]; next }
    !own { next }
    /^function / { of_line(); if ($4 == 0) never[$2] = 1; next }
    /^branch / { ways++; if (/never executed/ || $4 == 0) not++; next }
    /^call / { next }
    match($0, /^ *[-#=0-9]+\*?: *[0-9]+:/) {
        of_line()
        split($0, word, ":"); count = word[1]; gsub(/[ *]/, "", count); line = word[2] + 0
        text = substr($0, RLENGTH + 1); sub(/^ */, "", text)
        if (count == "-") next
        lines[room]++
        if (count == "#####" || count == "=====") print file ":" line ": " text >missed
        else hit[room]++
    }
    END {
        of_line()
        printf "%-12s %7s %7s  %8s %7s\n", "folder", "lines", "reached", "branches", "taken"
        for (r in lines) {
            printf "%-12s %7d %6.1f%%  %8d %6.1f%%\n", r, lines[r], 100 * hit[r] / lines[r], branches[r], branches[r] ? 100 * taken[r] / branches[r] : 100 | "sort"
            L += lines[r]; H += hit[r]; B += branches[r]; T += taken[r]
        }
        close("sort")
        printf "%-12s %7d %6.1f%%  %8d %6.1f%%\n", "all", L, 100 * H / L, B, 100 * T / B
        printf "not counted: %d ways out of asserts\n", asserted
        for (f in never) print "never called: " f | "sort"
        close("sort")
        exit H < .97 * L || T < .87 * B
    }' "$work/said"
