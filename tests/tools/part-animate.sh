# part-animate.sh -- moving pictures: what is seen stands where the records say.
. tests/tools/lib.sh
need_program animate
cd "$work" || exit 1
animate() { "$FMDSUB" animate "$@" 2>err; }

# frames FILE NAME: the numbers of a thing in a page, all of its frames.
frames() { grep "\"name\":\"$2\"" "$1" | sed 's/.*"p":\[\([^]]*\)\].*/\1/' | tr , '\n'; }
# apart A B: largest difference of two lists of numbers, more than a millionth or not.
apart() { paste "$1" "$2" | awk '{ d = $1 - $2; if (d < 0) d = -d; if (d > most) most = d; n++ } END { print (n > 10 && most < 2e-6 && NF == 2) ? "same" : "apart by " most " of " n }'; }

animate --every 0.1 -o p.html "$ROOT/decks/pendulum.yaml"
ended "a page" 0 $? p.html err
expect "words" "p.html: 101 frames of 2 things, t = 0 to 10 s" "$(cat err)"
"$FMDSUB" run -q --every 0.1 -c 'ball.x,ball.y' "$ROOT/decks/pendulum.yaml" | sed 1d | cut -d , -f 2,3 | tr , '\n' >want
frames p.html ball | awk 'NR % 7 == 1 || NR % 7 == 2' >got
expect "a rigid body stands where the records say" same "$(apart want got)"
expect "columns of the deck beside" "8" "$(sed -n '/^"columns"/,/^<\/script/p' p.html | grep -c '^{"n":')" p.html
expect "one file, nothing from outside" "1 0" "$(grep -c '</html>' p.html) $(grep -c 'https*://\|src=\|import(' p.html)" p.html
animate -o q.html "$ROOT/decks/pendulum.yaml"
expect "500 records where nobody says how many" "q.html: 501 frames" "$(sed 's/ of .*//' err)" err

# In space: turned as the quaternion says. A flexible body: its tip by frame and coordinates.
animate --every 0.05 -c 'bar2.q*' -o b.html "$ROOT/decks/bricard.yaml"
"$FMDSUB" run -q --every 0.05 -c 'bar2.q*' "$ROOT/decks/bricard.yaml" 2>/dev/null | sed 1d >q.csv
frames b.html bar2 | awk 'NR % 7 == 4 || NR % 7 == 5 || NR % 7 == 6 || NR % 7 == 0' | paste - - - - >got.q
awk -F '[,\t]' '{ s = 1; getline line <"got.q"; split(line, g, "\t"); if ($2 * g[1] + $3 * g[2] + $4 * g[3] + $5 * g[4] < 0) s = -1
    for (i = 1; i <= 4; i++) print $(i + 1), s * g[i] }' q.csv | awk '{ print $1 >"a"; print $2 >"b" }'
expect "a body in space turns as the records say" same "$(apart a b)"
cat >beam.yaml <<'YAML'
fmdsub: 1
title: "a <b> & </script>"
gravity: [0, -9.81]
bodies:
  arm:
    beam: {from: [0, 0], to: [2, 0], elements: 8}
    section: {rectangle: [0.02, 0.01]}
    material: steel
    modes: 4
    points: {tip: {station: 1}}
constraints:
  clamp: {fixed: [ground, arm], at: [0, 0]}
integrate: {scheme: midpoint, step: 1.0e-3, until: 0.3}
output: {every: 0.01, columns: [arm.tip.x, arm.tip.y]}
YAML
animate --every 0.01 -o beam.html beam.yaml
ended "a beam" 0 $? beam.html err
expect "a title that would be markup" "1 0" "$(sed -n '/^const D=/p' beam.html | grep -c u003c) $(sed -n '/^const D=/p' beam.html | grep -c '<')"
grep '"name":"arm"' beam.html | sed 's/[{}"]//g' | awk '
    function list(name,   s) { s = $0; sub(".*," name ":\\[", "", s); sub("\\].*", "", s); return s }
    { n = $0; sub(/.*,n:/, "", n); n += 0; nv = $0; sub(/.*,nv:/, "", nv); nv += 0
      split(list("x"), x, ","); split(list("m"), m, ","); k = split(list("p"), p, ",")
      for (f = 0; f < k / (7 + n); f++) for (c = 1; c <= 2; c++) {
          at = x[3 * (nv - 1) + c]; for (j = 0; j < n; j++) at += p[f * (7 + n) + 8 + j] * m[3 * (j * nv + nv - 1) + c]
          print p[f * (7 + n) + c] + at } }' >got
