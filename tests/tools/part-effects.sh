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

for deck in tests/effects/flat-*.yaml decks/effect-plane.yaml tests/bench/effects/*-space.yaml; do
    name=${deck##*/}
    case $name in
    crank-*) set -- --set integrate.step=5.0e-6 --set integrate.until=0.01 ;;
    chain-* | flat-bent* | effect-plane*) set -- --set integrate.newton_tolerance=1.0e-12 ;; # what iterations leave grows
    *) set -- ;;
    esac
    flat "${name%.yaml}" "$deck" "$@"
done
flat "rotary inertia" tests/bench/effects/crank-space.yaml --set bodies.rod.beam.rotary=true --set integrate.step=5.0e-6 --set integrate.until=0.01 --set integrate.newton_tolerance=1e-13
flat "bent by dopri5" tests/effects/flat-bent.yaml --set integrate.scheme=dopri5 --set integrate.tolerance=1e-11 --until 0.1
flat "driven by dopri5" tests/effects/flat-driven.yaml --set integrate.scheme=dopri5 --set integrate.tolerance=1e-9
flat "upright by generalized-alpha" tests/effects/flat-upright.yaml --set integrate.scheme=generalized-alpha
flat "upright at rest" tests/effects/flat-upright.yaml --set initial.static=true
# Whole turns of angles on the way to rest, which the forces read.
for turns in "3 5 0 3" "7 2 3 0" "-8 9 7 3" "12 0 0 0"; do
    set -- $turns
    flat "wound to rest, $turns" tests/effects/flat-wound.yaml --set parameters.rest=$1 --set parameters.rest2=$2 --set parameters.from=$3 --set parameters.from2=$4
done
# And in a scene that is in no plane, by the moments there: coils hold the arms' weight, bend is within 0.1 rad of the coil's rest.
for rest in 4 12 -8; do
    "$FMDSUB" run -q --until 0.02 --set 'constraints.knee.axis=[0.001, -1, 0]' --set parameters.rest=$rest --columns 't,bend,coil.force,hip.angle_rate' tests/effects/flat-wound.yaml >"$work/wound" 2>"$work/err"
    expect "wound to rest in space, $rest: stands" "0 stands" "$? $(awk -F, -v rest=$rest 'NR > 1 { d = $2 - rest; if (d > .1 || d < -.1 || $3 > 6 || $3 < -6 || $4 > 1e-6 || $4 < -1e-6) bad = 1 } END { print bad || NR < 2 ? "moves" : "stands" }' "$work/wound")" "$work/wound" "$work/err"
done
flat "loops by newmark" tests/effects/flat-loops.yaml --set integrate.scheme=newmark --set integrate.newton_tolerance=1.0e-12
flat "slides, assembled" tests/effects/flat-slides.yaml --set initial.assemble=true

# On from a state, with the same bits.
"$FMDSUB" run -q --columns 't,hip.angle,bend,knee.fx' tests/effects/flat-upright.yaml >"$work/whole.csv" 2>"$work/err"
"$FMDSUB" run -q --columns 't,hip.angle' --until 1 --final-state "$work/state.json" tests/effects/flat-upright.yaml >"$work/first" 2>"$work/err"
sed 's/^initial:.*/initial: {from: state.json, time: keep}/' tests/effects/flat-upright.yaml >"$work/on.yaml"
"$FMDSUB" run -q --columns 't,hip.angle,bend,knee.fx' "$work/on.yaml" >"$work/on.csv" 2>"$work/err"
tail -n 5 "$work/whole.csv" >"$work/a"
tail -n 5 "$work/on.csv" >"$work/b"
same "a scene in a plane goes on from its state" "$work/a" "$work/b"

# Modes out of the plane stay where something moves or reads them, where a body is beside the plane, or leans.
bent() { # NAME SED: the deck so changed is stepped in space
    sed "$2" tests/effects/flat-bent.yaml >"$work/bent.yaml"
    cmp -s tests/effects/flat-bent.yaml "$work/bent.yaml"
    expect "$1: another deck" 1 $?
    "$FMDSUB" run --until 0.001 "$work/bent.yaml" >"$work/out" 2>"$work/err"
    expect "$1 runs" 0 $? "$work/err"
    grep -q 'spatial, in a plane' "$work/err"
    expect "$1 is stepped in space" 1 $?
}
bent "gravity across" 's/^gravity: .*/gravity: [0, 0.1, -9.81]/'
bent "a load across" 's/0, 0\]}/1, 0]}/'
bent "a body beside the plane" 's/at: \[1.7, 0, 0.6\]/at: [1.7, 0.01, 0.6]/'
bent "a body that leans" 's/inertia: \[1.0e-3, 2.0e-3, 3.0e-3\]/inertia: [1.0e-3, 2.0e-3, 2.0e-3, 1.0e-4, 0, 0]/'
bent "a mode that begins bent" 's/angle_rate: 1.5}/angle_rate: 1.5, one.mode2: 1.0e-6}/'
bent "a load that reads a mode" 's/3\*sin(5\*t)/3*sin(5*t) + one.mode2/'

