# modes.sh -- what `fmdsub modes` prints: numbered from 1, slowest first, frequency and angular frequency of one motion, shares
# of the fast coordinates.
. tests/tools/lib.sh
for deck in stiff-leaf-chain chain heavy-top; do
    "$FMDSUB" modes decks/$deck.yaml >"$work/modes" 2>"$work/err"
    awk -F, '
        function size(a) { return a < 0 ? -a : a }
        function off(a, b) { return size(a - b) }
        NR == 1 { last = -1e99; fine = $0 == "mode,frequency,omega,damping,fast,coordinates"; next }
        $1 != NR - 1 || off($3, 6.283185307179586 * $2) > 1e-12 * size($3) || $3 < last || $5 < 0 || $5 > 1 + 1e-12 { fine = 0; print }
        { last = $3 }
        END { exit !(fine && NR > 1) }' "$work/modes" >"$work/wrong"
    expect "modes: $deck" 0 $? "$work/wrong" "$work/err"
done

# Links of a chain that move against each other take and give many times the energy of a mode; their shares stay shares.
"$FMDSUB" modes decks/chain.yaml >"$work/out" 2>"$work/err"
most=$(grep -o '[0-9]*%' "$work/out" | tr -d % | sort -n | tail -n 1)
[ "${most:-999}" -le 100 ] && ok "modes: shares of a chain" || not_ok "modes: shares of a chain" "up to ${most:-?} %" "$work/out"

# A force that pushes along: a negative damping, -c/(2 m omega), told to grow; a brake's is its own, above 1, too.
cat >"$work/car.yaml" <<'END'
fmdsub: 1
parameters: {c: -0.8}
bodies: {car: {mass: 2, at: [0, 0]}}
constraints: {rail: {prismatic: [ground, car], axis: [1, 0]}}
forces: {spring: {spring: rail, stiffness: 200}, pushes: {force: rail, value: -c*rail.displacement_rate}}
integrate: {scheme: midpoint, step: 1.0e-3, until: 0.1}
END
damped() { # C WORDS
    "$FMDSUB" modes --set parameters.c="$1" "$work/car.yaml" >"$work/out" 2>"$work/err"
    expect "modes: a damper of $1 Ns/m" "0 yes $2" \
        "$? $(awk -F, -v c="$1" 'NR == 2 { d = $4 - c / 40; e = $3 - 10; print (d * d < 1e-20 && e * e < 1e-20) ? "yes" : $0 }' "$work/out") $(grep -c 'negative damping is growing vibration' "$work/err")" "$work/out" "$work/err"
}
damped -0.8 1
damped 0.8 0
damped 400 0
"$FMDSUB" modes -q "$work/car.yaml" >"$work/out" 2>"$work/err"
expect "modes -q: a table and no words" "0 2 0" "$? $(wc -l <"$work/out") $(wc -c <"$work/err")" "$work/out" "$work/err"

# A slack chain of 230 links in space without weight, whose mass matrix has pivots far below its diagonal, with a spring of 100 Nm/rad
# at the last joint: one frequency, omega^2 = 100 e'M^-1 e = 1883.06325798367, by the mass matrix of absolute angles in dense algebra,
# the same from 20 links on.
cat >"$work/slack.yaml" <<'END'
fmdsub: 1
parameters: {N: 230}
bodies:
  link$i: {repeat: {i: [1, N]}, mass: 1, inertia: 1/12, at: [i - 0.5, 0]}
constraints:
  pin1: {revolute: [ground, link1], at: [0, 0]}
  pin$i: {repeat: {i: [2, N]}, revolute: [link$(i-1), link$i], at: [i - 1, 0]}
forces: {leaf: {spring: pin$(N), stiffness: 100}}
integrate: {until: 1}
END
"$FMDSUB" modes -q "$work/slack.yaml" >"$work/out" 2>"$work/err"
expect "modes: a slack chain of 230 links" "0 fine" "$? $(awk -F, '
    NR > 1 && NR < 231 && $2 * $2 > 1e-6 { print "moves: " $0; exit }
    NR == 231 { off = $3 * $3 / 1883.06325798367 - 1; print off * off < 1e-12 ? "fine" : $0 }' "$work/out")" "$work/err"
