# warnings.sh -- what a deck may say but hardly means: one warning, with its place and code; --strict makes it status 1.
. tests/tools/lib.sh
cd "$work" || exit 1

plane='fmdsub: 1
gravity: [0, -9.81]
bodies: {arm: {mass: 1, inertia: 0.1, at: [1, 0]}}
constraints: {pin: {revolute: [ground, arm], at: [0, 0]}}
integrate: {scheme: midpoint, step: 1.0e-3, until: 0.01}'
space='fmdsub: 1
bodies: {top: {mass: 8, shape: {box: [0.1, 0.1, 0.1]}, at: [0, 0, 0]}}
constraints: {ball: {spherical: [ground, top], at: [0, 0, 0]}}
initial: {ball.omega: [1, 2, 3]}
integrate: {scheme: midpoint, step: 1.0e-3, until: 0.01}'

warned() { # NAME DECK PATTERN [SET [SET [SET]]]: status 0, one warning, 1 with --strict
    echo "$2" >deck.yaml
    "$FMDSUB" run -q -s "${6:-title=x}" -s "${4:-title=x}" -s "${5:-title=x}" deck.yaml >out 2>err
    rc=$?
    "$FMDSUB" run -q --strict -s "${6:-title=x}" -s "${4:-title=x}" -s "${5:-title=x}" deck.yaml >out 2>strict
    if [ "$rc $?" = "0 1" ] && [ "$(grep -c ': warning: ' err)" = 1 ] && grep -q -- "$3" err; then ok "$1"
    else not_ok "$1" "status $rc; expected 0, 1 with --strict, and one warning with: $3" err strict; fi
}
silent() { # NAME DECK [SET [SET [SET]]]
    echo "$2" >deck.yaml
    "$FMDSUB" run -q --strict -s "${5:-title=x}" -s "${3:-title=x}" -s "${4:-title=x}" deck.yaml >out 2>err
    expect "$1" "0 0 records" "$? $(wc -l <err) $([ -s out ] && echo records)" err
}

