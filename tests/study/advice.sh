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

# What the trials take, counted, is at most 2 percent of what the run to 1e-6 by fixed steps is predicted to take (by a tolerance
# where none are advised), or 100 evaluations; what is above stands here by name, and by how many times.
above='airscrew-driven 2.08 airscrew-steady 8.57 axle 6.78 bar-slider 1.76 double-four-bar 1.72 driven-slider-crank 12.9
    effect-friction 8.34 effect-stiffening 4.43 flexible-robot 1.13 free-fall 9.68 gear-train 3.12 heavy-top-slow 1.28
    parallelogram 2.89 roll-up 1.1 rotating-blade 3.81 rotor 1.56 satellite-instrument 2.94 screw-actuator 1.29
    soft-pendulum 2.84 spin-up 1.19 spin-up-segments 2.23 spin-up-simo 1.95 spin-up-slow 1.91 spring-pendulum 1.9
    suspension 2.4 whip 1.2'
share() { # DECK
    "$FMDSUB" check -q -f json "$1" 2>"$work/err" | awk -v name="$(basename "$1" .yaml)" -v above="$(echo $above)" '{ gsub(/[",]/, "") }
        $1 == "trial_evaluations:" { trial = $2 } $1 == "error:" { e = $2 } $1 == "suggested_step:" { h = $2 }
        $1 == "evaluations:" && e + 0 == 1e-6 { if (h == "null") own = $2; else run = $2 }
        END { n = split(above, word, " "); limit = 1
              for (i = 1; i < n; i += 2) if (word[i] == name) limit = word[i + 1]
              if (!run) run = own
              allowed = run > 5000 ? .02 * run : 100
              print (trial > 0 && run > 0 && trial <= limit * allowed ? "within" : trial " of " run) }'
}
for deck in decks/*.yaml decks/airscrew/*.yaml; do
    expect "trials of $(basename "$deck" .yaml): within their share" within "$(share "$deck")" "$work/err"
done