# Beyond P = 4.013 sqrt(EIy GJ)/L^2 = 9.14 N the strip buckles sideways (Timoshenko & Gere, Theory of Elastic Stability, 6.4); as
# the plane cannot show it, it is told, and below nothing is.
"$FMDSUB" run -q tests/effects/lateral.yaml >"$work/out" 2>"$work/err"
expect "a strip that buckles sideways runs" 0 $? "$work/err"
t=$(sed -n 's/.*does not stand there behind t = \([0-9.]*\) s.*W-effect.*/\1/p' "$work/err")
awk -v t="${t:-0}" 'BEGIN { exit !(t > 8.9 && t < 9.5) }'
expect "it is told from its buckling load on" 0 $? "$work/err"
expect "and of which body" 1 "$(grep -c "'$(sed -n '/^bodies:/{n;s/^ *\([a-z]*\):.*/\1/p;}' tests/effects/lateral.yaml)'.*W-effect" "$work/err")" "$work/err"
"$FMDSUB" run --strict -q tests/effects/lateral.yaml >"$work/out" 2>"$work/err"
expect "and ends with 1 by --strict" 1 $? "$work/err"
"$FMDSUB" run --strict -q --until 8.8 tests/effects/lateral.yaml >"$work/out" 2>"$work/err"
expect "below it nothing is told" 0 $? "$work/err"

# Every spatial deck that is shipped leaves every plane, but for the one that shows this.
for deck in decks/*.yaml; do
    [ "$deck" = decks/effect-plane.yaml ] && continue
    "$FMDSUB" check --no-trial "$deck" 2>/dev/null | head -n 1 | grep -q 'spatial, in a plane'
    expect "${deck#decks/} is not taken for planar" 1 $?
done

# Bytes of a scene do not grow by what is off; its watches stand beside.
bytes() { # DECK EFFECT STATE: taken, used
    "$FMDSUB" run -q --until 0.01 --stats -s "effects.$2=$3" "$1" 2>&1 >"$work/out" |
        awk '{ x[$1] = $2 } END { print x["bytes_taken"] + 0, x["bytes_used"] + 0 }'
}
for deck in pendulum heavy-top four-bar cantilever rotating-blade flexible-crank floating-satellite; do
    for effect in gravity gyroscopic stiffening rotary shear damping momentum ledger; do
        more=$(echo "$(bytes decks/$deck.yaml $effect auto) $(bytes decks/$deck.yaml $effect false)" |
            awk '{ print ($1 > 0 && $3 <= $1 && $4 <= 1.01 * $2) ? "no more" : $0 }')
        expect "$deck without $effect: bytes" "no more" "$more"
    done
done
for deck in tests/bench/effects/*-space.yaml; do
    expect "${deck##*/} in a plane: bytes taken" "no more" "$(echo "$(bytes $deck out_of_plane true) $(bytes $deck out_of_plane auto)" |
        awk '{ print ($1 > 0 && $3 <= $1) ? "no more" : $0 }')"
done

# explain DECK: what decides, what turning it costs and changes.
"$FMDSUB" explain --format json decks/floating-satellite.yaml >"$work/told" 2>"$work/err"
expect "explain tells of a deck" 0 $? "$work/err"
tr -d '\n\t ' <"$work/told" >"$work/flat"
for want in '"effect":"out_of_plane","state":"on"' '"effect":"momentum","state":"on"' '"effect":"gravity","state":"absent"' \
    '"effect":"ledger","state":"off"'; do
    grep -qF "$want" "$work/flat"
    expect "explain: $want" 0 $? "$work/told"