silent "nothing to warn of, planar" "$plane"
pulse() { printf '%s\nforces: {hit: {torque: pin, value: %s}}' "$plane" "$1"; }
warned "a pulse within a step" "$(pulse '"if(t > 0.0041 and t < 0.0048, 600, 0)"')" "^deck.yaml:6:36: warning: 'hit' changes at t = 0.0041 s and at 0.0048 s, within one step of 0.001 s.*\[W-pulse\]"
warned "one that begins with a step" "$(pulse '"if(t > 0.004 and t < 0.0048, 600, 0)"')" W-pulse
warned "a table that comes and goes within a step" "$(pulse '{table: [[0, 0], [0.0041, 0], [0.0042, 600], [0.0048, 0], [0.02, 0]]}')" W-pulse
silent "a pulse of one step" "$(pulse '"if(t > 0.004 and t < 0.005, 600, 0)"')"
silent "a pulse over the end of a step" "$(pulse '"if(t > 0.0045 and t < 0.0053, 600, 0)"')"
silent "a pulse and a tolerance" "$(pulse '"if(t > 0.0041 and t < 0.0048, 600, 0)"')" integrate.tolerance=1e-6
silent "a fine table that goes on" "$(pulse '{table: [[0, 0], [0.0041, 41], [0.0042, 42], [0.0048, 48], [0.02, 200]]}')"
# Smooth ones, of which the ends of steps show next to nothing; found in a hundred thousand steps as well.
warned "a smooth pulse within a step" "$(pulse '"600*exp(-((t - 0.0045)/1.0e-4)^2)"')" "^deck.yaml:6:36: warning: 'hit' is 600 at t = 0.0045 s, but 8.*e-09 and 8.*e-09 at the ends of its step, 0.004 and 0.005 s.*\[W-pulse\]"
warned "a narrow bell beside a vibration" "$(pulse '"sin(100*t) + 50*exp(-((t - 0.00431)/1.0e-6)^2)"')" W-pulse
warned "a bell far away" "$(pulse '"600/(1 + ((t - 87.6543)/1.0e-5)^2)"')" "is 5.* at t = 87.65.* within\|is [1-6].* at t = 87.65.*W-pulse" integrate.until=100 output.every=50
warned "a vibration of less than three steps" "$(pulse '"0.01*sin(3000*t)"')" W-pulse
silent "a bell over some steps" "$(pulse '"600*exp(-((t - 0.0105)/1.0e-3)^2)"')" integrate.scheme=midpoint
silent "a vibration of six steps" "$(pulse '"0.01*sin(1000*t)"')" integrate.scheme=midpoint
silent "a long wave" "$(pulse '"0.01*sin(t)*exp(-t)"')" integrate.until=100 output.every=50
silent "a power" "$(pulse '"0.01*t^3 - t"')"
silent "a smooth pulse that is asked for" "$(pulse '"600*exp(-((t - 0.0045)/1.0e-4)^2)"')" integrate.step=5.0e-5
silent "nothing to warn of, spatial" "$space"
warned "gravity in mm/s2" "$plane" "^--set:1:9: warning: gravity of 9810 m/s2 is 1e+03 times that of the earth \[W-units\]" 'gravity=[0, -9810]'
silent "gravity of the sun" "$plane" 'gravity=[0, -274]'
warned "degrees" "$plane" "^--set:1:21: warning: an angle of 45 rad is 7.16 turns \[W-units\]" 'initial={pin.angle: 45}'
silent "one turn" "$plane" 'initial={pin.angle: -2*pi}'
silent "a rate is no angle" "$plane" 'initial={pin.angle_rate: 45}'
warned "a box in mm" "$space" "warning: body 'top' has a density of 8e-06 kg/m3 \[W-units\]" 'bodies.top.shape.box=[100, 100, 100]'
warned "a density in kg/mm3" "$(echo "$space" | sed 's/mass: 8, //; s/0.1]}/0.1], density: 7.85e-6}/')" "density of 7.85e-06"
silent "the densest" "$space" 'bodies.top.mass=22.5'
echo "$plane" | sed '/constraints/d' >free.yaml
warned "a body that nothing holds" "$(cat free.yaml)" "W-unconnected"
silent "a body that may stand on something" "$(cat free.yaml; echo 'surfaces: {foot: {point: arm}}')"
beam='fmdsub: 1
bodies:
  arm: {beam: {from: [0, 0], to: [2, 0]}, section: {rectangle: [0.02, 0.01]}, material: steel, modes: 2}
constraints: {pin: {revolute: [ground, arm], at: [0, 0]}}
integrate: {scheme: midpoint, step: 1.0e-3, until: 0.01}'
silent "nothing to warn of, a beam" "$beam"
silent "a joint beside the beam's axis" "$beam" 'constraints.pin.at=[0, 0.19]'
warned "a joint far from the beam's axis" "$beam" "^deck.yaml:4:15: warning: a place 0.5 m from the axis of beam 'arm': the section at station 0 .* \[W-offset\]" 'constraints.pin.at=[-0.5, 0]'
warned "a place that is used thrice, once" "$(echo "$beam" | sed 's/modes: 2/&, points: {p: {station: 0.5, offset: [0, 0.3]}}/')
measures: {d: {distance: [arm.p, [1, 2]]}}
forces: {f: {force: arm.p, value: [0, 1]}}" "a place 0.3 m from the axis of beam 'arm': the section at station 0.5 .* \[W-offset\]"
stocky=$(echo "$beam" | sed 's/0.02, 0.01/0.02, 0.4/')
warned "a stocky beam without shear" "$stocky" "^deck.yaml:3:[0-9]*: warning: body 'arm': shear, which is off, would add 3.1 % to how a force at its end bends it \[W-shear\]"
warned "a stocky one in segments, once" "$(echo "$stocky" | sed 's/modes: 2/modes: 1, segments: 3/; s/ground, arm/ground, arm1/')" W-shear
silent "a stocky beam with shear" "$stocky" bodies.arm.beam.shear=true
silent "one that is not to have it" "$stocky" bodies.arm.beam.shear=false
silent "one in a scene with shear" "$stocky" 'effects={shear: true}'
panel=$(echo "$beam" | sed 's/\[0, 0\], to: \[2, 0\]/[0, 0, 0], to: [2, 0, 0]/; s/at: \[0, 0\]/at: [0, 0, 0], axis: [0, 0, 1]/')
warned "one in space, stocky across both" "$panel" W-shear 'bodies.arm.section.rectangle=[0.4, 0.4]'
silent "a panel, stocky across its width alone" "$panel" 'bodies.arm.section.rectangle=[0.4, 0.01]'
silent "a slender beam" "$beam" 'bodies.arm.section.rectangle=[0.02, 0.3]'
warned "a beam that does not stiffen and may turn" "$beam" "^--set:1:23: warning: body 'arm': linear beam buckles from Omega = [0-9.]* rad/s; turn on geometric stiffening \[W-stiffening\]" 'bodies.arm.stiffening=false'
warned "a beam that does not stiffen, clamped" "$(echo "$beam" | sed 's/revolute/fixed/')" "loads along the beam will not stiffen or soften it \[W-stiffening\]" 'bodies.arm.stiffening=false'
warned "in segments it is said once" "$(echo "$beam" | sed 's/modes: 2/modes: 1, segments: 3/; s/ground, arm/ground, arm1/')" "body 'arm': linear beam buckles" 'bodies.arm.stiffening=false'
warned "a beam's density in kg/mm3" "$beam" "density of 7.85e-06 kg/m3" 'bodies.arm.material={E: 2.1e+5, density: 7.85e-6}'
runner='fmdsub: 1
bodies:
  arm: {beam: {from: [0, 0], to: [2, 0]}, section: {rectangle: [0.02, 0.01]}, material: steel, modes: 2}
  box: {mass: 0.1, inertia: 0.001, at: [0.5, 0]}
