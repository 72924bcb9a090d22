# told.sh -- what a run says of keys that change nothing, and when it does not.
. tests/tools/lib.sh

cat >"$work/deck.yaml" <<'END'
fmdsub: 1
bodies:
  car: {mass: 1, at: [0, 0]}
  box: {mass: 1, at: [1, 0]}
constraints:
  rail: {prismatic: [ground, car], axis: [1, 0]}
  slot: {prismatic: [car, box], axis: [1, 0]}
forces:
  leaf: {spring: slot, stiffness: 100}
initial: {slot.displacement: 0.1}
integrate: {step: 1.0e-3, until: 0.1}
output: {every: 0.01}
END

# heard NAME WARNINGS ARGUMENT...: the words before the first "means" of every W-scheme, in order.
heard() {
    heard_name=$1 heard_want=$2
    shift 2
    "$FMDSUB" run -q "$@" "$work/deck.yaml" >"$work/out" 2>"$work/err" || {
        not_ok "$heard_name" "the run failed" "$work/err"
        return
    }
    [ -s "$work/out" ] || { not_ok "$heard_name" "no records"; return; }
    expect "$heard_name" "$heard_want" \
        "$(sed -n "s/.*warning: '\([a-z_]*\)' means nothing to scheme \([a-z0-9]*\): .*W-scheme.*/\1 \2/p" "$work/err" | tr '\n' ';')" \
        "$work/err"
}

# with SECTION: the deck has it for its own.
with() {
    sed "s|^integrate: .*|integrate: $1|" "$work/deck.yaml" >"$work/deck" && mv "$work/deck" "$work/deck.yaml"
}

with '{scheme: newmark, step: 1.0e-3, until: 0.1, ratio: 5, alpha: -0.1, tolerance: 1.0e-6, symmetric: true}'
heard "newmark reads no alpha; records fall on ratio * step" \
    "alpha newmark;symmetric newmark;"
heard "a scheme in place of the deck's passes over the deck's keys" "" --set integrate.scheme=midpoint
heard "but not over one given with it" "gamma midpoint;" --set integrate.scheme=midpoint --set integrate.gamma=0.5
heard "a key that would not go with another is not looked at" "gamma midpoint;" --set integrate.scheme=midpoint --set integrate.gamma=0.9
heard "a key given to the deck's scheme" "alpha newmark;symmetric newmark;" \
    --set integrate.ratio=10
