# part-effects.sh -- effects that are left out where they do nothing leave the answers as they are.
#
# tests/effects/flat-*.yaml and the twins of tests/bench/effects: spatial scenes that stay in a plane, stepped there and, by
# `out_of_plane: true`, in space; every column but the steps' own and Euler's angles, which a plane leaves to a convention.
. tests/tools/lib.sh
need_program effects

cat >"$work/tol" <<'EOT'
energy.residual 1e-7 1e-6
step.* 10 10
*.euler* 10 10
*.roll 10 10
*.pitch 10 10
*.yaw 10 10
* 1e-8 1e-8
EOT

flat() { # NAME DECK [ARGUMENT...]
    name=$1 deck=$2
    shift 2
    "$FMDSUB" run --columns '*' "$@" "$deck" >"$work/plane.csv" 2>"$work/err"
    expect "$name runs" 0 $? "$work/err"
    grep -q 'spatial, in a plane' "$work/err"
    expect "$name is stepped in a plane" 0 $? "$work/err"
    "$FMDSUB" run --columns '*' "$@" --set effects.out_of_plane=true "$deck" >"$work/space.csv" 2>"$work/err"
    expect "$name runs in space" 0 $? "$work/err"
    grep -q 'spatial, in a plane' "$work/err"
    expect "$name is stepped in space" 1 $? "$work/err"
    "$COMPARE" --tol "$work/tol" "$work/space.csv" "$work/plane.csv" >"$work/out" 2>&1
    expect "$name says the same" 0 $? "$work/out"
}

for deck in tests/effects/flat-*.yaml tests/bench/effects/*-space.yaml; do
    name=${deck##*/}
    case $name in crank-*) continue ;; esac
    flat "${name%.yaml}" "$deck"
done
flat "driven by dopri5" tests/effects/flat-driven.yaml --set integrate.scheme=dopri5 --set integrate.tolerance=1e-9
flat "upright by generalized-alpha" tests/effects/flat-upright.yaml --set integrate.scheme=generalized-alpha
flat "upright at rest" tests/effects/flat-upright.yaml --set initial.static=true
flat "loops by newmark" tests/effects/flat-loops.yaml --set integrate.scheme=newmark

# On from a state, with the same bits.
"$FMDSUB" run -q --columns 't,hip.angle,bend,knee.fx' tests/effects/flat-upright.yaml >"$work/whole.csv" 2>"$work/err"
"$FMDSUB" run -q --columns 't,hip.angle' --until 1 --final-state "$work/state.json" tests/effects/flat-upright.yaml >"$work/first" 2>"$work/err"
sed 's/^initial:.*/initial: {from: state.json, time: keep}/' tests/effects/flat-upright.yaml >"$work/on.yaml"
"$FMDSUB" run -q --columns 't,hip.angle,bend,knee.fx' "$work/on.yaml" >"$work/on.csv" 2>"$work/err"
tail -n 5 "$work/whole.csv" >"$work/a"
tail -n 5 "$work/on.csv" >"$work/b"
same "a scene in a plane goes on from its state" "$work/a" "$work/b"

# Every spatial deck that is shipped leaves every plane.
for deck in decks/*.yaml; do
    "$FMDSUB" check --no-trial "$deck" 2>/dev/null | head -n 1 | grep -q 'spatial, in a plane'
    expect "${deck#decks/} is not taken for planar" 1 $?
done
