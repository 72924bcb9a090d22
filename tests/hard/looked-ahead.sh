# looked-ahead.sh -- drives whose pieces have known ends: between these a scheme that chooses its steps goes on across records, as
# where nothing is driven; what jumps at such an end is found all the same.
. tests/tools/lib.sh

deck() { # VALUE SCHEME TOLERANCE EVERY
    cat <<END
fmdsub: 1
gravity: [0, -9.81]
bodies: {trolley: {mass: 20, inertia: 1, at: [0, 0]}, load: {mass: 5, inertia: 0.1, at: [0, -2]}}
constraints: {rail: {prismatic: [ground, trolley], axis: [1, 0]}, hook: {revolute: [trolley, load], at: [0, 0]}}
drives: {travel: {drive: rail, value: "$1"}}
integrate: {scheme: $2, tolerance: $3, until: 8}
output: {every: $4, columns: [load.x, load.y, hook.angle, hook.angle_rate]}
END
}
evaluations() { # every record of the deck in $work/deck.yaml
    "$FMDSUB" run -q --stats "$work/deck.yaml" 2>&1 >"$work/rows" | sed -n 's/^slow_evaluations  *//p'
}
way="0.8*smooth(t, 1, 2.5) - 0.3*smooth(t, 4, 5)"
deck "$way" dop853 1.0e-11 0.1 >"$work/deck.yaml"
evaluations >/dev/null
cp "$work/rows" "$work/want"
for scheme in dopri5 dop853 radau5 radau9; do
    for tolerance in 1.0e-4 1.0e-7; do
        deck "$way" $scheme $tolerance 0.05 >"$work/deck.yaml"
        dense=$(evaluations)
        deck "$way" $scheme $tolerance 0.1 >"$work/deck.yaml"
        sparse=$(evaluations)
        expect "$scheme to $tolerance: records twice as dense are little work" yes \
            "$(awk -v a="$dense" -v b="$sparse" 'BEGIN { print (a > 0 && b > 0 && a <= 1.4 * b ? "yes" : a " for " b) }')"
        expect "$scheme to $tolerance: within 10 tolerances" yes "$(awk -F, -v tolerance=$tolerance '
            FNR == 1 { next }
            FNR == NR { for (i = 2; i < 6; i++) { w[FNR, i] = $i; if ($i > most[i]) most[i] = $i; if ($i < least[i]) least[i] = $i }; next }
            { for (i = 2; i < 6; i++) { d = ($i - w[FNR, i]) / (most[i] - least[i]); if (d < 0) d = -d; if (d > off) off = d } n++ }
            END { print (n == 81 && off <= 10 * tolerance ? "yes" : off " in " n) }' "$work/want" "$work/rows")"
    done
done

# A jump far behind the last record that was looked at, at the end of a piece and inside a rest.
for scheme in dopri5 dop853 radau9; do
    deck "0.8*smooth(t, 1, 2.5) + if(t < 6.0313, 0, 0.1)" $scheme 1.0e-4 0.1 >"$work/deck.yaml"
    "$FMDSUB" run -q "$work/deck.yaml" >"$work/rows" 2>"$work/err"
    expect "$scheme: a drive that jumps behind a rest stops the run, and where" "5 1" \
        "$? $(grep -c "drive 'travel' jumps by 0.1, from 0.8 to 0.9, at t = 6.0313 s" "$work/err")" "$work/err"
    expect "$scheme: its records up to there" 6 "$(tail -n 1 "$work/rows" | cut -d, -f1)" "$work/rows"
done
