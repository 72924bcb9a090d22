# steep-records.sh -- records between the ends of steps where friction is steep: a block on a belt by a smooth law, as where every
# record ends a step, velocities to 5 tolerances of what they span and the force to 100.
. tests/tools/lib.sh

deck() { # SCHEME TOLERANCE COLUMNS
    cat <<END
fmdsub: 1
bodies: {b: {mass: 1, at: [0, 0]}, c: {mass: 0.5, at: [1, 0]}}
constraints: {g: {prismatic: [ground, b], axis: [1, 0]}, h: {prismatic: [b, c], axis: [1, 0]}}
signals: {v: 0.6 - g.displacement_rate}
forces:
  s: {spring: g, stiffness: 60}
  s2: {spring: h, stiffness: 200, damping: 0.1}
  f: {force: g, value: "9*tanh(v/0.02)*(0.4 + 0.6*exp(-abs(v)/0.3))"}
integrate: {scheme: $1, tolerance: $2, until: 5}
output: {every: 0.001, columns: [g.displacement_rate, h.displacement_rate, f.force$3]}
END
}
deck dop853 1.0e-12 ", energy.external" >"$work/deck.yaml"
"$FMDSUB" run -q "$work/deck.yaml" >"$work/want" 2>"$work/err"
ended "a step to each record: status" 0 $? "$work/want" "$work/err"
for scheme in dop853 radau5 radau9; do
    for tolerance in 1.0e-4 1.0e-6 1.0e-8 1.0e-9 1.0e-10; do
        case $scheme:$tolerance in radau5:1.0e-9 | radau5:1.0e-10) continue ;; esac
        deck $scheme $tolerance "" >"$work/deck.yaml"
        "$FMDSUB" run -q "$work/deck.yaml" >"$work/out" 2>"$work/err"
        ended "$scheme to $tolerance: status" 0 $? "$work/out" "$work/err"
        if awk -F, -v tolerance=$tolerance '
            FNR == 1 { next }
            FNR == NR { for (i = 1; i < 5; i++) { w[FNR, i] = $i; if ($i > most[i]) most[i] = $i; if ($i < least[i]) least[i] = $i }; next }
            { n++; if (w[FNR, 1] != $1) n = -10000
              for (i = 2; i < 5; i++) {
                  d = ($i - w[FNR, i]) / (most[i] - least[i]) / tolerance; d = d < 0 ? -d : d
                  if (d > worst[i]) worst[i] = d } }
            END { print worst[2], worst[3], worst[4] " tolerances in " n " records"
                  exit !(n == 5001 && worst[2] < 5 && worst[3] < 5 && worst[4] < 100) }' \
            "$work/want" "$work/out" >"$work/off"; then ok "$scheme to $tolerance"
        else not_ok "$scheme to $tolerance" "$(cat "$work/off")" "$work/err"; fi
        [ -z "${SHOW:-}" ] || cat "$work/off"
    done
done
