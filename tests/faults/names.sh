# names.sh -- two ways to say one thing: parts of a beam in segments, numbers of repeated members.
. tests/tools/lib.sh
cd "$work" || exit 1

cat >beam.yaml <<'EOF'
fmdsub: 1
gravity: [0, -9.81]
bodies:
  arm:
    beam: {from: [0, 0], to: [8, 0], elements: 8}
    section: {rectangle: [0.2, 0.1]}
    material: aluminium
    modes: 2
    segments: 4
    points: {tip: {station: 1}, middle: {station: 0.6}}
  ball: {mass: 1, inertia: 0.1, at: [8, -1]}
constraints:
  clamp: {revolute: [ground, arm1], at: [0, 0]}
  hang: {revolute: [arm4, ball], at: [8, 0]}
forces:
  stay: {spring: [[0, 3], arm.middle], stiffness: 1000}
integrate: {scheme: midpoint, step: 1.0e-3, until: 0.1}
output: {every: 0.01}
EOF
"$FMDSUB" run -q beam.yaml >want 2>err
ended "parts by their own names: status" 0 $? want err
sed 's/arm1/arm/; s/arm4/arm/' beam.yaml >whole.yaml
"$FMDSUB" run -q whole.yaml >got 2>err
same "joints on the beam itself: the part that they stand at" want got
sed 's/arm1/arm/; s/arm4, ball\], at: \[8, 0\]/arm, ball], at: arm.tip/' beam.yaml >point.yaml
"$FMDSUB" run -q point.yaml >got 2>err
same "joints on the beam itself, at a point" want got
sed 's/arm\.middle/arm3.middle/' beam.yaml >own.yaml
"$FMDSUB" run -q own.yaml >got 2>err
same "points by the name of the part" want got
sed 's/arm\.middle/arm2.middle/' beam.yaml >other.yaml
"$FMDSUB" run -q other.yaml >got 2>err
expect "points of another part: status" 3 $? err
grep -q "unknown point 'arm2.middle'" err && ok "points of another part: told" || not_ok "points of another part: told" "stderr:" err

cat >chain.yaml <<'EOF'
fmdsub: 1
gravity: [0, -9.81]
parameters: {N: 4}
bodies:
  link$(i): {repeat: {i: [1, "N"]}, mass: 1, inertia: 1/12, at: [i - 0.5, 0], points: {far: [0.5, 0]}}
  ball: {mass: 1, inertia: 0.1, at: ["N", -1]}
constraints:
  pin1: {revolute: [ground, link1], at: [0, 0]}
  pin$(i): {repeat: {i: [2, "N"]}, revolute: [link$(i-1), link$(i)], at: [i - 1, 0]}
  hang: {revolute: [link$(N), ball], at: link$(N).far}
integrate: {scheme: midpoint, step: 1.0e-3, until: 0.1}
output: {every: 0.01, columns: ["pin$(N).angle", "link$(N - 1).*", {twice: 2*hang.angle}]}
EOF
sed 's/\$(N)/4/g; s/\$(N - 1)/3/' chain.yaml >plain.yaml
"$FMDSUB" run -q plain.yaml >want 2>err
ended "numbers of members: status" 0 $? want err
"$FMDSUB" run -q chain.yaml >got 2>err
same "\$(N) of a parameter, where nothing is repeated" want got
"$FMDSUB" run -q --columns 'link$(N).*' chain.yaml >got 2>err
"$FMDSUB" run -q --columns 'link4.*' chain.yaml >want 2>err
same "\$(N) in --columns" want got
"$FMDSUB" run -q --columns 'link$(M).*' chain.yaml >got 2>err
expect "\$(M) of no parameter: status" 2 $? err

# Half of the letters wrong is no near miss.
"$FMDSUB" run --columns 'nope*' "$ROOT/decks/pendulum.yaml" >"$work/out" 2>"$work/err"
expect "columns far off: nothing suggested" "2 0" "$? $(grep -c 'did you mean' "$work/err")" "$work/err"
"$FMDSUB" run --columns 'enrgy.*' "$ROOT/decks/pendulum.yaml" >"$work/out" 2>"$work/err"
expect "columns nearly right: the word" 1 "$(grep -c "did you mean 'energy\.\*'" "$work/err")" "$work/err"
for near in ball.wx:ball.wz 'ball.wy*:ball.wz*' ball.vz:ball.vx ball.xx:ball.x; do # another component before one with a letter less
    "$FMDSUB" run --columns "${near%:*}" "$ROOT/decks/pendulum.yaml" >"$work/out" 2>"$work/err"
    expect "columns nearly right: ${near%:*}" 1 "$(grep -cF "did you mean '${near#*:}'" "$work/err")" "$work/err"
done
