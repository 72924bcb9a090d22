# coupler.sh -- a stiff telescoping coupler across a four-bar, across the partition: omega h from 5 to 200, excited and not, at
# ratios 1, 5 and 20.  Unexcited it is right, excited it is told at its first sign, by time and coordinate.
. tests/tools/lib.sh
cat >"$work/x4.yaml" <<'DECK'
fmdsub: 1
parameters: {w: 1000, m: 1}
gravity: [0, -9.81]
bodies:
  a: {mass: 1, inertia: 1/12, at: [0, 0.5]}
  b1: {mass: 1, inertia: 1/12, at: [0.5, 1.125], orient: "atan2(0.25,1)"}
  b2: {mass: m, inertia: m/12, at: [1.5, 1.375], orient: "atan2(0.25,1)"}
  c: {mass: 1.5, inertia: 0.3, at: [2, 0.75]}
constraints:
  p0: {revolute: [ground, a], at: [0, 0]}
  p1: {revolute: [a, b1], at: [0, 1]}
  tele: {prismatic: [b1, b2], at: [1, 1.25], axis: [2, 0.5]}
  p2: {revolute: [b2, c], at: [2, 1.5]}
  p3: {revolute: [ground, c], at: [2, 0]}
forces: {k: {spring: tele, stiffness: m*w^2/4}}
initial: {p0.angle_rate: 3, tele.displacement: 0.01, assemble: true}
partition: {fast: [tele]}
integrate: {scheme: subcycle, step: 1.0e-3, ratio: 5, until: 2}
output: {every: {steps: 10}, columns: [a.angle, c.angle, tele.displacement, energy.residual]}
DECK
# The slow motion that is right, of the crank's angle c 2 percent of its range: by an explicit scheme whose steps the spring makes.
"$FMDSUB" run -q --set initial.tele.displacement=0 --set parameters.w=3536 --set integrate='{scheme: dop853, tolerance: 1.0e-9, until: 2}' --set output.every=0.1 "$work/x4.yaml" >"$work/want" 2>"$work/err"
right() {
    awk -F, 'FNR == 1 { next } NR == FNR { c[sprintf("%.3f", $1)] = $3; if ($3 < low) low = $3; if ($3 > high) high = $3; next }
        sprintf("%.3f", $1) in c { n++; d = $3 - c[sprintf("%.3f", $1)]; if (d < 0) d = -d; if (d > most) most = d } END { print (n > 9 && most <= 0.02 * (high - low)) }' "$work/want" "$work/out"
}
for n in 1 5 20; do
    for w in 3536 14142 46669 141421; do
        "$FMDSUB" run --set parameters.w=$w --set integrate.ratio=$n "$work/x4.yaml" >"$work/out" 2>"$work/err"
        rc=$?
        if { { [ $rc = 1 ] || [ $rc = 7 ]; } && grep -q "^warning: t = .* for the first time: the step does not resolve 'tele.displacement' (omega h = " "$work/err"; } || { [ $rc = 5 ] && grep -q 'stopped at t = ' "$work/err"; }; then ok "excited, $n:1, w $w: told"
        else not_ok "excited, $n:1, w $w: told" "exit $rc" "$work/err"; fi
        # The guard acts: the balance is kept in smaller parts of steps, and damped where these do not do it; what that takes
        # is no more than there was.
        "$FMDSUB" run --set parameters.w=$w --set integrate.ratio=$n --set integrate.guard=act --columns energy.kinetic,energy.elastic,energy.residual "$work/x4.yaml" >"$work/out" 2>"$work/err"
        expect "excited, $n:1, w $w, the guard acts" "0 1 1 1 1" "$? $(grep -c 'which is taken in parts from here: .*tele.displacement' "$work/err") $(grep -c '^guard: [1-9][0-9]* major steps in parts' "$work/err") $(sed -n 's/^energy balance.*(\([0-9.e-]*\); limit.*/\1/p' "$work/err" | awk '{ print $1 < 0.01 }') $(awk -F, -v w=$w 'NR > 1 { n++; e = $2 + $3 } !(e < 1.02 * w * w / 4 * 0.01^2 / 2 + 100) { bad = 1 } END { print (n > 8 && !bad) }' "$work/out")" "$work/err"
        # A tenth of that excites it, too.
        "$FMDSUB" run --set parameters.w=$w --set integrate.ratio=$n --set initial.tele.displacement=1.0e-3 "$work/x4.yaml" >"$work/out" 2>"$work/err"
        expect "excited by 1 mm, $n:1, w $w: told" "1 1" "$? $(grep -c "^warning: t = .* for the first time: the step does not resolve 'tele.displacement' (omega h = " "$work/err")" "$work/err"
        # Not excited it is right by whatever major step the slow motion bears: 20 ms are too long for it by order 2, and not by order 4
        # or where the guard acts.
        for how in integrate.order=2 integrate.order=4 integrate.guard=act; do
            [ $n,$how = 1,integrate.order=4 ] && continue
            "$FMDSUB" run --set parameters.w=$w --set integrate.ratio=$n --set initial.tele.displacement=0 --set $how "$work/x4.yaml" >"$work/out" 2>"$work/err"
            rc=$?
            if [ $n,$how = 20,integrate.order=2 ] && grep -q 'for the first time' "$work/err"; then ok "not excited, $n:1, w $w: told"
            else expect "not excited, $n:1, w $w, $how: right" "0 1" "$rc $(right)" "$work/err"; fi
        done
    done
done

# A scheme that damps takes the vibration away and keeps the balance; what it would have done to the crank is missing, 5 to 100
# percent of its range, and is told, and the error is not known.  Nothing is taken where nothing is excited.
for how in "midpoint 1 0.9" "midpoint 1 0" "newmark 1 0.9" "generalized-alpha 1 0.9" "hht 1 0.9" "subcycle 1 0.5" "subcycle 5 0.99"; do
    set -- $how
    for w in 3536 14142 46669 141421; do
        for e in 1.0e-3 0; do
            "$FMDSUB" run --set parameters.w=$w --set integrate.scheme=$1 --set integrate.ratio=$2 --set integrate.rho_infinity=$3 --set initial.tele.displacement=$e --columns c.angle "$work/x4.yaml" >"$work/out" 2>"$work/err"
            rc=$?
            if [ $e = 0 ]; then expect "damped by $how, not excited, w $w" "0 0 wrote" "$rc $(grep -c "own damping has taken" "$work/err") $(wrote "$work/out")" "$work/err"
            else expect "damped by $how, w $w: told" "told so" "$(grep -q "^warning: t = .* for the first time: the step does not resolve 'tele.displacement' (omega h = " "$work/err" && echo told) $(grep -q '^estimated error: not known: the scheme has damped away\|^energy balance broken:' "$work/err" && echo so)" "$work/err"; fi
        done
    done
done

# Beside a motor and a brake that turn over a megawatt nothing is a large share of all works: what is excited is told by the
# energies that are there.  What is not excited runs on.
sed 's/^  c: /  fly: {mass: 10, inertia: 1, at: [5, 0]}\n&/; s/^constraints:/&\n  shaft: {revolute: [ground, fly], at: [5, 0]}/; s/^forces: {/&motor: {torque: shaft, value: 1.0e+4}, brake: {damper: shaft, damping: 100}, /; s/^initial: {/&shaft.angle_rate: 100, /' "$work/x4.yaml" >"$work/beside.yaml"
for n in 1 5 20; do
    for w in 3536 14142 46669 141421; do
        "$FMDSUB" run --set parameters.w=$w --set integrate.ratio=$n --until 1 "$work/beside.yaml" >"$work/out" 2>"$work/err"
        rc=$?
        if { [ $rc = 1 ] && grep -q "^warning: t = .* for the first time: the step does not resolve 'tele.displacement' (omega h = " "$work/err" && grep -q '\[balance\]' "$work/err"; } || { [ $rc = 5 ] && grep -q 'stopped at t = ' "$work/err"; }; then ok "beside a motor, $n:1, w $w: told"
        else not_ok "beside a motor, $n:1, w $w: told" "exit $rc" "$work/err"; fi
        [ $n = 1 ] || continue
        "$FMDSUB" run --set parameters.w=$w --set integrate.ratio=$n --set initial.tele.displacement=0 --until 1 "$work/beside.yaml" >"$work/out" 2>"$work/err"
        expect "beside a motor, not excited, w $w" "0 0 wrote" "$? $(grep -c 'for the first time' "$work/err") $(wrote "$work/out")" "$work/err"
    done
done
