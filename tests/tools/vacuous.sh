# vacuous.sh -- tests that pass with an empty program in place of ours, one that prints nothing and ends with 0: they judge nothing.
#
#     sh tests/tools/vacuous.sh [PART...]        default: all parts that run the program
#
# Lines of tests/tools/vacuous.txt, `part: name: why`, are those that may.  Fails if there are others, or if one of those
# does not pass.
. tests/tools/lib.sh
[ $# -gt 0 ] || set -- decks bad faults man order study plot diff sweep animate install airscrew hard validation users random reduce long
fake=$work/fake
mkdir "$fake"
for file in "$BUILD"/*; do ln -s "$file" "$fake/"; done
rm -rf "$fake/fmdsub" "$fake/fmdsub-reduce" "$fake/reduce"
cat >"$fake/fmdsub" <<'END'
#!/bin/sh
[ "$*" != --version ] || echo 'fmdsub 0.1.0'
END
cp "$fake/fmdsub" "$fake/fmdsub-reduce"
chmod +x "$fake/fmdsub" "$fake/fmdsub-reduce"

for part in "$@"; do
    BUILD=$fake timeout 600 sh "tests/tools/part-$part.sh" >"$work/said" 2>&1 </dev/null
    rc=$?
    [ $rc = 0 ] || not_ok "$part" "the part stopped with status $rc"
    awk -v part="$part" '
        BEGIN { while ((getline line < "tests/tools/vacuous.txt") > 0)
                    if (index(line, part ": ") == 1) { name = substr(line, length(part) + 3); sub(/: [^:]*$/, "", name); may[name] = 1 } }
        # A name that may, or `* END`: any name that ends so.
        function allowed(name) {
            if (!(name in may)) sub(/.* /, "* ", name)
            if (name in may) used[name] = 1
            return name in may
        }
        /^ok /     { name = substr($0, 4); if (!allowed(name)) { n++; print "not ok " part ": " name } }
        /^not ok / { judged++ }
        END {
            for (name in may) if (!used[name]) { n++; print "not ok " part ": " name " is in vacuous.txt for nothing" }
            if (!n) print "ok " part ": " judged " tests fail without the program"
        }' "$work/said"
done
