# check.sh -- what `fmdsub check` says of loops and mass, in words and as an object: the same figures.
. tests/tools/lib.sh

fact() { # KEY, the last one of that name in the object
    sed -n 's/^.*"'"$1"'":[[:space:]]*\([^,]*\),*$/\1/p' "$work/object" | tail -n 1
}

"$FMDSUB" check decks/bricard.yaml >"$work/words" 2>"$work/err"
ended "check: words" 0 $? "$work/words" "$work/err"
"$FMDSUB" check -f json decks/bricard.yaml >"$work/object" 2>"$work/err"
ended "check: object" 0 $? "$work/object" "$work/err"
expect "check: equations and rank of Bricard's loop" "5 4" \
    "$(sed -n 's/^loops: .* \([0-9]*\) equations, rank \([0-9]*\)$/\1 \2/p' "$work/words")" "$work/words"
expect "check: the same in the object" "5 4" "$(sed -n '/"components"/,$p' "$work/object" |
    sed -n 's/^.*"equations":[[:space:]]*\([0-9]*\),$/\1/p') $(fact rank)" "$work/object"
expect "check: joints whose reactions are not unique" "pin1 pin2 pin3 pin5 pin6" \
    "$(sed -n 's/^ *\(pin[0-9]\) .*of the tree; reactions not unique$/\1/p' "$work/words" | sort | tr '\n' ' ' | sed 's/ $//')"
expect "check: mass" "5 kg, centre at (0.6, -0.6, 0.5) m" "$(sed -n 's/^mass: //p' "$work/words")"
expect "check: centre in the object" "[0.6, -0.6, 0.5]" "$(sed -n 's/^.*"centre":[[:space:]]*\(\[.*\]\),$/\1/p' "$work/object" | sed 's/0000000000*1//g')"

"$FMDSUB" check --no-trial -f csv -s 'title=a "b", c' decks/bricard.yaml >"$work/rows" 2>"$work/err"
ended "check: rows" 0 $? "$work/rows" "$work/err"
while read -r row; do
    grep -qxF "$row" "$work/rows" && ok "check: row $row" || not_ok "check: row $row" "rows:" "$work/rows"
done <<'EOF'
topic,name,fact,value,unit
deck,,title,"a ""b"", c",
bodies,bar1,on,ground,
deck,,centre.3,0.5,m
coordinates,pin1.angle,unit,rad,
loops,,rank,4,
EOF

# A wish alone is the same as in a map.
sed 's/^initial:.*/initial: static/' decks/cantilever.yaml >"$work/alone.yaml"
for deck in decks/cantilever.yaml "$work/alone.yaml"; do
    "$FMDSUB" run -q --until 0.01 "$deck" >"$work/$(basename "$deck" .yaml).csv" 2>"$work/err"
done
same "initial: static, alone and in a map" "$work/cantilever.csv" "$work/alone.csv"

# A scheme that chooses its own steps has none to suggest by frequencies.
"$FMDSUB" check --no-trial -s 'integrate={scheme: dopri5, tolerance: 1.0e-8, until: 1}' decks/spring-pendulum.yaml >"$work/words" 2>"$work/err"
grep -q '^  scheme dopri5 chooses its own steps$' "$work/words" && ! grep -q 'the deck has\|major steps' "$work/words" &&
    ok "check: own steps" || not_ok "check: own steps" "words:" "$work/words" "$work/err"
# Independent coordinates, many of them, in lines of a terminal's width.
{ cat <<'EOF'
fmdsub: 1
bodies: {link$(i): {repeat: {i: [1, 60]}, mass: 1, inertia: 1/12, at: [cos(pi*(i - 0.5)/60), sin(pi*(i - 0.5)/60)]}}
constraints:
  pin: {revolute: [ground, link1], at: [1, 0]}
  pin$(i): {repeat: {i: [2, 60]}, revolute: [link$(i-1), link$(i)], at: [cos(pi*(i - 1)/60), sin(pi*(i - 1)/60)]}
  last: {revolute: [ground, link60], at: [-1, 0]}
initial: {pin.angle_rate: 0}
integrate: {scheme: midpoint, step: 1.0e-3, until: 1}
EOF
} >"$work/many.yaml"
"$FMDSUB" check "$work/many.yaml" >"$work/words" 2>"$work/err"
expect "check: lines of independents" "yes" "$(sed -n '/independent:/,/largest gap/p' "$work/words" | awk 'length > 100 { bad = 1 } END { print (bad ? "no" : NR > 3 ? "yes" : "few") }')" "$work/words" "$work/err"

