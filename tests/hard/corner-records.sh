# corner-records.sh -- records between the ends of steps, with corners of loads on the instants of records, or round-off beside
# them: as where every record ends a step, to 10 tolerances of what a column spans.
. tests/tools/lib.sh

deck() { # LOAD SCHEME TOLERANCE COLUMNS
    cat <<END
fmdsub: 1
bodies: {b: {mass: 1, at: [0, 0]}}
constraints: {h: {prismatic: [ground, b], axis: [0, 1]}}
forces: {k: {spring: h, stiffness: 3000, damping: 2}, f: {force: h, value: "$1"}}
integrate: {scheme: $2, tolerance: $3, until: 1.1}
output: {every: 0.01, columns: [h.displacement, h.displacement_rate$4]}
END
}
n=0
while read -r load; do
    n=$((n + 1))
    deck "$load" dop853 1.0e-11 ", energy.external" >"$work/deck.yaml"
    "$FMDSUB" run -q "$work/deck.yaml" >"$work/want.$n" 2>"$work/err"
    ended "$load, a step to each record: status" 0 $? "$work/want.$n" "$work/err"
    for scheme in dop853 radau5 radau9 dopri5; do
        for tolerance in 1.0e-4 1.0e-6; do
            deck "$load" $scheme $tolerance "" >"$work/deck.yaml"
            "$FMDSUB" run -q "$work/deck.yaml" >"$work/out" 2>"$work/err"
            ended "$load, $scheme to $tolerance: status" 0 $? "$work/out" "$work/err"
            if awk -F, -v tolerance=$tolerance '
                FNR == 1 { next }
                FNR == NR { for (i = 1; i < 4; i++) { w[FNR, i] = $i; if ($i > most[i]) most[i] = $i; if ($i < least[i]) least[i] = $i }; next }
                { n++; if (w[FNR, 1] != $1) n = -1000
                  for (i = 2; i < 4; i++) {
                      d = ($i - w[FNR, i]) / (most[i] - least[i]) / tolerance; d = d < 0 ? -d : d
                      if (d > worst) { worst = d; when = $1 } } }
                END { print worst " tolerances at t = " when ", " n " records"; exit !(n == 111 && worst < 10) }' \
                "$work/want.$n" "$work/out" >"$work/off"; then ok "$load, $scheme to $tolerance"
            else not_ok "$load, $scheme to $tolerance" "$(cat "$work/off")" "$work/err"; fi
        done
    done
done <<'END'
100*smooth(t, 0.12, 0.42)
100*smooth(t, 0.05, 0.41)
100*ramp(t, 0.12, 0.42)
100*ramp(t, 0.07, 0.69)
100*pulse(t, 0.1, 0.5)
100*pulse(t, 0.23, 0.58)
if(t > 0.12 and t < 0.42, 50, 0)
if(3*t < 0.3, 0, 50*sin(t/0.35))
50*mod(t, 0.3)
20*step(t, 0.3 - 1.0e-15)
20*step(t, 0.3 + 1.0e-15)
100*sin(9*(t - 0.12))*smooth(t, 0.12, 0.42)
END
