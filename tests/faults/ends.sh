# ends.sh -- runs that a condition ends, and joints that leave their range.
. tests/tools/lib.sh
cd "$work" || exit 1
deck=$ROOT/decks/pendulum.yaml
run() { "$FMDSUB" run --every 0.1 --columns pin.angle,pin.angle_rate,ball.y "$@" "$deck"; }

run -q --until 2 --every 1.0e-3 >all.csv 2>err
run -f ndjson -s 'integrate.until={when: "pin.angle > 2 and pin.angle_rate < 3", latest: 9}' >met.json 2>err
ended "a condition: status" 0 $? met.json err
# The first step of the whole run in which it holds, and the same numbers there.
awk -F, 'NR > 2 && $2 > 2 && $3 < 3 { print $1, $2; exit }' all.csv >want
sed -n 's/.*"type":"row","t":\([^,]*\),"pin.angle":\([^,]*\),.*/\1 \2/p' met.json | tail -n 1 >got
same "a condition: the first step in which it holds" want got
grep -q '"type":"event","t":'"$(cut -d ' ' -f 1 want)"',"kind":"until"' met.json && ok "a condition: the event" || not_ok "a condition: the event" "events:" met.json
tail -n 1 met.json | grep -q '"status":"done".*"condition_met":true' && ok "a condition: the summary" || not_ok "a condition: the summary" "summary:" met.json
grep -q "' turned true$" err && ok "a condition: told" || not_ok "a condition: told" "stderr:" err

run -f json -s 'integrate.until={when: "ball.y > 1", latest: 1}' >out 2>err
expect "points are no quantities of a condition" 3 $? err
run -f json -s 'measures={height: {displacement: [ground, ball], axis: [0, 1]}}' -s 'integrate.until={when: "height > 1", latest: 1}' >out 2>err
ended "never met: status" 0 $? out err
grep -q '"t_end":1,"condition_met":false' out && grep -q "has not turned true" err && ok "never met: told" || not_ok "never met: told" "stderr:" err
# What is true at the start has to turn true again: the pendulum comes back up.
run -q -s 'integrate.until={when: "pin.angle < 0.5", latest: 5}' >out 2>err
awk -F, 'END { exit !($1 > 1 && $1 < 3 && $2 < 0.5 && $3 < 0) }' out && ok "true at the start: ends when it turns true again" ||
    not_ok "true at the start: ends when it turns true again" "last record:" out
# A condition on the time alone ends as `until` would, but for the step it needs.
run -q -s 'integrate.until={when: "t >= 0.25", latest: 5}' | tail -n 1 >got
run -q --until 0.25 | tail -n 1 >want
same "a condition on the time" want got
"$FMDSUB" study -q --schemes midpoint --repeats 1 -s 'integrate.until={when: "pin.angle > 1", latest: 1}' "$deck" >out 2>err
ended "study goes on to the latest end" 0 $? out err

# Ranges: every crossing is an event, the first of a joint is a line for people.
run -f ndjson -s 'constraints.pin.range=[-1, 2]' --until 6 >range.json 2>err
ended "a range: status" 0 $? range.json err
expect "a range: lines on stderr" 1 "$(grep -c 'is outside its range' err)" err
run -q --every 1.0e-3 --until 6 | awk -F, 'NR > 1 { out = $2 < -1 || $2 > 2; n += NR > 2 && out != was; was = out } END { print n }' >want
grep -c '"kind":"range"' range.json >got
same "a range: an event at every crossing" want got
expect "a range: it is left and entered" "3 or more" "$([ "$(cat got)" -ge 3 ] && echo 3 or more)"
run -q --until 6 >with.csv -s 'constraints.pin.range=[-1, 2]' 2>err
run -q --until 6 >without.csv 2>/dev/null
same "a range: no force" without.csv with.csv
