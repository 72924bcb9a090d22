# H30: a slider on a turning rod leaves it, at about 2.13 s: told at once; its speed stays below sqrt(k/m) = 14.1421 rad/s.
row subcycle told 'guide.displacement is outside its range' --strict --until 3 <"$ROOT/decks/bar-slider.yaml"
for scheme in $schemes rk4; do
    row $scheme 14.1422 'NR > 1 { see($2) } END { print worst }' --until 20 --set output='{every: 0.5, columns: [hub.angle_rate]}' <"$ROOT/decks/bar-slider.yaml"
done
