# sums.sh -- what is said of every deck that is shipped or tested, words and numbers: sheets, small motions, what grows from step
# to step, columns.
. tests/tools/lib.sh
. tests/tools/sums.sh
for deck in decks/*.yaml decks/*/*.yaml tests/decks/*.yaml tests/hard/units/*.yaml tests/trust/*.yaml tests/effects/*.yaml; do
    name=$(echo "${deck%.yaml}" | tr / -)
    say "$name.check" "$FMDSUB" check --no-trial "$deck"
    say "$name.object" "$FMDSUB" check --no-trial -f json "$deck"
    say "$name.columns" "$FMDSUB" list columns "$deck"
    say "$name.modes" "$FMDSUB" modes "$deck"
done
for name in andrews axle bar-slider-constant bar-slider bearing cardan four-bar gear-train geared-pendulum heavy-top pendulum rotor; do
    say "$name.stability" "$FMDSUB" stability "decks/$name.yaml"
done
while read -r deck until; do
    say "$deck.explain" "$FMDSUB" explain --until "$until" "decks/$deck.yaml"
    say "$deck.effects" "$FMDSUB" explain -f json --until "$until" "decks/$deck.yaml"
done <<'END'
pendulum 0.1
bar-slider 0.05
four-bar 0.1
heavy-top 0.02
governor 0.02
cantilever 0.02
chain 0.05
spring-pendulum 0.05
floating-satellite 0.05
flexible-crank 0.005
flexible-robot 0.005
flexible-pendulum 0.005
effect-plane 0.1
effect-modes 0.1
effect-stiffening 0.1
effect-momentum 0.1
effect-friction 0.1
effect-reactions 0.1
effect-gyroscopic 0.1
END
say schema "$FMDSUB" schema
say list "$FMDSUB" list
for what in schemes joints forces contacts friction effects sections; do say "list.$what" "$FMDSUB" list $what; done
sums_judge tests/said/sums.txt
