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
