# part-random.sh -- mechanisms drawn at random (tests/random): N of them from seed SEED on, two at a time.
#
# A seed of tests/random/known fails for the defect that stands behind it; one that does not fail any more has to lose its line.
. tests/tools/lib.sh
need_program random
N=${N:-30} SEED=${SEED:-1}

half=$((SEED + N / 2))
for part in "1 $SEED $((half - 1))" "2 $half $((SEED + N - 1))"; do
    set -- $part
    mkdir "$work/$1"
    "$BUILD/random/judge" "$FMDSUB" "$work/$1" "$BUILD/random/mechanism" "$2" "$3" >"$work/said$1" 2>&1 &
done
wait
cat "$work/said1" "$work/said2" >"$work/said"
awk -v known=tests/random/known -v first="$SEED" -v n="$N" '
    BEGIN { while ((getline line < known) > 0) if (line ~ /^[0-9]/) { split(line, w, " "); why[w[1]] = substr(line, length(w[1]) + 2) } }
    /^(not )?ok random / {
        seed = $(NF > 0 && $1 == "not" ? 4 : 3) + 0
        seen++
        failed = $1 == "not"
        if (seed in why && failed) { print "known random " seed ": " why[seed]; next }
        if (seed in why) { print "not ok random " seed; print "    passes now: take it out of " known; next }
        if (/ stops: /) stops++
        if (/ unresolved/) unresolved++
        if (/ rejects /) rejects++
        if (/^ok /) fine++
    }
    !(failed && seed in why)
    END {
        print (seen == n ? "ok" : "not ok") " random: " seen " mechanisms, seeds " first " to " first + n - 1
        print (fine && stops <= n / 10 ? "ok" : "not ok") " random: " stops + 0 " of them cannot start or stop"
        print (fine && unresolved <= n / 4 ? "ok" : "not ok") " random: " unresolved + 0 " of them want smaller steps than a test takes"
        print (fine && rejects <= n / 10 ? "ok" : "not ok") " random: " rejects + 0 " of them reject steps where other schemes do not, or in all"
    }' "$work/said"
