# sums.sh -- what trial runs find of every deck (steps, tolerances, what scheme: auto would take), and what a study prints of
# small ones, rows and sentences.
. tests/tools/lib.sh
. tests/tools/sums.sh
for deck in decks/*.yaml tests/decks/*.yaml tests/advice/*.yaml tests/trust/*.yaml; do
    name=$(echo "${deck%.yaml}" | tr / -)
    say "$name.trials" "$FMDSUB" check -q "$deck"
    say "$name.auto" "$FMDSUB" check -q -f json -s 'integrate={tolerance: 1.0e-4, until: 1}' "$deck"
done
while read -r deck until options; do
    say "$deck.study" "$FMDSUB" study --repeats 0 --until "$until" $options decks/$deck.yaml
done <<'END'
pendulum 0.5 --absolute
four-bar 0.1
spring-pendulum 0.2 --ratios 1,4
bar-slider 0.05 -f ndjson
heavy-top 0.05
flexible-pendulum 0.002
andrews 0.002
cardan 0.02
driven-telescope 0.05
chain 0.05 --tolerances 1e-2,1e-4 --pick 1e-3
gear-train 0.05 --steps 1e-3,5e-4 --pick 1e-5
END
sums_judge tests/said/study.txt "" .1
