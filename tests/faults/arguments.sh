# arguments.sh -- command lines that ask for nothing sensible: status 2, one line that says why, nothing on stdout.
. tests/tools/lib.sh
deck=$ROOT/decks/pendulum.yaml
cd "$work" || exit 1

"$FMDSUB" >out 2>err
expect "no verb: status, help where errors go" "2 0 1" "$? $(wc -c <out) $(grep -c '^usage: fmdsub VERB' err)" err
refuse 2 "unknown verb 'rnu': did you mean 'run'" rnu "$deck"
refuse 2 "unknown verb 'hlp': did you mean 'help'" hlp
refuse 2 "unknown option '--formt': did you mean '--format'" run --formt csv "$deck"
refuse 2 "option '--quiet' takes no value" run --quiet=3 "$deck"
refuse 2 "needs a value" run "$deck" --set
refuse 2 "takes one of csv|ndjson|json" run --format xml "$deck"
refuse 2 "takes one deck; '-' is standard input" run
refuse 2 "takes one deck$" run "$deck" "$deck"
# Options of other verbs would do nothing.
refuse 2 "'fmdsub check' has no option '--columns': it belongs to run" check --columns '*' "$deck"
refuse 2 "'fmdsub study' has no option '--every': it belongs to run" study --every 0.1 "$deck"
refuse 2 "'fmdsub list' has no option '--output'" list -o x
refuse 2 "'fmdsub run' has no option '--at': it belongs to modes" run --at 1 "$deck"
# Words too many.
refuse 2 "takes nothing more" list joints extra
refuse 2 "takes one deck" list columns "$deck" "$deck"
refuse 2 "takes one name" new pendulum mechanism
refuse 2 "takes no argument" schema "$deck"
# Empty names.
refuse 2 "names no column" run --columns '' "$deck"
refuse 2 "names no column" run --columns ' , ' "$deck"
refuse 2 "names no scheme" study --schemes , "$deck"
refuse 2 "names no number" study --ratios '' "$deck"
refuse 2 "rows by --format csv" check -f ndjson "$deck"
refuse 2 "one object by --format json" check -f json --expanded "$deck"
refuse 2 "needs the name of a file" run -o '' "$deck"
[ ! -e .part ] && [ -s err ] && ok "-o '': nothing is written" || not_ok "-o '': nothing is written" ".part is there"
refuse 2 "needs the name of a file" run --stats= "$deck"
refuse 2 "--final-state needs the name of a file" run --final-state= "$deck"
refuse 2 "--resume needs the name of a file" run --resume= "$deck"
refuse 2 "--report needs the name of a file" study --report= "$deck"
refuse 2 "--progress takes one of auto|always|never, not 'often'" run --progress often "$deck"

# A name of a column is taken letter by letter, whatever YAML would make of it.
for name in "it's" 'pin\angle' 'pin"' '[x' '${x}' '#'; do
    "$FMDSUB" run --columns "$name" "$deck" >out 2>err
    rc=$?
    if [ $rc -eq 2 ] && head -n 1 err | grep -qF -- "no column matches '$name'"; then ok "--columns $(echo "$name" | tr -d "\\\\")"
    else not_ok "--columns $name" "exit $rc, expected 2 and 'no column matches'" err; fi
done

# Expressions stand among the names, commas in their parentheses.
"$FMDSUB" run -q --until 0.5 --columns "speed=hypot(ball.vx, ball.vy), pin.*_rate,it's=speed" "$deck" >out 2>err
grep -q "'it's' cannot name a column" err && ok "--columns with expressions: names are checked" || not_ok "--columns with expressions: names are checked" "the words:" err
"$FMDSUB" run -q --until 0.5 --columns "speed=hypot(ball.vx, ball.vy), pin.*_rate" "$deck" >out 2>err
awk -F , 'NR == 1 && $0 != "t,speed,pin.angle_rate" || NR > 1 && ($2 - ($3 < 0 ? -$3 : $3))^2 > 1e-20 { exit 1 } END { exit NR < 2 }' out &&
    ok "--columns with expressions" || not_ok "--columns with expressions" "the records:" out

