# H41: the same mechanism with its members in another order, renamed, turned, shifted by 1e6 m, in millimetres.
sed 's/wrist: *{/wrist: {loop: true, /' "$ROOT/decks/telescope.yaml" >base.yaml
variant() {
    limit=$1 scale=$2
    shift 2
    awk -f "$ROOT/tests/hard/variant.awk" "$@" base.yaml |
        row $scheme $limit 'BEGIN { while ((getline line <"base.csv") > 0) want[++n] = line }
            FNR > 1 { split(want[FNR], w); for (i = 2; i <= 5; i++) { d = abs(w[i] - $i / (i == 4 ? '$scale' : 1)); if (d > off[i]) off[i] = d; if (abs(w[i]) > big[i]) big[i] = abs(w[i]) } }
            END { for (i = 2; i <= 5; i++) see(off[i] / big[i]); printf "%.2g", (FNR == n && n > 50 ? worst : 9) }' --set integrate.newton_tolerance=1.0e-13
}
for scheme in $schemes; do
    "$FMDSUB" run -q --set integrate.scheme=$scheme --set integrate.newton_tolerance=1.0e-13 base.yaml >base.csv 2>err
    variant 1e-10 1 -v reversed=1
    variant 1e-10 1 -v renamed=1
    variant 1e-10 1 -v turn=0.7
    variant 1e-6 1 -v x=1000000 -v y=-300000
    variant 1e-10 1000 -v scale=1000
    variant 1e-9 1000 -v reversed=1 -v renamed=1 -v turn=-2.1 -v x=50 -v y=70 -v scale=1000
done
