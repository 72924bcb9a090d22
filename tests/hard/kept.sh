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
