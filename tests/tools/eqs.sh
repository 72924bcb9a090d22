# eqs.sh -- where each equation stands in the source: (2-1) to (2-26) of Miao, Zhu, Shi & Chen 2007, and (S1) to
# (S15) of the scheme subcycle.
#
# A tag is (2-17), or (2-17*) where the formula departs from print.  STRICT=1 fails when one of them has no place.
grep -noE '\((2-[0-9]+[a-z]*\*?|S[0-9]+)\)' src/*/*.c src/*/*.h 2>/dev/null | awk -F: -v strict="${STRICT:-}" '
    function list(first, last, letter,   k, name) {
        for (k = first; k <= last; k++) {
            name = letter k
            if (name in place) printf "%s", place[name]
            else missing = missing " (" name ")"
            known[name] = 1
        }
    }
    {
        name = $3
        gsub(/[()*]/, "", name)
        sub(/[a-z]+$/, "", name)
        place[name] = place[name] sprintf("%-8s %s:%s\n", $3, $1, $2)
    }
    END {
        list(1, 26, "2-")
        list(1, 15, "S")
        for (name in place) if (!(name in known)) { printf "unknown: %s", place[name]; bad = 1 }
        if (missing != "") print "eqs: without a place:" missing
        else print "eqs: all 26 and 15 have a place"
        exit strict && (missing != "" || bad)
    }'