with '{step: 1.0e-3, until: 0.1, beta: 0.25, gamma: 0.5, newton_tolerance: 1.0e-9}'
heard "the default scheme reads no beta" "beta subcycle;gamma subcycle;"
with '{scheme: rk4, step: 1.0e-3, until: 0.1, ratio: 1, rho_infinity: 1, symmetric: false, iteration: newton}'
heard "words that say what is done anyway are not told" "iteration rk4;"
with '{scheme: dopri5, tolerance: 1.0e-6, step: 1.0e-3, until: 0.1}'
heard "dopri5 chooses its steps" "step dopri5;"
sed '/^output:/d' "$work/deck.yaml" >"$work/deck" && mv "$work/deck" "$work/deck.yaml"
heard "but records fall on them" ""
with '{scheme: newmark, step: 1.0e-3, until: 0.1, beta: 0.3, gamma: 0.55, iteration: fixed-point, newton_tolerance: 1.0e-9}'
heard "newmark reads its own" ""
with '{scheme: midpoint, step: 1.0e-3, until: 0.1}'
echo 'partition: {fast: [slot]}' >>"$work/deck.yaml"
heard "one rate has no fast coordinates" "fast midpoint;"
heard "unless it is there to be compared" "" --set integrate.scheme=newmark
with '{scheme: subcycle, step: 1.0e-3, until: 0.1, ratio: 5, rho_infinity: 0.9, symmetric: true, newton_tolerance: 1.0e-9}'
heard "subcycle reads its own" ""
"$FMDSUB" study -q --schemes newmark,midpoint --steps 1.0e-3 --repeats 1 --set integrate.gamma=0.5 "$work/deck.yaml" >"$work/out" 2>"$work/err"
ended "a study compares: status" 0 $? "$work/out" "$work/err"
expect "a study compares: nothing told" "2 " "$(grep -c '^newmark\|^midpoint' "$work/out") $(grep W-scheme "$work/err")"
for deck in decks/*.yaml; do
    "$FMDSUB" check "$deck" >"$work/out" 2>&1
    grep -q W-scheme "$work/out" && echo "$deck: its scheme does not read what it says"
    grep -q '^records: ' "$work/out" || echo "$deck is not checked"
done >"$work/vain"
expect "shipped decks say nothing in vain" "" "$(cat "$work/vain")"

# In loops what is fast has a say in the start under any scheme, and that is told: a crank on a stiff key stands still, or turns.
cat >"$work/loop.yaml" <<'END'
fmdsub: 1
bodies:
  wheel:  {mass: 50, inertia: 5, at: [0, 0]}
  crank:  {mass: 0.5, inertia: 5.0e-3, at: [0.1, 0]}
  rod:    {mass: 1, inertia: 1/12, at: [0.7, 0]}
  piston: {mass: 0.5, inertia: 1.0e-2, at: [1.2, 0]}
constraints:
  shaft: {revolute: [ground, wheel], at: [0, 0]}
  key:   {revolute: [wheel, crank], at: [0, 0]}
  pin:   {revolute: [crank, rod], at: [0.2, 0]}
  bore:  {prismatic: [ground, piston], axis: [1, 0]}
  wrist: {revolute: [rod, piston], at: [1.2, 0]}
forces:
  stiff: {spring: key, stiffness: 2.0e+4}
initial: {shaft.angle_rate: 10}
partition: {fast: [key]}
integrate: {scheme: dop853, tolerance: 1.0e-4, until: 0.01}
output: {every: 0.01, columns: [key.angle_rate]}
END
"$FMDSUB" run -q "$work/loop.yaml" >"$work/out" 2>"$work/err"
expect "fast coordinates have a say in how a loop starts: told" "0 0,0 1" "$? $(sed -n 2p "$work/out") $(grep -c "'fast' means nothing to scheme dop853: .* neal-belytschko; in loops it still chooses what starts at 0, of what 'initial' does not set \[W-scheme\]" "$work/err")" "$work/err"


# Numbers that look like other units, and what is given for nothing.
cat >"$work/arm.yaml" <<'END'
fmdsub: 1
parameters: {length: 2}
bodies:
  hub: {mass: 1, inertia: 0.02, at: [0, 0], orient: 0.1}
  arm:
    beam: {from: [0, 0], to: [length, 0]}
    section: {rectangle: [0.02, 0.01]}
    material: {E: 70.0e+9, nu: 0.33, density: 2700}
constraints:
  shaft: {revolute: [ground, hub], at: [0, 0]}
  clamp: {fixed: [hub, arm], at: [0, 0]}
partition: {fast: [arm]}
integrate: {step: 1.0e-4, ratio: 5, until: 0.005}
END

# warned WORDS SET...: one warning, with these words; "": none.
warned() {
    warned_words=$1
    shift
    for warned_set; do
        set -- "$@" --set "$warned_set"
        shift
    done
    "$FMDSUB" run -q "$@" "$work/arm.yaml" >"$work/out" 2>"$work/err"
    warned_got="exit $? $(sed -n 's/.*warning: //p' "$work/err")"
    [ -s "$work/out" ] || warned_got="$warned_got, no records"
    case $warned_got in
    "exit 0 $warned_words"*) [ -n "$warned_words" ] || [ "$warned_got" = "exit 0 " ] && ok "told '$warned_words': $*" && return ;;
    esac
    not_ok "told '$warned_words': $*" "got '$warned_got'" "$work/err"
}
warned ""
warned "body 'arm': sound runs at 0.161 m/s through this material [W-units]" 'bodies.arm.material.E=70'
warned "body 'arm': sound runs at 5.09 m/s through this material [W-units]" 'bodies.arm.material.E=70.0e+3'
warned "body 'arm': sound runs at 1.61e+05 m/s through this material [W-units]" 'bodies.arm.material.density=2.7'
warned "body 'arm' is a beam of 2000 m [W-units]" 'parameters.length=2000'
warned "body 'arm': a section of about 20 m, the beam is 2 m long [W-units]" 'bodies.arm.section.rectangle=[10, 20]'
warned "an angle of 45 rad is 7.16 turns [W-units]" 'bodies.hub.orient=45'
warned "parameter 'lenght' is used nowhere [W-unused]" 'parameters.lenght=3'
warned "body 'hub': 'mass' and 'inertia' leave nothing for its shape to give [W-unused]" 'bodies.hub.shape={box: [0.1, 0.1, 0.1]}'
warned "no coordinate is fast: all of the deck takes steps of 0.0005 s [W-partition]" 'partition={}'
warned "" 'partition={}' 'integrate.ratio=1'
warned "'independent' means nothing without loops or drives [W-unused]" 'partition.independent=[shaft]'
warned "" 'partition.independent=[shaft]' 'constraints.far={distance: [[0, 1], arm.tip]}' 'bodies.arm.points.tip={station: 1}' 'integrate.ratio=1'
warned "all coordinates are fast: the ratio saves nothing [W-partition]" 'partition.fast=[shaft, arm]'

# No rest: blades of 80 m are pulled out by how fast they are turned, without end; told after 66 steps of 384 coordinates, which are 0.5 at the most.
sed 's/R: 0.45/R: 80.45/' tests/decks/airscrew-pull.yaml >"$work/pulled.yaml"
"$FMDSUB" check --no-trial "$work/pulled.yaml" >"$work/out" 2>"$work/err"
expect "no rest, many coordinates: status, how far" "4 yes" \
    "$? $(sed -n "s/.* the search has moved 'blade.*' by \([0-9.]*\) m or rad.*/\1/p" "$work/err" | awk '{ print ($1 > 0 && $1 <= 33 ? "yes" : $1) }')" "$work/err"

