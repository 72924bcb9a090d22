# closers.sh -- a spatial four-bar that stays in a plane, closed by every kind of joint: stepped there, and as in space.
. tests/tools/lib.sh
deck() { # CLOSER
    cat <<DECK
fmdsub: 1
gravity: [0, 0, -9.81]
bodies:
  crank: {mass: 1, inertia: [0.01, 0.02, 0.02], at: [0.1, 0, 0.1]}
  rod: {mass: 2, inertia: [0.02, 0.1, 0.1], at: [0.5, 0, 0.3], points: {tip: [0.3, 0, 0.1]}}
  arm: {mass: 1.5, inertia: [0.03, 0.05, 0.03], at: [0.9, 0, 0.2], points: {pin: [0, 0, 0.2]}}
constraints:
  a: {revolute: [ground, crank], at: [0, 0, 0], axis: [0, 1, 0]}
  b: {revolute: [crank, rod], at: [0.2, 0, 0.2], axis: [0, 1, 0]}
  d: {revolute: [ground, arm], at: [1, 0, 0], axis: [0, 1, 0]}
  c: {$1}
initial: {a.angle_rate: 4}
integrate: {scheme: midpoint, step: 1.0e-3, until: 0.5, newton_tolerance: 1.0e-13}
output: {every: 0.05, columns: [a.angle, b.angle, d.angle, rod.x, rod.z]}
DECK
}
# What stays in a plane; its motion there is that in space.
while IFS=: read -r name seen closer; do
    deck "$closer" >"$work/$name.yaml"
    "$FMDSUB" check --no-trial "$work/$name.yaml" >"$work/out" 2>"$work/err"
    expect "closed by $name: stepped" "$seen" "$(sed -n '1s/.*: //p' "$work/out")" "$work/err"
    "$FMDSUB" run -q "$work/$name.yaml" >"$work/flat" 2>"$work/err"
    "$FMDSUB" run -q --set effects.out_of_plane=true "$work/$name.yaml" >"$work/space" 2>>"$work/err"
    paste -d , "$work/flat" "$work/space" | awk -F, '
        NR > 1 { for (i = 2; i <= 6; i++) { d = $i - $(i + 6); d = d < 0 ? -d : d; if (d > worst) worst = d } rows++ }
        NR == 2 { from = $2 } { turned = $2 - from }
        END { printf "%.1g apart", worst; exit !(rows == 11 && worst < 1e-9 && (turned > .05 || turned < -.05)) }' >"$work/line"
    if [ $? = 0 ]; then ok "closed by $name: in its plane as in space, $(cat "$work/line")"
    else not_ok "closed by $name: in its plane as in space" "$(cat "$work/line")" "$work/flat" "$work/space" "$work/err"; fi
done <<'END'
revolute:spatial, in a plane:revolute: [rod, arm], at: [0.8, 0, 0.4], axis: [0, 1, 0], loop: true
cylindrical:spatial, in a plane:cylindrical: [rod, arm], at: [0.8, 0, 0.4], axis: [0, 1, 0], loop: true
spherical:spatial, in a plane:spherical: [rod, arm], at: [0.8, 0, 0.4], loop: true
prismatic:spatial, in a plane:prismatic: [rod, arm], at: [0.8, 0, 0.4], axis: [1, 0, 1], loop: true
distance:spatial, in a plane:distance: [rod.tip, [0.9, 0, 0.9]]
line:spatial, in a plane:point-on-line: [rod, arm], at: [0.8, 0, 0.4], axis: [-1, 0, 2]
gear:spatial, in a plane:gear: [a, d], ratio: -0.5
universal:spatial:universal: [rod, arm], at: [0.8, 0, 0.4], axis: [0, 1, 0], axis2: [1, 0, 0], loop: true
END