done
# A body from a file, its stiffening off, is the same body from a file that has none.
"$FMDSUB" run -q --set effects.stiffening=false --columns slider.x,slider.vx tests/decks/crank-stiffened.yaml >"$work/off.csv" 2>"$work/err"
"$FMDSUB" run -q --set integrate.tolerance=1.0e-9 --columns slider.x,slider.vx tests/decks/crank-consistent.yaml >"$work/none.csv" 2>>"$work/err"
"$FMDSUB" run -q --columns slider.x,slider.vx tests/decks/crank-stiffened.yaml >"$work/on.csv" 2>>"$work/err"
"$FMDSUB" diff -q --rel 1.0e-8 "$work/off.csv" "$work/none.csv" >"$work/out" 2>&1
expect "a body from a file without its stiffening: as from one without any" "0 11" "$? $(($(wc -l <"$work/off.csv") - 1))" "$work/out" "$work/err"
"$FMDSUB" diff -q --rel 1.0e-3 "$work/off.csv" "$work/on.csv" >"$work/out" 2>&1
expect "which is another one than with it" 1 $? "$work/out" "$work/err"
# Stiffening off changes the satellite as a run by hand says.
"$FMDSUB" run -q decks/floating-satellite.yaml >"$work/on.csv" 2>"$work/err"
"$FMDSUB" run -q --set effects.stiffening=false decks/floating-satellite.yaml >"$work/off.csv" 2>"$work/err"
awk -F, 'NR == FNR { for (i = 1; i <= NF; i++) on[FNR, i] = $i; next }
    FNR == 1 { for (i = 1; i <= NF; i++) name[i] = $i; next }
    { for (i = 2; i <= NF; i++) {
        d = $i - on[FNR, i]; if (d < 0) d = -d; if (d > change[i]) change[i] = d
        x = on[FNR, i] + 0; if (x < 0) x = -x; if (x > most[i]) most[i] = x } }
    END { for (i in name) if (name[i] !~ /^energy.residual/ && most[i] > 0 && change[i] / most[i] > worst) worst = change[i] / most[i]
          printf "%.4g\n", worst }' "$work/on.csv" "$work/off.csv" >"$work/hand"
sed -n 's/.*"effect":"stiffening"[^}]*"change_if_turned":\([0-9.e-]*\).*/\1/p' "$work/flat" | awk '{ printf "%.4g\n", $1 }' >"$work/said"
same "explain says what stiffening changes" "$work/hand" "$work/said"
# What it costs is what explain says of the deck with it turned, per second of the run.
for case in ledger,true stiffening,false rotary,false shear,true; do
    effect=${case%,*}
    for deck in "" "-s effects.$effect=${case#*,}"; do "$FMDSUB" explain --format json $deck decks/rotor.yaml 2>"$work/err" | tr -d '\n\t '; echo; done >"$work/flat"
    sed 's/.*"instructions_per_step":\([0-9.e+]*\).*"effect":"'$effect'"[^}]*"cost_if_turned":\([0-9.e-]*\).*/\1 \2/' "$work/flat" |
        awk 'NR == 1 { was = $1; said = $2 } NR == 2 { cost = $1 / was - 1; d = cost - said; printf "%g %g\n", said, cost; exit !(said != 0 && d * d < 1e-18) }' >"$work/hand"
    expect "explain: what turning $effect costs" 0 $? "$work/hand" "$work/err"
done
# What the deck turns off is watched by run; a body's own key is turned, too, and the number tells.
"$FMDSUB" explain decks/flexible-crank.yaml >"$work/told" 2>"$work/err"
expect "explain: off by a body's key, watched" 1 "$(grep -c '^rotary *watched by the deck' "$work/told")" "$work/told"
expect "explain: and what turning it on changes" 1 "$(sed -n '/^rotary/{n;p;}' "$work/told" | grep -c "turned on: .* changes by [0-9]")" "$work/told"
# 4.65 h^2/12 of a rectangle of 0.01 m, 1 m long; a tenth of a percent less by the mesh, if any.
"$FMDSUB" explain decks/cantilever.yaml >"$work/told" 2>"$work/err"
expect "explain: 4.65 I/(A l^2)" 1 "$(grep -c '^rotary *on *by default *4.65 I/(A l^2) up to 3.8[78]e-05' "$work/told")" "$work/told"
# Shear is in beams that give its factors or ask for it: elsewhere it is off, and turning it on tells what it is worth.
expect "explain: no shear without factors" "off by default: changes" \
    "$(sed -n '/^shear/{N;s/^shear *\([a-z]*\) *\(by [a-z]*\) .*turned on: .* \(changes\) by [0-9].*/\1 \2: \3/p;}' "$work/told")" "$work/told"