constraints:
  root: {fixed: [ground, arm], at: [0, 0]}
  rail: {prismatic: [arm, box], at: [0.5, 0], axis: [1, 0]}
integrate: {scheme: midpoint, step: 1.0e-3, until: 0.01}'
warned "what runs along a beam" "$runner" "^deck.yaml:7:3: warning: joint 'rail' slides along beam 'arm', but on a straight line of its section at station 0.25 \[W-slide\]"
warned "a pin in its slot" "$runner" "joint 'slot' slides along beam 'arm'" 'constraints.rail={free: [ground, box]}' 'constraints.slot={point-on-line: [arm, box], at: [0.5, 0], axis: [1, 1]}'
silent "what slides across a beam" "$runner" 'constraints.rail.axis=[0, 1]'
silent "a beam that slides" "$runner" 'constraints.root={fixed: [ground, box]}' 'constraints.rail={prismatic: [box, arm], at: [0.5, 0], axis: [1, 0]}'
silent "a pin that is free to go anywhere" "$runner" 'constraints.rail={planar: [arm, box]}'
driven='fmdsub: 1
bodies:
  arm: {mass: 1, inertia: 1, at: [1, 0]}
  tip: {mass: 1, inertia: 0.01, at: [2, 0]}
constraints: {hub: {revolute: [ground, arm], at: [0, 0]}, leaf: {revolute: [arm, tip], at: [2, 0]}}
forces: {spring: {spring: leaf, stiffness: 100}}
drives: {turn: {drive: hub, value: t^2}}
partition: {fast: [leaf]}
integrate: {scheme: subcycle, step: 1.0e-3, ratio: 10, until: 0.1}'
silent "a drive that the slow step resolves" "$driven"
warned "a drive that it does not" "$driven" "^deck.yaml:7:10: warning: drive 'turn' turns too quickly .* \[W-drive\]" 'drives.turn.value=0.1*sin(300*t)'
silent "one rate, and no warning of two" "$driven" 'drives.turn.value=0.01*sin(50*t)' 'integrate.ratio=1'
shaft='fmdsub: 1
bodies:
  shaft: {beam: {from: [0, 0, 0], to: [1, 0, 0]}, section: {circle: 0.01}, material: steel, modes: 4}