"$FMDSUB" run -q beam.yaml 2>/dev/null | sed 1d | cut -d , -f 2,3 | tr , '\n' >want
paste want got | awk 'NR % 2 == 0 { d = $1 - $2; if (d < 0) d = -d; if (d > most) most = d; n++; if ($1 < low) low = $1 } END { print n, (low < -0.05), (most < 0.002 * -low) }' >tip
expect "the tip of a beam bends as the records say" "31 1 1" "$(cat tip)" tip

# Surfaces that touch: a ball's rim, a cam beside its shaft, and a floor under all that moves on it.
cat >touch.yaml <<'YAML'
fmdsub: 1
gravity: [0, -9.81]
bodies: {wheel: {mass: 1, inertia: 1, at: [0, 0]}, ball: {mass: 1, inertia: 1, at: [4, 0.5]}}
constraints: {shaft: {revolute: [ground, wheel], at: [0, 0]}, fly: {planar: [ground, ball]}}
surfaces:
  lobe: {cam: wheel, at: [0, 0.5], table: [[0, 1], [2, 1], [4, 1]]}
  skin: {sphere: ball, radius: 0.7}
  floor: {plane: ground, at: [0, -2], normal: [0, 1]}
contacts: {hit: {between: [skin, floor], stiffness: 1.0e+4}}
initial: {fly.x_rate: 6}
integrate: {step: 1.0e-3, until: 1}
output: {every: 0.01}
YAML
animate -o touch.html touch.yaml
ended "surfaces" 0 $? touch.html err
# reach NAME: how far the vertices of a thing reach on its body: least and most x, least and most y, to half a decimetre.
reach() { grep "\"name\":\"$1\"" touch.html | sed 's/.*"x":\[\([^]]*\)\].*/\1/' | tr , '\n' | awk '
    { k = (NR - 1) % 3; if (NR < 4 || $1 < low[k]) low[k] = $1; if (NR < 4 || $1 > high[k]) high[k] = $1 }
    END { for (k = 0; k < 2; k++) printf "%.1f %.1f ", low[k], high[k] }'; }
expect "surfaces: a ball" "-0.7 0.7 -0.7 0.7 " "$(reach skin)" err
expect "surfaces: a cam, beside its shaft" "-1.0 1.0 -0.5 1.5 " "$(reach lobe)" err
expect "surfaces: a floor under all that moves on it" "1 -2.0" "$(reach floor | awk '{ print ($1 < -1 && $2 > 10), $4 }')" err

refuse 2 "writes --output FILE.html, FILE.glb, FILE.pvd or FILE.svg" animate "$ROOT/decks/pendulum.yaml"
refuse 2 "writes --output FILE.html, FILE.glb, FILE.pvd or FILE.svg" animate -o p.avi "$ROOT/decks/pendulum.yaml"
refuse 6 "none/p.html" animate -o none/p.html "$ROOT/decks/pendulum.yaml"
animate -o stopped.html --max-time 1 --until 1e6 --every 1 "$ROOT/decks/pendulum.yaml"
expect "a run that is stopped is shown as far as it came" "7 yes" "$? $(grep -q '</html>' stopped.html && echo yes)" err

# A still: the ball of the pendulum is drawn last where it ends, and the picture is well-formed.
animate -o p.svg "$ROOT/decks/pendulum.yaml"
ended "a still" 0 $? p.svg err
animate -o s.svg "$ROOT/decks/bricard.yaml"
animate -o t.svg beam.yaml
expect "stills: five postures each, no number that is none" "5 5 5 0" \
    "$(grep -c '^<g ' p.svg) $(grep -c '^<g ' s.svg) $(grep -c '^<g ' t.svg) $(cat p.svg s.svg t.svg | grep -c 'nan\|inf')"

# glTF, read by a reader of its own.
animate --every 0.1 -o p.glb "$ROOT/decks/pendulum.yaml"
ended "glTF" 0 $? p.glb err
animate --every 0.01 -o beam.glb beam.yaml
animate -o s.glb "$ROOT/decks/suspension.yaml"
animate -o b.glb "$ROOT/decks/bricard.yaml"
if command -v python3 >/dev/null; then
    gltf() { python3 "$ROOT/tests/tools/gltf.py" "$@" 2>&1; }
    expect "glTF: a body and its joint" "2 2 rotation translation 101" "$(gltf p.glb)"
    expect "glTF: a beam has its coordinates as weights" "2 2 rotation translation weights 31" "$(gltf beam.glb)"
    expect "glTF: springs are stretched" "rotation scale translation" "$(gltf s.glb | cut -d ' ' -f 3-5)"
    expect "glTF: a mechanism in space" "rotation translation 501" "$(gltf b.glb | cut -d ' ' -f 3-5)"
    "$FMDSUB" run -q --every 0.1 -c 'ball.x,ball.y' "$ROOT/decks/pendulum.yaml" | sed 1d | cut -d , -f 2,3 | tr , '\n' >want
    gltf p.glb ball >got
    expect "glTF: a body stands where the records say" same "$(apart want got)"

    # Red runs from .05 to 1 with the stress: at the first vertex that at the root, at every instant.
    stressed='bodies.arm.stress={root: {station: 0, corner: top}, end: {station: 1, corner: top}}'
    animate --every 0.01 -s "$stressed" -o stress.glb beam.yaml
    expect "glTF: targets of colours beside those of modes" "2 2 rotation translation weights 31" "$(gltf stress.glb)"
    "$FMDSUB" run -q --every 0.01 -s "$stressed" -c arm.root.von_mises beam.yaml | awk -F , '
        NR > 1 { x[NR - 2] = $2; if ($2 > most) most = $2 } END { for (i = 0; i < NR - 1; i++) printf "%.6f\n", .05 + .95 * x[i] / most }' >want
    gltf stress.glb arm 0 >got
    expect "glTF: the colour at the root is its stress at each instant" "same 31" "$(apart want got) $(sort -u got | wc -l)" want got
else
    skip "glTF read back" "python3 is not installed"
fi

# Bodies are drawn as large as they are: a sphere of radius 0.3, a cylinder and a tube along z, a box.
cat >shapes.yaml <<'DECK'
fmdsub: 1
bodies:
  ball:  {at: [1, 0, 0], shape: {sphere: 0.3, density: 1000}}
  drum:  {at: [2, 0, 0], shape: {cylinder: [0.2, 0.8], density: 1000}}
  pipe:  {at: [3, 0, 0], shape: {tube: [0.25, 0.1, 0.6], density: 1000}}
  brick: {at: [4, 0, 0], shape: {box: [0.2, 0.4, 0.6], density: 1000}}
constraints:
  hang: {revolute: [ground, ball], at: [0, 0, 0], axis: [0, 1, 0]}
  knee: {spherical: [ball, drum], at: [1.5, 0, 0]}
  link: {universal: [drum, pipe], at: [2.5, 0, 0], axis: [0, 1, 0], axis2: [0, 0, 1]}
  rod:  {distance: [pipe, brick]}
forces:
  coil: {spring: [brick, [5, 0, 0]], stiffness: 10, damping: 0.1}
integrate: {scheme: midpoint, step: 1.0e-3, until: 0.1}
output: {every: 0.01, columns: [ball.x]}
DECK
"$FMDSUB" animate -q -o shapes.glb shapes.yaml 2>err
ended "shapes: status" 0 $? shapes.glb err
grep -ao '"min":\[[^]]*\],"max":\[[^]]*\]' shapes.glb | tr -c '0-9.e\n-' ' ' | awk '
    BEGIN { want["0.3 0.3 0.3"]; want["0.2 0.2 0.4"]; want["0.25 0.25 0.3"]; want["0.1 0.2 0.3"] }
    { gsub(/ e | n | x /, " "); n = split($0, x, " "); k = 0
      for (i = 1; i <= n; i++) if (x[i] ~ /[0-9]/) v[++k] = x[i] + 0
      if (k != 6) next
      for (i = 1; i <= 3; i++) if (v[i] + v[i + 3] > 1e-6 || v[i] + v[i + 3] < -1e-6) next
      found[sprintf("%.6g %.6g %.6g", v[4], v[5], v[6])] }
    END { for (w in want) if (!(w in found)) { print w; bad = 1 } exit bad }' >missing &&
    ok "shapes: sizes" || not_ok "shapes: sizes" "half sizes that are not there" missing
"$FMDSUB" animate -q -o shapes.html shapes.yaml 2>err
ended "shapes: a page" 0 $? shapes.html err

# What is drawn of two scenes, all of it, as it was when it was looked at: WRITE=1 writes what is drawn now.
for scene in plane space; do
    for ext in svg html glb pvd; do
        animate -q --every 0.1 -o $scene.$ext "$ROOT/tests/pictures/$scene.yaml"
        ended "$scene.$ext" 0 $? $scene.$ext err
    done
    sed -n '/^const D=/,/]};$/p' $scene.html >$scene.page
    cat $scene.pvd $scene.0002.vtu >$scene.view
    command -v python3 >/dev/null && python3 "$ROOT/tests/tools/gltf.py" $scene.glb '*' >$scene.gltf
    for file in $scene.svg $scene.page $scene.view $scene.gltf; do
        [ -f $file ] || { skip "$file as it was" "python3 is not installed"; continue; }
        [ -z "${WRITE:-}" ] || cp $file "$ROOT/tests/pictures/"
        apart=2e-6
        [ $file = $scene.svg ] && apart=0.15
        awk -v apart=$apart -f "$ROOT/tests/tools/alike.awk" "$ROOT/tests/pictures/$file" $file >differs && [ -s $file ] && ok "$file as it was" || not_ok "$file as it was" "differs" differs
    done
done

# Surfaces that touch have many vertices: kept are sums of them.
for scene in touch balls things; do
    for ext in svg html pvd; do
        animate -q --every 0.1 -o $scene.$ext "$ROOT/tests/pictures/$scene.yaml"
        ended "$scene.$ext" 0 $? $scene.$ext err
    done
    { sed -n '/^const D=/,/]};$/p' $scene.html; sed '/"/d' $scene.0002.vtu; } | awk -f "$ROOT/tests/tools/digest.awk" >$scene.sums
    for file in $scene.svg $scene.sums; do
        [ -z "${WRITE:-}" ] || cp $file "$ROOT/tests/pictures/"
        apart=1e-3
        [ $file = $scene.svg ] && apart=0.15
        awk -v apart=$apart -f "$ROOT/tests/tools/alike.awk" "$ROOT/tests/pictures/$file" $file >differs && [ -s $file ] && ok "$file as it was" || not_ok "$file as it was" "differs" differs
    done
done

# In a browser, where there is one: the page draws, and says no error.
[ "${BROWSER:-}" = none ] && exit 0
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome)
if [ -z "$browser" ]; then
    skip "in a browser" "none is installed (Debian: chromium)"
    exit 0
fi
timeout 120 "$browser" --headless=new --no-sandbox --disable-gpu --user-data-dir="$work/profile" --enable-logging=stderr --virtual-time-budget=2000 \
    --dump-dom "file://$work/beam.html#t=0.1" >dom 2>log
expect "in a browser: the time, a curve's value, no errors" "1 1 0" "$(grep -c 't = 0.1000 s' dom) $(grep -c 'arm.tip.y \[m\] = -0\.' dom) $(grep -c 'CONSOLE' log)" log
