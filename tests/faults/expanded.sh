# expanded.sh -- what `fmdsub check --expanded` prints is a deck again: it stays as it is, and runs to the same bytes.
. tests/tools/lib.sh
cd "$work" || exit 1
cp -r "$ROOT"/decks/* .
# The long example of the manual: measures, tables, loads, a stay; and what ends a run.
awk '/^title: Crane/ { on = 1; print "fmdsub: 1" } on && /^\.Ed/ { exit } on { gsub(/\\&/, ""); gsub(/\\-/, "-"); print }' \
    "$ROOT/man/fmdsub-deck.5" >crane.yaml
sed 's/at: \[0, 0\]}/at: [0, 0], range: [-1, 1]}/; s/until: 3/until: {when: "height > 0 or t > 0.3", latest: 1}/' crane.yaml >ends.yaml
"$FMDSUB" run -q --until 0.02 --every-steps 10 --final-state start.json crane.yaml >out 2>err
ended "the example of the manual runs" 0 $? start.json err
sed '/^initial:/d' crane.yaml >goes-on.yaml
echo 'initial: {from: start.json, deck: any}' >>goes-on.yaml
# What is left out of contacts and stops that give way is not written as what rigid ones have.
cat >soft.yaml <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies: {b: {mass: 1, inertia: 1, at: [0, 1]}, c: {mass: 1, inertia: 1, at: [2, 0]}}
constraints: {f: {planar: [ground, b]}, g: {prismatic: [ground, c], axis: [0, 1], range: {lower: -0.5, hold: {stiffness: 1.0e+5}}}}
surfaces: {floor: {plane: ground, at: [0, 0], normal: [0, 1]}, skin: {sphere: b, radius: 0.1}}
contacts: {hit: {between: [skin, floor], stiffness: 1.0e+4, friction: {kinetic: 0.2}}}
integrate: {scheme: midpoint, step: 1.0e-3, until: 1}
END

for deck in *.yaml; do
    name=${deck%.yaml}
    rm -rf again
    mkdir again
    cp ./*.csv ./*.json again/ 2>/dev/null
    "$FMDSUB" check --expanded "$deck" >"again/$deck" 2>err || { not_ok "$name: expanded" "check fails" err; continue; }
    "$FMDSUB" check --expanded "again/$deck" 2>err | cmp -s - "again/$deck" && [ -s "again/$deck" ] && ok "$name: stays as it is" ||
        not_ok "$name: stays as it is" "it changed, or was refused" err
    for folder in . again; do "$FMDSUB" run -q --until 0.02 --every-steps 10 "$folder/$deck" >"$folder/$name.out" 2>err; done
    same "$name: runs the same" "$name.out" "again/$name.out"
done
