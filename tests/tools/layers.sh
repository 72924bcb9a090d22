# layers.sh -- prints every include of src/ that points where it may not.
#
# A folder includes itself and what the table names; lists are not transitive.  An entry with a slash
# allows that one header.
cat >"${TMPDIR:-/tmp}/layers.$$" <<'TABLE'
base
la      base
expr    base
out     base
deck    base expr
kind    base la expr
flex    base la
scene   base la expr deck kind flex
model   base la kind flex scene
reduce  base la flex out
system  base la expr kind flex model
engine  base la system/ode2.h
ledger  base
sim     base la deck out kind scene model system engine ledger
probe   base la out sim engine
study   base out sim probe
cli     base out deck kind sim probe study
TABLE
grep -n '^[ \t]*#[ \t]*include[ \t]*"' src/*/*.c src/*/*.h 2>/dev/null | awk -v table="${TMPDIR:-/tmp}/layers.$$" '
    BEGIN {
        while ((getline line < table) > 0) {
            n = split(line, word, " ")
            known[word[1]] = 1
            allowed[word[1], word[1]] = 1
            for (i = 2; i <= n; i++) allowed[word[1], word[i]] = 1
        }
    }
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
    END { printf "layers: %d includes, %d out of order\n", files, bad; exit bad > 0 }'
status=$?
rm -f "${TMPDIR:-/tmp}/layers.$$"
exit $status
