# oblique.sh -- a universal joint of oblique axes is refused with a cure in lines of a deck; these lines run, as a tree and
# closing a loop, whichever of the joints closes it.
. tests/tools/lib.sh

# cure NAME: the deck of $work/wrong.yaml with what the refusal says put in.
cure() {
    "$FMDSUB" check "$work/wrong.yaml" >"$work/out" 2>"$work/err"
    expect "$1: refused" 3 $?
    awk 'FNR == NR && !/\|   [A-Za-z_0-9]*: / { next }
         FNR == NR { line = $0; sub(/^[^|]*\|   /, "", line); if (line ~ /revolute/) joint[++n] = line; else body = line; next }
         /universal/ { for (i = 1; i <= n; i++) print "  " joint[i]; next }
         { print }
         /^bodies:/ { print "  " body }' "$work/err" "$work/wrong.yaml" >"$work/cured.yaml"
}

# By Lagrange's equations of the two angles, slopes of M and V by differences, 4000 steps of Runge and Kutta.
cat >"$work/wrong.yaml" <<'END'
fmdsub: 1
gravity: [0, 0, -9.81]
bodies:
  ball: {mass: 1, inertia: [0.1, 0.2, 0.3], at: [1, 0.2, 0]}
constraints:
  pin: {universal: [ground, ball], at: [0, 0, 0], axis: [0, 1, 0], axis2: [0.3, 1, 0.4]}
initial: {pin_1.angle_rate: 1, pin_2.angle: 0.2}
integrate: {scheme: dop853, tolerance: 1.0e-10, until: 2}
output: {every: 0.5, columns: [pin_1.angle, pin_2.angle, ball.x, ball.y, ball.z]}
END
cure "oblique, a tree"
go "oblique, a tree" 0 <"$work/cured.yaml"
hand=2,1.2302144696,-0.2995743110,0.5685822545,0.1033245427,-0.8402608278
near "oblique, a tree: angles and place" "$hand" "$last" 2e-8
for scheme in newmark midpoint subcycle; do
    go "oblique, a tree, $scheme" 0 --set "integrate={scheme: $scheme, step: 1.0e-4, until: 2}" <"$work/cured.yaml"
    near "oblique, a tree: $scheme" "$hand" "$last" 1e-5
done

# loop AXIS2
loop() {
    cat <<END
fmdsub: 1
gravity: [0, 0, -9.81]
bodies:
  crank: {mass: 1, inertia: [0.01, 0.02, 0.02], at: [0, 0.1, 0]}
  rod: {mass: 0.8, inertia: [0.02, 0.072, 0.072], at: [0.5, 0.3, 0.1], orient: {x: [1, 0.2, 0.2], z: [-0.2, 0, 1]}}
  rocker: {mass: 1.2, inertia: [0.02, 0.03, 0.04], at: [1, 0.2, 0.1]}
constraints:
  A: {revolute: [ground, crank], at: [0, 0, 0], axis: [1, 0, 0]}
  B: {universal: [crank, rod], at: [0, 0.2, 0], axis: [0, 1, -1], axis2: [$1]}
  C: {spherical: [rod, rocker], at: [1, 0.4, 0.2]}
  D: {revolute: [rocker, ground], at: [1, 0, 0], axis: [0, 1, 0.1]}
initial: {D.angle_rate: 1}
integrate: {scheme: dop853, tolerance: 1.0e-10, until: 2}
output: {every: 0.5, columns: [rod.x, rod.y, rod.z, rod.qw, rod.qx, rocker.qw, D.mx, energy.kinetic]}
END
}
loop "-0.4, 1, 0.4" >"$work/wrong.yaml"
cure "oblique, a loop"
go "oblique, a loop" 0 <"$work/cured.yaml"
want=$last
for closing in A C B_1 B_2; do
    sed "s/^\( *$closing: {.*\)}\$/\1, loop: true}/" "$work/cured.yaml" >"$work/closing.yaml"
    go "oblique, closed by $closing" 0 <"$work/closing.yaml"
    near "oblique, closed by $closing: the same motion" "$want" "$last" 1e-6
done
# Right angles are the program's own joint; a hair beside them it is the two joints.
loop "-0.4, 1, 1" >"$work/right.yaml"
go "right angles" 0 <"$work/right.yaml"
want=$last
loop "-0.4, 1, 1.00001" >"$work/wrong.yaml"
cure "a hair beside right angles"
go "a hair beside right angles" 0 <"$work/cured.yaml"
near "a hair beside right angles: as with right ones" "$want" "$last" 2e-3
