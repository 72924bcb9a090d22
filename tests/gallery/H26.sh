# H26: two drives of one freedom: equal they run, as they do 1e-9 apart; 1e-3 apart they are refused.
for scheme in $schemes; do
    for apart in 0 1.0e-9; do
        row $scheme 1e-8 'END { printf "%.2g", abs($2 - 0.2 * sin(1)) }' --set parameters.d=$apart --set output='{every: 1, columns: [shaft.angle]}' <"$ROOT/tests/hard/two-drives.yaml"
    done
    row $scheme told 'drive' --set parameters.d=1.0e-3 <"$ROOT/tests/hard/two-drives.yaml"
done
