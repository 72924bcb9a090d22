# H29: Kane's spin-up, 6 rad/s on a beam of 2.9: it stands 0.2465 mm longer, less what its humming takes; without stiffening it is told.
for scheme in $schemes; do
    row $scheme 5e-6 '$1 > 15.9 { s += $2; n++ } END { printf "%.2g", abs(s / n - 2.4652e-4) }' --set output='{every: 0.01, columns: [arm.tip.dx]}' <"$ROOT/decks/spin-up.yaml"
    row $scheme told 'stiffening' --strict --set bodies.arm.stiffening=false <"$ROOT/decks/spin-up.yaml"
done
