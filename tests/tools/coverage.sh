# coverage.sh -- lines and branches of src that the tests reach, by folder; then the functions that none does.
#
#     sh tests/tools/coverage.sh FOLDER          the build folder of a build with --coverage whose tests have run
#
# Branches are those that gcov counts, without those that only leave a function by an exception.
. tests/tools/lib.sh
built=$1
command -v gcov >/dev/null || { echo "coverage: gcov is not installed" >&2; exit 2; }
find "$built/obj" -name '*.gcda' >"$work/data"
[ -s "$work/data" ] || { echo "coverage: nothing has run in $built" >&2; exit 2; }
while read -r data; do gcov -n -b -c -f "$data" 2>/dev/null; done <"$work/data" >"$work/said"
awk '
    /^Function / { fn = $2; gsub(/\047/, "", fn) }
    /^File / { fn = ""; file = $2; gsub(/\047/, "", file); n = split(file, part, "/"); room = part[2]; own = file ~ /^src\/.*\.c$/ && !seen[file]++ }
    /^Lines executed:/ && fn != "" { if ($2 == "executed:0.00%" ) never[fn] = 1 }
    /^Lines executed:/ && fn == "" && own { split($2, p, "[:%]"); lines[room] += $4; hit[room] += p[2] / 100 * $4 }
    /^Taken at least once:/ && fn == "" && own { split($4, p, "[:%]"); branches[room] += $6; taken[room] += p[2] / 100 * $6 }
    END {
        printf "%-12s %7s %7s  %8s %7s\n", "folder", "lines", "reached", "branches", "taken"
        for (r in lines) {
            printf "%-12s %7d %6.1f%%  %8d %6.1f%%\n", r, lines[r], 100 * hit[r] / lines[r], branches[r], branches[r] ? 100 * taken[r] / branches[r] : 100 | "sort"
            L += lines[r]; H += hit[r]; B += branches[r]; T += taken[r]
        }
        close("sort")
        printf "%-12s %7d %6.1f%%  %8d %6.1f%%\n", "all", L, 100 * H / L, B, 100 * T / B
        for (f in never) print "never called: " f | "sort"
    }' "$work/said"
