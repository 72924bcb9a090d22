# eqs.sh -- where each equation of Miao, Zhu, Shi & Chen 2007, (2-1) to (2-26), stands in the source.
#
# A tag is (2-17), or (2-17*) where the formula departs from print.  STRICT=1 fails when one of the 26
# has no place.
grep -no '(2-[0-9]*[a-z]*\*\{0,1\})' src/*/*.c src/*/*.h 2>/dev/null | awk -F: -v strict="${STRICT:-}" '
    {
        number = $3
        gsub(/[^0-9]/, " ", number)
        split(number, part, " ")
        k = part[2] + 0
        place[k] = place[k] sprintf("%-8s %s:%s\n", $3, $1, $2)
    }
    END {
        for (k = 1; k <= 26; k++) {
            if (k in place) printf "%s", place[k]
            else missing = missing " (2-" k ")"
        }
        for (k in place) if (k + 0 < 1 || k + 0 > 26) { printf "unknown: %s", place[k]; bad = 1 }
        if (missing != "") print "eqs: without a place:" missing
        else print "eqs: all 26 have a place"
        exit strict && (missing != "" || bad)
    }'