# Advice by trial runs: the same twice, three errors, steps that divide the time between records and are no longer than a
# hundredth of the run; by frequencies without them; round-off is no frequency.
for again in 1 2; do "$FMDSUB" check -f json decks/pendulum.yaml >"$work/advice$again" 2>"$work/err"; done
same "check: advice twice" "$work/advice1" "$work/advice2"
tr -d '",' <"$work/advice1" | awk '
    $1 == "error:" { e = $2 }
    $1 == "suggested_step:" && e != "" && $2 != "null" { n++; k = .5 / $2; if ($2 > .1 || (k - int(k + .5)) ^ 2 > 1e-12) bad = 1; if (last != "" && !($2 < last)) bad = 1; last = $2 }
    $1 == "tolerance:" && $2 != "null" { t++ }
    $1 == "suggested_step:" && e == "" { first = $2 }
    $1 == "trial_evaluations:" && !($2 > 100 && $2 < 4000) { bad = 1 }
    END { exit bad || n != 3 || t != 3 || !(first > 0) }'
expect "check: advice for three errors" 0 $? "$work/advice1"
"$FMDSUB" check decks/pendulum.yaml >"$work/words" 2>"$work/err"
expect "check: advice in words" "3 1" "$(grep -c '^  1e-0[246]: .* at step .* at tolerance ' "$work/words") $(grep -c '^no natural frequencies at the start (' "$work/words")" "$work/words"
"$FMDSUB" check --no-trial -f json decks/chain.yaml >"$work/object" 2>"$work/err"
expect "check: no trial" "0 1" "$(grep -c '"advice"' "$work/object") $(grep -c '"suggested_step"' "$work/object")" "$work/object"

# An implicit scheme is not tried for longer than the explicit one is foretold to take: of the dearest advice no more than 2 percent.
"$FMDSUB" check -f json decks/bearing.yaml >"$work/json" 2>"$work/err"
expect "check: trials of a bearing" fine "$(awk '{ gsub(/[",]/, "") } $1 == "evaluations:" && $2 > most { most = $2 } $1 == "trial_evaluations:" { tried = $2 }
    END { print(tried > 100 && tried <= .02 * most ? "fine" : tried " of " most) }' "$work/json")" "$work/err"

# Where drives alone move all, one run of a hundred steps is the trial of them, too; it fits into runs of as many steps.
for deck in decks/driven-slider-crank.yaml tests/hard/two-drives.yaml; do
    "$FMDSUB" check -f json "$deck" >"$work/json" 2>"$work/err"
    expect "check: one trial of $(basename "$deck" .yaml)" "100 3" "$(awk '{ gsub(/[",]/, "") } $1 == "trial_evaluations:" { tried = $2 }
        $1 == "suggested_step:" && error != "" && $2 > 0 { n++ } $1 == "error:" { error = $2 } END { print tried, n + 0 }' "$work/json")" "$work/json" "$work/err"
done

# Warnings are counted once, though trial runs meet them again.
"$FMDSUB" check --strict decks/double-pendulum.yaml >"$work/words" 2>"$work/err"
ended "check: trial runs add no warnings" 0 $? "$work/words" "$work/err"

# Where the run itself stops, that is why nothing is advised, in both words; explain says it, too.
"$FMDSUB" check tests/hard/locked-drive.yaml >"$work/words" 2>"$work/err"
ended "check: a drive that locks" 0 $? "$work/words" "$work/err"
expect "check: a drive that locks, why no advice" "2 0" "$(grep -c -e '^steps: no advice, for trial runs of it stop:$' \
    -e "^  stopped at t = 0.4429.* s: constraint 'wrist' cannot be kept.*\[dead-point\]$" "$work/words") $(grep -c study "$work/words")" "$work/words"
