# advice.sh -- the advice of check, followed.
. tests/tools/lib.sh

# The advice of `check`, followed: found errors at most five times what was promised (make advice: on all decks).
MOST=2e5 sh tests/tools/advice.sh decks/pendulum.yaml decks/bar-slider.yaml decks/chain.yaml decks/slider-crank.yaml \
    decks/spin-up-slow.yaml >"$work/advice" 2>&1
rc=$?
expect "advice followed on five decks: $(tail -n 1 "$work/advice")" 0 $rc "$work/advice"

# What is advised where loads and drives have corners in time, forces jump by the state, or the deck has a tolerance;
# followed in tests/long/advice.sh.
advised() { # NAME DECK PATTERN COUNT
    "$FMDSUB" check -q "tests/advice/$2.yaml" >"$work/out" 2>"$work/err"
    expect "$1" "0 1 $4" "$? $(grep -c '^steps: by trial runs' "$work/out") $(grep -c -- "$3" "$work/out")" "$work/out" "$work/err"
}
advised "no step that there was no time to try with a pulse in it" late-pulse 'at step ' 0
advised "that is said" late-pulse 'no fixed step: steps that end where loads or drives bend' 1
advised "corners in steps that are too many, and where" driven-crank 'no fixed step: .* such as t = 0.05 s; schemes with a tolerance' 1
advised "corners as ends of steps" jumps-on-steps '1e-04: midpoint at step 0.0005 ' 1
advised "ends of steps that are too many" jumps 'no fixed step: .* such as t = 0.7 s' 1
advised "no step beside one that is chosen" shaken 'no fixed step: steps are chosen by a tolerance' 1
advised "no step beside a tolerance" tolerance 'no fixed step: the deck has a tolerance' 1

advised "no step where a buffer is met behind what was tried" late-buffer 'no fixed step: forces may come on, ' 1
advised "nor a promise for the whole" late-buffer '^  promised up to t = 0.25 s only: forces may come on' 1
advised "growth that goes on is no promise for the whole" part/upright '^  promised up to t = 1 s only: what steps miss grows' 1
advised "nor is what trial runs differ in" part/unbalance '^  promised without feet.displacement and 1 more, in which trial runs differ' 1
"$FMDSUB" check -q -f json tests/advice/late-buffer.yaml >"$work/json" 2>"$work/err"
expect "no step in the object, and how far is promised" "0 1 1" \
    "$(grep -c '"suggested_step":[[:space:]]*[0-9]' "$work/json") $(grep -c '"promised_until":[[:space:]]*0\.25' "$work/json") $(
        grep -c '"promised_only":[[:space:]]*"forces' "$work/json")" "$work/json"

# What is advised ends with 0: the balance of energy, here to a thousandth, holds with it.
"$FMDSUB" check -q -f json tests/advice/part/shaken-up.yaml 2>"$work/err" |
    awk '{ gsub(/[",]/, "") } $1 == "scheme:" { s = $2 } $1 == "tolerance:" { print s, sprintf("%.1e", $2) }' >"$work/settings"
while read -r scheme tolerance; do
    "$FMDSUB" run -q --set "integrate={scheme: $scheme, tolerance: $tolerance, until: 20}" tests/advice/part/shaken-up.yaml >/dev/null 2>"$work/err"
    echo $?
done <"$work/settings" >"$work/codes"
expect "what is advised keeps the balance" "0 0 0" "$(echo $(cat "$work/codes"))" "$work/settings" "$work/err"
"$FMDSUB" run -q --set 'integrate={scheme: dop853, tolerance: 1.0e-3, until: 20}' tests/advice/part/shaken-up.yaml >/dev/null 2>"$work/err"
expect "which a looser one does not" 1 $? "$work/err"

# Of steps that take a thousand times what another way does the number is told, and none is advised.
"$FMDSUB" check -q tests/advice/part/dear.yaml >"$work/words" 2>"$work/err"
"$FMDSUB" check -q -f json tests/advice/part/dear.yaml >"$work/json" 2>"$work/err"
expect "steps that nobody takes" "1 0" "$(grep -c '^  1e-06: dop853 at .* evaluations); none by midpoint, which would take [0-9.e+]* evaluations$' "$work/words") $(
    awk '{ gsub(/[",]/, "") } $1 == "error:" { e = $2 } $1 == "suggested_step:" && $2 != "null" && e == 1e-6' "$work/json" | grep -c .)" "$work/words"

# Steps of 1.2e-7 s, in which forces of rigid contacts are off by 7.6e-4 by the round-off of positions, are not advised for 1e-6.
"$FMDSUB" check -q decks/bounce-and-roll.yaml >"$work/words" 2>"$work/err"
"$FMDSUB" check -q -f json decks/bounce-and-roll.yaml >"$work/json" 2>"$work/err"
expect "steps that show round-off" "1 0.01 0.0001" "$(grep -c '^  1e-06: midpoint at tolerance .*; none by midpoint, which would take' "$work/words") $(
    awk '{ gsub(/[",]/, "") } $1 == "error:" { e = $2 } $1 == "suggested_step:" && $2 != "null" { print e }' "$work/json" | xargs)" "$work/words"

# What the trials take, counted, is at most an evaluation to a step of the deck's own run, of two rates to a step of each
# coordinate; of a run by a tolerance a fifth; or 100. A factorization may end later: those are a third more than an
# evaluation here, or stand by name. With rigid contacts nothing is known from a part: about twice the run.
above='satellite-instrument 4.9 whip 2.2'
share() { # DECK [SET]
    "$FMDSUB" check -q --no-trial ${2:+--set "$2"} "$1" 2>"$work/err" | awk '/^freedoms:/ { gsub(",", ""); print "fast", ($2 > 0 ? $NF / $2 : 0) }' >"$work/counts"
    "$FMDSUB" run -q --stats ${2:+--set "$2"} "$1" 2>&1 >/dev/null | grep -E '^(major_steps|minor_steps|slow_evaluations) ' >>"$work/counts"
    "$FMDSUB" check -q -f json ${2:+--set "$2"} "$1" 2>"$work/err" | tr -d '",' | awk -v name="$(basename "$1" .yaml)" -v above="$above" \
        -v contacts="$(grep -c '^contacts:' "$1")" '
        FNR == NR { count[$1] = $2; next }
        $1 == "trial_evaluations:" { trial = $2 } $1 == "no_step:" && /tolerance which rules|by a tolerance/ { free = 1 }
        END { n = split(above, word, " "); limit = 1.34
              for (i = 1; i < n; i += 2) if (word[i] == name) limit = word[i + 1]
              may = free ? .2 * count["slow_evaluations"] : count["major_steps"] * (1 - count["fast"]) + count["minor_steps"] * count["fast"]
              if (contacts) may *= 10
              if (may < 100) may = 100
              print (trial > 0 && trial <= limit * may ? "within" : trial " of " may) }' "$work/counts" -
}
for deck in decks/*.yaml decks/airscrew/*.yaml tests/advice/shaken.yaml; do
    expect "trials of $(basename "$deck" .yaml): within their share" within "$(share "$deck")" "$work/err"
done
expect "trials of shaken by steps: within their share" within \
    "$(share tests/advice/shaken.yaml 'integrate={scheme: midpoint, step: 1.0e-3, until: 5}')" "$work/err"
