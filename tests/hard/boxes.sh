# boxes.sh -- boxes on each other that open, slip and strike many times; TOLERANCES: others than two quick ones.
. tests/tools/lib.sh

# Three boxes on each other, the lowest pulled to and fro until they tilt and fall: many openings, slips and impacts.  By tolerance
# the run ends where steps of 0.25 ms do.
cat >"$work/stack.yaml" <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies:
  a: {mass: 3, inertia: 0.05, at: [0, 0.1], points: {bl: [-0.2, -0.1], br: [0.2, -0.1], tl: [-0.2, 0.1], tr: [0.2, 0.1]}}
  b: {mass: 2, inertia: 0.03, at: [0, 0.3], points: {bl: [-0.15, -0.1], br: [0.15, -0.1], tl: [-0.15, 0.1], tr: [0.15, 0.1]}}
  c: {mass: 1, inertia: 0.02, at: [0, 0.5], points: {bl: [-0.1, -0.1], br: [0.1, -0.1]}}
forces:
  pull: {force: a, value: ["40*sin(4*t)", 0]}
surfaces:
  floor: {plane: ground, at: [0, 0], normal: [0, 1]}
  at: {plane: a, at: [0, 0.2], normal: [0, 1]}
  bt: {plane: b, at: [0, 0.4], normal: [0, 1]}
  fa: {points: [a.bl, a.br]}
  fb: {points: [b.bl, b.br]}
  fc: {points: [c.bl, c.br]}
contacts:
  c1: {between: [fa, floor], friction: 0.3}
  c2: {between: [fb, at], friction: 0.25}
  c3: {between: [fc, bt], friction: 0.2}
constraints: {fa: {free: [ground, a], at: [0, 0.1]}, fb: {free: [ground, b], at: [0, 0.3]}, fc: {free: [ground, c], at: [0, 0.5]}}
integrate: {until: 3}
output: {every: 0.1, columns: [a.x, b.x, c.x, a.angle, energy.residual]}
END
"$FMDSUB" run -q -s integrate.step=2.5e-4 -s output.every=1 "$work/stack.yaml" >"$work/by-step" 2>"$work/err"
for tolerance in ${TOLERANCES:-1e-2 1e-3}; do
    "$FMDSUB" run -q -s integrate.tolerance=$tolerance -s output.every=1 "$work/stack.yaml" >"$work/out" 2>"$work/err"
    expect "three boxes pulled over, by $tolerance: status, where they are" "0 0" \
        "$? $(paste -d, "$work/by-step" "$work/out" | awk -F, 'NR > 1 { for (i = 2; i <= 5; i++) if (($i - $(i + 6))^2 > .05^2) bad++ } END { print bad + (NR != 5) }')" \
        "$work/out" "$work/err"
done
