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
say schema "$FMDSUB" schema
say list "$FMDSUB" list
for what in schemes joints forces contacts friction effects sections; do say "list.$what" "$FMDSUB" list $what; done
sums_judge tests/said/sums.txt