constraints: {root: {fixed: [ground, shaft], at: [0, 0, 0]}}
integrate: {scheme: midpoint, step: 1.0e-4, until: 1.0e-3}'
silent "whole pairs of a round shaft's modes" "$shaft"
warned "half a pair" "$shaft" "body 'shaft': of 2 modes of [0-9.]* Hz 1 is left out \[W-modes\]" 'bodies.shaft.modes=3'
# The advice is good at once: neither of its two numbers parts anything.
spans='fmdsub: 1
bodies:
  shaft:
    beam: {from: [0, 0, 0], to: [1, 0, 0]}
    section: {circle: 0.01}
    material: steel
    modes: 7
    masses: {disc: {station: 0.5, mass: 1, inertia: [0.02, 0.01, 0.01]}}
    points: {middle: {station: 0.5, static: true}}
constraints:
  root: {revolute: [ground, shaft], at: [0, 0, 0], axis: [1, 0, 0]}
  far: {cylindrical: [ground, shaft], at: [1, 0, 0], axis: [1, 0, 0]}
integrate: {scheme: midpoint, step: 1.0e-4, until: 1.0e-3}'
warned "two spans in two planes" "$spans" "body 'shaft': of 4 modes of [0-9.]* Hz 1 is left out \[W-modes\]"
"$FMDSUB" check deck.yaml 2>&1 | grep -q 'they belong together: take all, 8 modes, or none, 4$' && ok "two spans: the advice" ||
    not_ok "two spans: the advice" "the deck:" deck.yaml
silent "two spans: all of them" "$spans" 'bodies.shaft.modes=8'
silent "two spans: none of them" "$spans" 'bodies.shaft.modes=4'

# A panel slewed in its stiff plane: 6 modes all bend and twist it out of that, the seventh is the first in it.
panel='fmdsub: 1
bodies:
  hub: {mass: 40, at: [0, 0, 0], inertia: [4, 5, 6]}
  panel:
    beam: {from: [0, 0.5, 0], to: [0, 2.5, 0], up: [0, 0, 1], elements: 12}
    section: {rectangle: [0.4, 0.01]}
    material: {E: 7.0e+9, nu: 0.3, density: 600}
    modes: 6
constraints:
  turn: {revolute: [ground, hub], at: [0, 0, 0], axis: [0, 0, 1]}
  clamp: {fixed: [hub, panel], at: [0, 0.5, 0]}
drives: {slew: {drive: turn.angle, value: "0.1*t^2"}}
integrate: {scheme: midpoint, step: 2.0e-3, until: 0.1}'
kept="body 'panel': its modes keep less than half of how it bends by"
warned "a panel slewed in its stiff plane" "$panel" "$kept turn.angle (0 %) \[W-kept\]"
"$FMDSUB" check deck.yaml >words 2>err
grep -q '^ *modes: 1-2 bending z, 3 torsion, 4 bending z, 5 torsion, 6 bending z$' words &&
    grep -q '^ *kept by turn.angle: 0 % of the compliance, 0 % of the mass$' words && ok "check: kinds of modes, what they keep" ||
    not_ok "check: kinds of modes, what they keep" "words:" words
"$FMDSUB" check -f json deck.yaml 2>err | tr -d ' \n\t' | grep -q '"kinds":\["bendingz","bendingz","torsion","bendingz","torsion","bendingz"\],"kept":\[{"by":"turn.angle","compliance":0,"mass":0}\]' &&
    ok "check: the same in the object" || not_ok "check: the same in the object" "stderr:" err
silent "the panel with its first mode in that plane" "$panel" 'bodies.panel.modes=7'
warned "a torque on its joint in place of the drive" "$panel" "$kept turn.angle (0 %) \[W-kept\]" \
    'drives={}' 'forces={motor: {torque: turn, value: 1}}'
silent "nothing turns it" "$panel" 'drives={}'
warned "a load in the stiff plane" "$panel" "$kept push (0 %) \[W-kept\]" \
    'drives={}' 'forces={push: {force: panel.tip, value: [1, 0, 0]}}' 'bodies.panel.points={tip: {station: 1}}'
silent "kept where the load stands" "$panel" 'drives={}' \
    'forces={push: {force: panel.tip, value: [1, 0, 0]}}' 'bodies.panel.points={tip: {station: 1, static: true}}'
