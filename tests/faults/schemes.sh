# schemes.sh -- every scheme, by steps and by tolerance, a little way with scenes of all kinds: what is counted, and all columns of the
# last record, by their sums.  Such runs are too short for round-off to grow: evaluations are exact.
. tests/tools/lib.sh
. tests/tools/sums.sh

# short NAME DECK UNTIL INTEGRATE: times are left out, and what round-off leaves.
short() {
    say "$1" "$FMDSUB" run -q --stats="$work/stats" --until "$3" --every-steps 1000000 -c '*' --set "integrate={$4, until: $3}" "$2"
    [ ! -f "$work/stats" ] || grep -v '^energy_\|^newton_left\|^constraint_worst\|^cpu_seconds\|^bytes_' "$work/stats" >>"$work/texts/$1"
    rm -f "$work/stats"
}

# DECK STEP UNTIL
while read -r deck step until; do
    name=$(basename "$deck" .yaml)
    for scheme in newmark generalized-alpha hht midpoint rk4 subcycle miao daniel neal-belytschko; do
        short "$name.$scheme.step" "$deck" "$until" "scheme: $scheme, step: $step"
    done
    for scheme in newmark midpoint subcycle; do
        short "$name.$scheme.four" "$deck" "$until" "scheme: $scheme, step: $step, order: 4"
    done
    for scheme in newmark generalized-alpha hht midpoint dopri5 dop853 radau5 radau9 subcycle auto; do
        short "$name.$scheme.loose" "$deck" "$until" "scheme: $scheme, tolerance: 1.0e-3"
        short "$name.$scheme.tight" "$deck" "$until" "scheme: $scheme, tolerance: 1.0e-6"
    done
done <<'END'
decks/double-pendulum.yaml 1.0e-3 0.1
decks/stiff-leaf-chain.yaml 1.0e-4 0.004
decks/flexible-crank.yaml 5.0e-5 0.001
decks/heavy-top.yaml 5.0e-4 0.03
decks/bearing.yaml 1.0e-4 0.004
decks/quick-return.yaml 1.0e-3 0.1
END
sums_judge tests/said/schemes.txt "" .01
