# kept.sh -- momenta that a scheme keeps to round-off are no columns whose range the estimated error is to be told over.
. tests/tools/lib.sh

for scheme in "midpoint, step: 1.0e-3" "midpoint, tolerance: 1.0e-5"; do
    cat >"$work/deck.yaml" <<END
fmdsub: 1
bodies:
  a: {mass: 2, inertia: [0.1, 0.2, 0.25], at: [0, 0, 0]}
  b: {mass: 1, inertia: [0.05, 0.04, 0.03], at: [1, 0.1, 0]}
constraints: {A: {free: [ground, a]}, B: {free: [ground, b]}}
forces: {u: {bushing: [a, b], at: [0.5, 0, 0], stiffness: [1000, 1000, 2000], rotation: [10, 10, 10]}}
initial: {A.omega: [1, 2, 0.5], B.omega: [-3, 1, 2], B.x_rate: 0.5}
integrate: {scheme: $scheme, until: 1}
output: {every: 0.02, columns: [a.x, b.x, b.wx, "momentum.*"]}
END
    "$FMDSUB" run "$work/deck.yaml" >"$work/out" 2>"$work/err"
    ended "$scheme: status" 0 $? "$work/out" "$work/err"
    grep -q "^estimated error: [0-9]" "$work/err" && ok "$scheme: estimated error" ||
        not_ok "$scheme: estimated error" "momenta are kept to round-off" "$work/err"
done

# Where hardly any work is done the balance asks for no more of the energy at the start than a tolerance does, velocities to it: twice;
# for all of what the deck's own delta makes of that, and of steps as they were.
for tolerance in 1e-2 1e-3 1e-4; do
    for scheme in newmark hht dopri5; do
        "$FMDSUB" run -q --stats="$work/stats" -s integrate.scheme=$scheme -s integrate.tolerance=$tolerance decks/slider-crank.yaml >"$work/out" 2>"$work/err"
        expect "no works, $scheme at $tolerance: the tolerance is met" "0 yes" \
            "$? $(awk -v t=$tolerance '$1 == "energy_residual_worst" { print ($2 > 1e-2 * t * 64 / 3 && $2 < 2 * t * 64 / 3 ? "yes" : $2) }' "$work/stats")" "$work/err" "$work/stats"
    done
done
"$FMDSUB" run -q -s integrate.scheme=newmark -s integrate.tolerance=1e-3 -s energy.delta=1e-3 decks/slider-crank.yaml >"$work/out" 2>"$work/err"
expect "no works, the deck's own delta" "1 1" "$? $(grep -c 'the energy balance (2-26) is broken' "$work/err")" "$work/err"
"$FMDSUB" run -q -s integrate.step=2e-2 decks/slider-crank.yaml >"$work/out" 2>"$work/err"
expect "no works, a step that is too long" "1 1" "$? $(grep -c 'the energy balance (2-26) is broken' "$work/err")" "$work/err"
