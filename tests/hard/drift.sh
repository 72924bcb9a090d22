# drift.sh -- the energy of a pendulum does not drift with what Newton's method leaves over: a million steps of 0.01 s at
# the default tolerance stay within the bound of the first thousand.  LONG=1: ten millions, and the midpoint rule too.
. tests/tools/lib.sh
deck=$ROOT/decks/pendulum.yaml
most() { awk -F, 'NR > 1 { x = $2 < 0 ? -$2 : $2; if (x > m) m = x } END { print m }'; }
for how in newmark:10000 ${LONG:+newmark:100000 midpoint:100000}; do
    set -- -q -s integrate.step=0.01 -s integrate.scheme=${how%:*} --columns energy.residual
    bound=$("$FMDSUB" run "$@" --until 10 --every-steps 1 "$deck" | most)
    all=$("$FMDSUB" run "$@" --until ${how#*:} --every-steps 997 "$deck" 2>"$work/err" | most)
    awk "BEGIN { exit !($all <= 1.05 * $bound && $all > 0.5 * $bound) }" && ok "drift of a pendulum: $how s" ||
        not_ok "drift of a pendulum: $how s" "energy off by $all J, $bound J in the first 1000 steps" "$work/err"
done

# A free body that tumbles, a million steps: midpoint keeps its angular momentum and its energy to round-off.
cat >"$work/free.yaml" <<'EOF'
fmdsub: 1
bodies: {b: {mass: 1, inertia: [1, 2, 3], at: [0, 0, 0]}}
constraints: {f: {free: [ground, b]}}
initial: {f.omega: [1, 2, 1.5], f.x_rate: 0.3}
integrate: {scheme: midpoint, step: 1.0e-3, until: 1000}
output: {every: 1, columns: [momentum.*, energy.kinetic]}
EOF
name="drift of a free body: momenta and energy over a million steps"
"$FMDSUB" run -q "$work/free.yaml" 2>"$work/err" | awk -F, '
    NR == 1 { next }
    NR == 2 { for (i = 2; i <= NF; i++) x0[i] = $i; L = sqrt($5 * $5 + $6 * $6 + $7 * $7) }
    { for (i = 2; i <= NF; i++) {
          d = $i - x0[i]
          d = (d < 0 ? -d : d) / (i < 5 ? x0[2] : i < 8 ? L : x0[8])
          if (d > m) m = d } }
    END { print m, NR; exit !(NR == 1002 && m < 1e-11) }' >"$work/line" && ok "$name" ||
    not_ok "$name" "off by (of their sizes), records: $(cat "$work/line")" "$work/err"