"$FMDSUB" run -q --until 0.5 --columns "speed = hypot(ball.vx, ball.vy), pin.*_rate" "$deck" >blanks 2>err
same "--columns with expressions: blanks around '='" out blanks

# Steps that a scheme of own steps rejects are its way of working, no verdict.
"$FMDSUB" run --strict --stats=stats -s "integrate={scheme: dopri5, tolerance: 1.0e-12, until: 30}" -s "output={every: 30}" -s 'forces={f: {torque: pin, value: "if(t < 1, 0, 100)"}}' "$deck" >out 2>err
ended "--strict, own steps" 0 $? out err
awk '$1 == "rejected" && $2 > 0 { found = 1 } $1 == "smallest_step" { found = 0; exit } END { exit !found }' stats &&
    ok "--strict, own steps: some were rejected" || not_ok "--strict, own steps: some were rejected" "the counts:" stats

# A reader of words that has left: SIGPIPE's code, and nothing said.
for words in list schema explain new "list columns $deck" "check --expanded $deck"; do
    { sleep 0.1; "$FMDSUB" $words 2>err; echo $? >rc; } | true
    expect "reader left: ${words%$deck}" "141 0" "$(cat rc) $(wc -l <err)" err
done
# Axes of any length: squares of their components are no numbers.
for length in 1 1.0e+200 1.0e-200; do
    cat >axis.yaml <<EOF
fmdsub: 1
gravity: [0, 0, -9.81]
bodies: {arm: {mass: 1, inertia: [1, 1, 1], at: [0.5, 0, 0]}}
constraints: {p: {revolute: [ground, arm], at: [0, 0, 0], axis: [0, $length, 0]}}
integrate: {scheme: newmark, step: 1.0e-3, until: 0.1}
EOF
    "$FMDSUB" run -q axis.yaml >"axis.$length" 2>err
    same "an axis of length $length" axis.1 "axis.$length"
done

# Help, of all and of one verb.
"$FMDSUB" help >all 2>err
ended "help: status" 0 $? all err
"$FMDSUB" --help >again; same "help and --help" all again
"$FMDSUB" help modes >one 2>err
grep -q '^usage: fmdsub modes' one && grep -q -- --at one && ! grep -q -- --columns one && ok "help modes: its own options" || not_ok "help modes: its own options" "got:" one err
"$FMDSUB" modes --help >again; same "help modes and modes --help" one again
refuse 2 "unknown verb 'rnu': did you mean 'run'" help rnu
"$FMDSUB" -V >one; "$FMDSUB" --version >again; same "-V" one again
for word in no-convergence dead-point locked balance friction contact rolling memory W-bending; do
    "$FMDSUB" explain $word >out 2>err && grep -q "^$word: ...................." out && ok "explain $word" || not_ok "explain $word" "got:" out err
done
refuse 2 "no code 'convergence': did you mean 'no-convergence'" explain convergence
# Whatever stands in brackets behind a stop can be explained.
"$FMDSUB" run -q -s 'forces={f: {torque: pin, value: "sqrt(0.1 - t)"}}' "$deck" >out 2>err
code=$(sed -n 's/.*\[\([a-z-]*\)\]$/\1/p' err)
expect "a stop has a code" not-finite "$code" err
"$FMDSUB" explain "$code" >out 2>err
ended "and that is explained" 0 $? out err
# The last words of a run.
"$FMDSUB" run --until 1 "$deck" 2>err >out
tail -n 2 err | grep -q '^energy balance kept: off by [0-9.e-]* [pnum]*J of [0-9.]* [km]*J ([0-9.e-]*; limit 0.01)$' && ok "the balance in words" || not_ok "the balance in words" "got:" err
