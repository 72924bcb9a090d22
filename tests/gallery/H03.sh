# H03: two four-bar windows fall flat ten times in 10 s, IFToMM A02: where the first post ends, and whether the beams stay level.
for scheme in $schemes; do
    row $scheme 1e-5 'NR > 1 { see($4) } END { off = abs($2 - 0.3284581115) + abs($3 - 0.9445185382); printf "%.2g", (off > worst ? off : worst) }' \
        --set integrate.step=1.25e-4 --set integrate.rho_infinity=1 --set output='{every: 0.5, columns: [post1.top.x, post1.top.y, beam1.angle]}' <"$ROOT/decks/windows.yaml"
done