"$FMDSUB" explain -s bodies.arm.beam.shear=true decks/cantilever.yaml >"$work/told" 2>"$work/err"
expect "explain: shear by a beam's own key" 1 "$(grep -c '^shear *on ' "$work/told")" "$work/told"
# The numbers of shear and rotary inertia stand where these are off, too: a bar of h = 0.01, l = 1, nu = 0.3, with Cowper's factor.
closed=$(awk 'BEGIN { r = .01 ^ 2 / 12; kappa = 10 * 1.3 / (12 + 11 * .3); printf "%.3g %.3g", 4.65 * r, 3 * 2 * 1.3 / kappa * r }')
"$FMDSUB" explain -s effects.rotary=false decks/cantilever.yaml >"$work/told" 2>"$work/err"
expect "explain: rotary and shear off, their numbers" "watched 4.65 I/(A l^2) up to ${closed% *}; off 3 E I/(kappa G A l^2) up to ${closed#* }" \
    "$(sed -n 's/^rotary *\([a-z]*\) *by the deck *\(4.65.*\)/\1 \2/p' "$work/told"); $(sed -n 's/^shear *\([a-z]*\) *by default *\(3 E[^;]*\).*/\1 \2/p' "$work/told")" "$work/told"
# Of a body from a file by its tensor, the largest of it about an axis, and the node that is farthest from its reference node: 4.65 *
# 0.03/(2 (2^2 + 1.5^2 + 2.75^2)); nodes before and behind it are nearer.
cat >"$work/lump.json" <<'END'
{"fmdsub_flex": 1, "modes": 1, "reference": 1, "at": [0, 0, 0], "mass": 2, "xx": [4, 0, 0, 0, 4, 0, 0, 0, 4],
"rot": [0.01, 0, 0, 0, 0.03, 0, 0, 0, 0.02], "f": [0, 0, 0], "xf": [0, 0, 0, 0, 0, 0, 0, 0, 0], "ff": [1, 0, 0, 0, 1, 0, 0, 0, 1],
"rpsi": [0, 0, 0], "ppsi": [0], "K": [900], "stresses": [],
"nodes": [{"name": "tip", "x": [1, 2, 3], "phi": [0, 1, 0], "psi": [0, 0, 0]},
{"name": "root", "x": [-1, 0.5, 0.25], "phi": [0, 0, 0], "psi": [0, 0, 0]}, {"name": "knee", "x": [0, 0, 0], "phi": [0, 0, 1], "psi": [0, 0, 0]}]}
END
cat >"$work/lump.yaml" <<'END'
fmdsub: 1
bodies: {lump: {flexible: lump.json, at: [0, 0, 0]}}
constraints: {pin: {revolute: [ground, lump], at: [-1, 0.5, 0.25], axis: [0, 0, 1]}}
integrate: {scheme: newmark, step: 0.001, until: 0.01}
END
"$FMDSUB" explain "$work/lump.yaml" >"$work/told" 2>"$work/err"
expect "explain: 4.65 I/(A l^2) of a body from a file" "$(awk 'BEGIN { printf "up to %.3g", 4.65 * .03 / 2 / (4 + 1.5 ^ 2 + 2.75 ^ 2) }')" \
    "$(sed -n 's/^rotary .*\(up to .*\)/\1/p' "$work/told")" "$work/told" "$work/err"