silent "a load out of that plane" "$panel" 'drives={}' \
    'forces={push: {force: panel.tip, value: [0, 0, 1]}}' 'bodies.panel.points={tip: {station: 1}}'
warned "gravity in the stiff plane" "$panel" "$kept gravity (0 %) \[W-kept\]" 'drives={}' 'gravity=[9.81, 0, 0]'

# What bends too far for its frame gets one advice, whether it is told at the end or stops the run.
bends() { # UNTIL: what the run says of bending
    "$FMDSUB" run --until "$1" -s bodies.arm.stiffening=false "$ROOT/decks/spin-up.yaml" 2>&1 >out | grep -e W-bending -e 'fmdsub: stopped'
}
advice="turn on geometric stiffening: 'stiffening: true'; if it bends as far with it, cut it into 'segments'"
for until in 7.6 20; do
    bends $until >said
    [ "$(wc -l <said)" = 1 ] && grep -qF "; $advice" said && ok "bending too far until $until: one advice" ||
        not_ok "bending too far until $until: one advice" "expected one line with: $advice" said
done

# Of several that do the worst is named, the others are counted.
cat >roll.yaml <<'END'
fmdsub: 1
bodies:
  arm: {beam: {from: [0, 0], to: [4, 0], elements: 8}, section: {rectangle: [0.02, 0.004]}, material: steel, segments: 3, modes: 2, points: {tip: {station: 1}}}
constraints: {hub: {fixed: [ground, arm1], at: [0, 0]}}
forces: {roll: {torque: arm.tip, value: 20*t}}
integrate: {scheme: midpoint, step: 2.0e-3, until: 1}
END
"$FMDSUB" run -q roll.yaml 2>&1 >out | grep W-bending >said
expect "two of three segments bend too far: one line" "1 1" "$(wc -l <said) $(grep -c "^warning: 'arm3' bends by .*, as does 1 more body; " said)" said

# What is told at the end of a run or in its course is told with -q, too, and --strict counts it.
echo "$plane" >deck.yaml
"$FMDSUB" run -q -s 'constraints.pin.range=[-1, 2]' --until 2 -s integrate.step=1.0e-2 deck.yaml >out 2>err
expect "-q: a range that is left: status, lines" "0 1" "$? $(grep -c '^warning: t = .*is outside its range' err)" err
"$FMDSUB" run -q --strict -s 'constraints.pin.range=[-1, 2]' --until 2 -s integrate.step=1.0e-2 deck.yaml >out 2>err
expect "--strict: a range that is left" 1 $? err
grep -q 'strict: 1 warning(s) about the run' err && ok "--strict: a range that is left: told" || not_ok "--strict: a range that is left: told" "stderr:" err
cat >bent.yaml <<'EOF'
fmdsub: 1
gravity: [0, -9.81]
bodies:
  arm:
    beam: {from: [0, 0], to: [3, 0], elements: 8}
    section: {rectangle: [0.004, 0.01]}
    material: aluminium
    modes: 4
constraints: {clamp: {fixed: [ground, arm], at: [0, 0]}}
integrate: {scheme: midpoint, step: 1.0e-3, until: 1}
output: {every: 0.1}
EOF
"$FMDSUB" run -q bent.yaml >out 2>err
expect "-q: bending: status, lines" "0 1" "$? $(grep -c 'W-bending' err)" err
"$FMDSUB" run -q --strict bent.yaml >out 2>err
expect "--strict: bending" 1 $? err

# Parameters of what the command line has put something else in the place of are no longer asked for.
formula='fmdsub: 1
parameters: {L: 2, M: 3}
bodies: {arm: {mass: 1, inertia: 0.1, at: [1, 0]}}
constraints: {pin: {revolute: [ground, arm], at: [0, 0]}}
integrate: {scheme: midpoint, step: 1.0e-3, until: 0.01}
output: {columns: [{way: L*pin.angle}]}'
echo "$formula" >deck.yaml
"$FMDSUB" run -q --columns pin.angle deck.yaml >out 2>err
expect "--columns: parameters of the deck's own columns" "1 M" "$(grep -c W-unused err) $(sed -n "s/.*parameter '\(.*\)' is used nowhere.*/\1/p" err)" err