"$FMDSUB" check -f json tests/hard/locked-drive.yaml >"$work/object" 2>"$work/err"
expect "check: a drive that locks, as an object" 2 "$(grep -c -e '"no_advice":.*stop"' -e '"trial_stop":.*dead-point' "$work/object")" "$work/object"
"$FMDSUB" explain tests/hard/locked-drive.yaml >"$work/words" 2>"$work/err"
expect "explain: a drive that locks" "1 0" "$(grep -c '^it does not run to its end: stopped at t = 0.4429.*\[dead-point\]$' "$work/words") $(grep -c 'then the run stops' "$work/words")" "$work/words"

# Rigid contacts: advice, and a study, have the midpoint rule by two tolerances for its reference.  Steps for 1e-6 would show round-off.
deck=decks/bounce-and-roll.yaml
"$FMDSUB" check "$deck" >"$work/words" 2>"$work/err"
ended "check: rigid contacts" 0 $? "$work/words" "$work/err"
expect "check: rigid contacts, advice on steps and tolerances" "2 3" \
    "$(grep -c '^  1e-0[246]: midpoint at step' "$work/words") $(grep -c 'midpoint at tolerance' "$work/words")" "$work/words"
step=$(sed -n 's/^  1e-04: midpoint at step \([^ ]*\) .*/\1/p' "$work/words")
"$FMDSUB" study --repeats 1 --schemes midpoint --steps "$step" "$deck" >"$work/rows" 2>"$work/err"
expect "check: rigid contacts, what it promises is so" 1 "$(awk -F, '$3 == '"$step"' && $5 > 0 && $5 < 1e-4 { n++ } END { print n + 0 }' "$work/rows")" "$work/rows"
cat >"$work/stops.yaml" <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies: {a: {mass: 1, inertia: 0.1, at: [1, 0]}, b: {mass: 1, inertia: 0.1, at: [2, 0]}}
constraints:
  p: {revolute: [ground, a], at: [0, 0], range: {lower: -1.8, upper: 1, hold: {restitution: 0.9}}}
  q: {revolute: [a, b], at: [1, 0], range: {lower: -1, upper: 1, hold: {restitution: 0.9}}}
integrate: {scheme: midpoint, step: 1.0e-3, until: 60}
output: {every: 0.1}
END
expect "check: a double pendulum between stops, why no advice" 1 \
    "$("$FMDSUB" check "$work/stops.yaml" 2>&1 | grep -c '^steps: no advice, for trial runs of it part before the end, and impacts behind that are not known;')"
"$FMDSUB" study "$deck" >"$work/rows" 2>"$work/err"
ended "study: rigid contacts" 0 $? "$work/err"
expect "study: rigid contacts, its reference" 1 "$(grep -c 'reference: midpoint to 1e-08; midpoint to 1e-07 differs' "$work/err")" "$work/err"
expect "study: rigid contacts, errors fall with the tolerance" 1 \
    "$(awk -F, '$2 == .01 { a = $5 } $2 == .0001 { b = $5 } END { print (b < a / 30 && b > 0 && a < .02) }' "$work/rows")" "$work/rows"

# What is driven into a plane stops the run, with what to do about it.
cat >"$work/driven.yaml" <<'EOD'
fmdsub: 1
bodies: {b: {mass: 1, at: [0, 1]}}
constraints: {f: {prismatic: [ground, b], axis: [0, 1]}}
surfaces: {floor: {plane: ground, at: [0, 0], normal: [0, 1]}, toe: {point: b}}
contacts: {c: {between: [toe, floor]}}
drives: {down: {drive: f, value: -2*t}}
integrate: {step: 1.0e-3, until: 1}
EOD
"$FMDSUB" run -q "$work/driven.yaml" >"$work/rows" 2>"$work/err"
ended "run: driven into a plane" 5 $? "$work/err"
expect "run: contact forces that do not converge" 1 "$(grep -c 'did not converge, .c. is one of them.*fewer points.*a spring between give way \[E-jam\]' "$work/err")" "$work/err"
