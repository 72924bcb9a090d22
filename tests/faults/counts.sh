# counts.sh -- what is counted and listed: evaluations of schemes of one rate, lists that would be empty.
. tests/tools/lib.sh
count() { sed -n "s/^$1 //p" "$work/stats"; }

# At one rate slow and fast parts are evaluated together; rk4 takes four a step, and one to begin with.
for scheme in newmark midpoint generalized-alpha hht rk4; do
    "$FMDSUB" run -q --stats="$work/stats" -s integrate.scheme=$scheme --until 0.5 -o "$work/out" decks/pendulum.yaml 2>"$work/err"
    expect "$scheme: 500 steps" "500 500 0" "$(count major_steps) $(count minor_steps) $(count rejected)" "$work/err"
    [ "$(count fast_evaluations)" -gt 0 ] && expect "$scheme: slow and fast evaluations" "$(count slow_evaluations)" "$(count fast_evaluations)" "$work/stats"
    [ $scheme != rk4 ] || expect "rk4: evaluations" 2001 "$(count fast_evaluations)" "$work/stats"
done
# Two to one: as many minor steps as the ratio says.
"$FMDSUB" run -q --stats="$work/stats" -s integrate.ratio=10 --until 0.5 -o "$work/out" decks/geared-pendulum.yaml 2>"$work/err"
expect "subcycle 10:1: minor steps" "$(($(count major_steps) * 10))" "$(count minor_steps)" "$work/stats"

# A list of no key is no list: older readers of schemas refuse it.
"$FMDSUB" schema >"$work/schema"
tr -d ' \n\t' <"$work/schema" >"$work/one"
grep -q '"required":\["' "$work/one" && ! grep -q '"required":\[\]\|"enum":\[\]' "$work/one" && ok "schema: no empty list" || not_ok "schema: no empty list" "there is one"

# Steps of order 4 keep their matrices from step to step: less than one a step.
"$FMDSUB" run -q --stats="$work/stats" -s 'integrate={scheme: midpoint, order: 4, step: 1.0e-3, until: 0.5}' --every 0.1 -o "$work/out" decks/double-pendulum.yaml 2>"$work/err"
expect "midpoint, order 4: 500 steps, matrices" "500 fewer" "$(count major_steps) $([ "$(count factorizations)" -lt 480 ] && echo fewer)" "$work/stats"
