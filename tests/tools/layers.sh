# layers.sh -- prints every edge between rooms of src/ that points where it may not: includes, and with BUILD
# (default: build) what the objects there call in each other.
#
# Rooms stand in the order of the table, each above all that it uses, so that there is no circle.  A room may include
# and call itself and what its line names; lists are not transitive.  An entry with a slash allows that one header:
# system/ode2.h says what a second-order system is, with no code of its own, so that mechanics and integrators know
# each other through it alone.
table=$(mktemp "${TMPDIR:-/tmp}/layers.XXXXXX")
trap 'rm -f "$table" "$table.nm"' EXIT
cat >"$table" <<'TABLE'
base
la          base
expr        base
out         base
deck        base expr
kind        base la expr
flex        base la
reduce      base la flex out
scene       base la expr deck kind flex
scene_flex  base la deck kind flex scene
scene_read  base la expr deck kind scene scene_flex
model       base la deck kind flex scene                             # deck: warns and refuses at the deck's lines
tree        base la kind flex model system/ode2.h
contact     base la kind model tree
force       base la kind model tree contact system/ode2.h
open        base la kind flex model tree force system/ode2.h
loop        base la kind model tree force open system/ode2.h
system      base la kind flex model tree contact force open loop
engine      base la system/ode2.h
multirate   base la engine system/ode2.h
ledger      base
sim         base la expr deck out kind scene scene_read model open loop system engine multirate ledger
probe       base la out sim engine system/ode2.h
study       base la deck out scene model system engine sim multirate ledger probe # multirate: schemes by name; ledger: its share
sweep       base deck out scene sim study
film        base la deck out kind flex scene model tree system sim
cli         base expr deck out kind scene scene_read multirate sim probe study sweep film # prints the tables of words and schemes
TABLE

rules='
    function load(table,   n, i, word) {
        while ((getline line < table) > 0) {
            sub(/#.*/, "", line)
            n = split(line, word, " ")
            known[word[1]] = ++rooms
            allowed[word[1], word[1]] = 1
            for (i = 2; i <= n; i++) {
                allowed[word[1], word[i]] = 1
                if (word[i] !~ /\// && !(word[i] in known)) {
                    print "table: " word[1] " uses " word[i] ", which stands below it"
                    bad++
                }
            }
        }
    }'

grep -n '^[ \t]*#[ \t]*include[ \t]*"' src/*/*.c src/*/*.h 2>/dev/null | awk -v table="$table" "$rules"'
    BEGIN { load(table) }
    {
        split($0, part, ":")
        split(part[1], path, "/")
        from = path[2]
        match($0, /"[^"]*"/)
        header = substr($0, RSTART + 1, RLENGTH - 2)
        to = header
        files++
        if (!(from in known)) { print part[1] ":" part[2] ": folder " from " is not in the table"; bad++; next }
        if (to !~ /\//) { print part[1] ":" part[2] ": \"" header "\" has no folder"; bad++; next }
        sub(/\/.*/, "", to)
        if (!((from, to) in allowed) && !((from, header) in allowed)) {
            print part[1] ":" part[2] ": " from " may not include " header
            bad++
        }
    }
    END { printf "layers: %d includes, %d out of order\n", files, bad; exit bad > 0 || !files }'
status=$?

# Calls: a name defined in one room and undefined in an object of another.
objects=${BUILD:-build}/obj
if [ ! -d "$objects" ]; then
    echo "layers: no objects in $objects, calls are not looked at"
    exit $status
fi
for source in src/*/*.c; do
    object=${source#src/}
    object=${object%.c}.o
    [ -f "$objects/$object" ] && nm "$objects/$object" | sed "s|^|${object%.o} |"
done >"$table.nm"
awk -v table="$table" "$rules"'
    BEGIN { load(table) }
    { room = $1; sub(/\/.*/, "", room) }
    NR == FNR { if ($(NF - 1) ~ /^[TDRBC]$/) place[$NF] = place[$NF] ? place[$NF] " " $1 : $1; next }
    $(NF - 1) == "U" && ($NF in place) && place[$NF] !~ / / {
        to = place[$NF]
        sub(/\/.*/, "", to)
        calls++
        if (!((room, to) in allowed)) { print "src/" $1 ".c: " room " may not use " $NF " of " place[$NF]; bad++ }
    }
    END { printf "layers: %d uses, %d out of order\n", calls, bad; exit bad > 0 || !calls }' "$table.nm" "$table.nm" || status=1
exit $status