"$FMDSUB" explain -s bodies.arm.beam.shear=true decks/cantilever.yaml >"$work/told" 2>"$work/err"
expect "explain: shear on, the same number" "on ${closed#* }" "$(sed -n 's/^shear *\([a-z]*\) .*up to \(.*\)/\1 \2/p' "$work/told")" "$work/told"
# With `scheme: auto` both runs are by what it chose for the deck, a relay, or for a short run a scheme that has a name: then the same costs
# and changes as where the deck says that itself.
"$FMDSUB" explain --format json -s 'integrate={scheme: auto, tolerance: 1e-4, until: 1}' decks/spring-pendulum.yaml >"$work/auto" 2>"$work/err"
expect "explain: with scheme: auto, effects that cost something" yes "$(grep -q 'cost_if_turned":.*-0\.[0-9]' "$work/auto" && echo yes)" "$work/auto" "$work/err"
"$FMDSUB" explain --format json -s 'integrate={scheme: auto, tolerance: 1e-4, until: 0.05}' decks/spring-pendulum.yaml >"$work/auto" 2>"$work/err"
scheme=$("$FMDSUB" run -s 'integrate={scheme: auto, tolerance: 1e-4, until: 0.05}' decks/spring-pendulum.yaml 2>&1 >"$work/out" | sed -n 's/^auto: \([a-z0-9]*\) to tolerance 0.0001, .*/\1/p')
"$FMDSUB" explain --format json -s "integrate={scheme: ${scheme:-none}, tolerance: 1e-4, until: 0.05}" decks/spring-pendulum.yaml >"$work/told" 2>>"$work/err"
same "explain: with scheme: auto as with the scheme that it takes" "$work/told" "$work/auto"
# Modes that were chosen are told as check tells them.
"$FMDSUB" explain -s bodies.arm.modes=auto decks/effect-modes.yaml 2>"$work/err" | sed -n '/^arm$/,$p' >"$work/told"
"$FMDSUB" check --no-trial -s bodies.arm.modes=auto decks/effect-modes.yaml 2>>"$work/err" | sed -n '/^  *modes: auto/,/^mass/p' | sed '$d' >"$work/hand"
expect "explain: of whose modes" "arm yes" "$(sed -n 1p "$work/told") $(grep -q ' Hz .*kept, share' "$work/hand" && echo yes)" "$work/err"
sed 1d "$work/told" | sed 's/^ *//' | grep ' Hz ' >"$work/modes"
sed 's/^ *//' "$work/hand" | grep ' Hz ' >"$work/wanted"
same "explain: modes that were chosen, as check says" "$work/wanted" "$work/modes"
"$FMDSUB" explain --format json -s bodies.arm.modes=auto decks/effect-modes.yaml 2>"$work/err" | sed -n '/"modes":.*{$/,$p' >"$work/told"
expect "explain: modes that were chosen, as JSON" "arm $(grep -c ' kept,' "$work/modes") $(grep -c . "$work/modes")" \
    "$(sed -n '2s/^.*"\(.*\)":.*/\1/p' "$work/told") $(grep -c '"kept":.*true' "$work/told") $(grep -c '"hertz"' "$work/told")" "$work/err"
"$FMDSUB" explain --format json decks/cantilever.yaml >"$work/told" 2>"$work/err"
expect "explain: instructions of a step" yes "$(awk '/"instructions_per_step"/ { gsub(",", ""); print ($2 > 3000 && $2 < 300000) ? "yes" : "no" }' "$work/told")" "$work/told"
"$FMDSUB" explain -s effects.gravity=false decks/pendulum.yaml >"$work/told" 2>"$work/err"
expect "explain: changes are of the run with the effect" "gravity watched: 1e+02 or 2e+02" \
    "$(sed -n '/^gravity/{N;s/^gravity *\([a-z]*\) .* changes by \([0-9.e+]*\) %.*/gravity \1: \2/;s/: [12]e+02$/: 1e+02 or 2e+02/p;}' "$work/told")" "$work/told"
# From standard input, which is read once.
"$FMDSUB" explain decks/effect-gyroscopic.yaml | sed 1d >"$work/hand"
"$FMDSUB" explain - <decks/effect-gyroscopic.yaml 2>"$work/err" | sed 1d >"$work/said"
same "explain of standard input says the same" "$work/hand" "$work/said"
"$FMDSUB" explain E-tab >"$work/out" 2>"$work/err"
expect "explain CODE stays" 0 $? "$work/err"
"$FMDSUB" explain --format json E-tab >"$work/out" 2>"$work/err"
expect "explain CODE has no form" 2 $? "$work/err"
# A column at rest next to others of its unit: round-off in space, 0 in the plane, is no change.
"$FMDSUB" explain --format json -s 'output.columns=[table.angle, shaft.angle]' tests/effects/flat-slides.yaml >"$work/told" 2>"$work/err"
tr -d '\n\t ' <"$work/told" | sed 's/.*"effect":"out_of_plane"[^}]*"change_if_turned":\([^,]*\),.*/\1/' >"$work/change"
expect "explain: round-off is no change" "small" "$(awk '{ print ($1 != "null" && $1 + 0 < 1e-5) ? "small" : $1 }' "$work/change")" "$work/told"
# Runs that end by what happens are compared at the instants of both; where that is the start alone, nothing is known.
"$FMDSUB" explain --format json -s 'integrate.until={when: "shaft.angle > 0.05", latest: 1}' -s output.every=0.25 -s 'output.columns=[shaft.angle]' \
    tests/effects/flat-slides.yaml >"$work/told" 2>"$work/err"
tr -d '\n\t ' <"$work/told" | sed 's/.*"effect":"gravity"[^}]*"change_if_turned":\([^,]*\),.*/\1/' >"$work/change"
expect "explain: at the instants of both" "null" "$(cat "$work/change")" "$work/told"