# Minor steps that are too long for what vibrates in them: the balance holds, and so it is told.
# resolve WHAT EXPECTED ARGUMENT...: exit status under --strict, warnings, the coordinate.
resolve() {
    resolve_what=$1 resolve_expected=$2
    shift 2
    "$FMDSUB" run -q --strict --set output.every=0.1 "$@" tests/bench/long-chain.yaml >"$work/out" 2>"$work/err"
    expect "W-resolve: $resolve_what" "$resolve_expected" \
        "$? $(grep -c 'W-resolve' "$work/err") $(sed -n "s/.*do not resolve '\([a-z0-9.]*\)', which vibrates.*/\1/p" "$work/err") $(wc -l <"$work/out" | tr -d ' ')" "$work/err"
}
resolve "omega h = 3" "1 1 pin42.angle 6" --set integrate.step=5e-3 --set integrate.ratio=2
resolve "of order 4" "1 1 pin42.angle 6" --set integrate.step=1e-2 --set integrate.ratio=5 --set integrate.order=4
resolve "resolved" "0 0  6"
resolve "at rest" "0 0  6" --set integrate.step=5e-3 --set integrate.ratio=2 --set parameters.pluck=0
resolve "taken out, which is told" "1 0  6" --set integrate.step=5e-3 --set integrate.ratio=2 --set integrate.rho_infinity=0.5
expect "W-damped: of a vibration that is taken out" 1 "$(grep -c "^warning: .* does not resolve 'pin42.angle' .*W-damped" "$work/err")" "$work/err"

# Where no step is found because a force jumps, that is said, and between what, whatever it reads.
for reads in gap_rate post.displacement_rate; do
    cat >"$work/deck.yaml" <<DECK
fmdsub: 1
bodies: {cart: {mass: 1, at: [1, 0]}, ball: {mass: 0.5, at: [1, 1]}}
constraints: {rail: {prismatic: [ground, cart], axis: [1, 0]}, post: {prismatic: [cart, ball], axis: [0, 1]}}
measures: {gap: {distance: [[0, 0], ball]}}
forces:
  rub: {force: gap, value: -800*sign($reads)}
  pull: {spring: rail, stiffness: 500, rest: 0.3}
  lift: {spring: post, stiffness: 300, rest: 0.2}
initial: {post.displacement_rate: 3}
integrate: {scheme: midpoint, step: 1.0e-2, until: 2}
output: {every: 0.1, columns: [gap]}
DECK
    "$FMDSUB" run -q "$work/deck.yaml" >"$work/out" 2>"$work/err"
    expect "a force that jumps with $reads" "5 1" "$? $(grep -Ec "force 'rub' jumps near here, between (-800 and 800|800 and -800):" "$work/err")" "$work/err"
done
