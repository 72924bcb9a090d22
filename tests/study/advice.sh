# advice.sh -- the advice of check, followed.
. tests/tools/lib.sh

# The advice of `check`, followed: found errors at most five times what was promised (make advice: on all decks).
MOST=2e5 sh tests/tools/advice.sh decks/pendulum.yaml decks/bar-slider.yaml decks/chain.yaml decks/slider-crank.yaml \
    decks/spin-up-slow.yaml >"$work/advice" 2>&1
rc=$?
expect "advice followed on five decks: $(tail -n 1 "$work/advice")" 0 $rc "$work/advice"

# The same where loads and drives have corners in time, forces jump by the state, or the deck has a tolerance.
MOST=5e5 sh tests/tools/advice.sh tests/advice/*.yaml >"$work/advice" 2>&1
rc=$?
expect "advice followed where forces jump: $(tail -n 1 "$work/advice")" 0 $rc "$work/advice"
advised() { # NAME DECK PATTERN COUNT
    "$FMDSUB" check -q "tests/advice/$2.yaml" >"$work/out" 2>"$work/err"
    expect "$1" "0 1 $4" "$? $(grep -c '^steps: by trial runs' "$work/out") $(grep -c -- "$3" "$work/out")" "$work/out" "$work/err"
}
advised "no step that there was no time to try with a pulse in it" late-pulse 'at step ' 0
advised "that is said" late-pulse 'no fixed step: those that there was time to try' 1
advised "corners in steps that are too many, and where" driven-crank 'no fixed step: .* such as t = 0.05 s; schemes with a tolerance' 1
advised "corners as ends of steps" jumps '1e-04: midpoint at step 0.0001 ' 1
advised "no step beside a tolerance" tolerance 'no fixed step: the deck has a tolerance' 1

# What the trials take, counted, is at most 2 percent of what the run by fixed steps to 1e-6 takes that they advise.
share() { # DECK
    "$FMDSUB" check -q -f json "$1" 2>"$work/err" | awk '{ gsub(/[",]/, "") }
        $1 == "trial_evaluations:" { trial = $2 } $1 == "error:" { e = $2 } $1 == "suggested_step:" { h = $2 }
        $1 == "evaluations:" && e + 0 == 1e-6 && h != "null" { run = $2 }
        END { print (trial > 0 && run > 0 && trial <= .02 * run ? "within" : trial " of " run) }'
}
for deck in andrews bricard chain four-bar geared-pendulum governor heavy-top heavy-top-slow light-hub pendulum slider-crank spin-up stiff-leaf-chain telescope turbine-blade windows; do
    expect "trials of $deck: 2 percent" within "$(share decks/$deck.yaml)" "$work/err"
done
