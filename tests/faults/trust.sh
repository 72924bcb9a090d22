# trust.sh -- what a run says of its own error, and what a second run shows of it.
. tests/tools/lib.sh
decks=$ROOT/decks deck=$ROOT/decks/pendulum.yaml
cd "$work" || exit 1

"$FMDSUB" run "$deck" >out 2>err
tail -n 1 err | grep -q "^estimated error: [0-9.e-]* of the range of 'ball.y', summed over the steps; .fmdsub run --verify. measures it$" &&
    ok "the estimated error in words" || not_ok "the estimated error in words" "it says" err
"$FMDSUB" run "$decks"/flexible-crank.yaml >out 2>err
grep -q "^estimated error: not known, above half the range of 'wrist.fx': the steps do not resolve what moves there; take smaller steps$" err &&
    ok "steps that do not resolve what moves" || not_ok "steps that do not resolve what moves" "it says" err
"$FMDSUB" run -s integrate.scheme=miao "$decks"/bar-slider.yaml >out 2>err
tail -n 1 err | grep -q 'not known: its scheme does not tell' && ok "a scheme that does not tell" || not_ok "a scheme that does not tell" "it says" err

"$FMDSUB" run -s integrate.scheme=rk4 -s integrate.step=0.02 "$decks"/slider-crank.yaml >out 2>err
grep -q '^estimated error: not known: the energy balance is broken; ' err && ok "a broken balance" ||
    not_ok "a broken balance" "it says" err

# Where small differences grow all the way: a double pendulum, an orbit, a chain of 16 links; not a pendulum, a four-bar of one
# freedom, a governor, the same chain hanging.
cat >hanging.yaml <<'END'
fmdsub: 1
parameters: {N: 16}
gravity: [0, -9.81]
bodies: {"link$i": {repeat: {i: [1, N]}, mass: 1, inertia: 1/12, at: [0, 0.5 - i]}}
constraints:
  pin1:  {revolute: [ground, link1], at: [0, 0]}
  pin$i: {repeat: {i: [2, N]}, revolute: [link$(i-1), link$i], at: [0, 1 - i]}
initial: {pin3.angle: 0.05, pin9.angle: -0.02}
integrate: {scheme: newmark, step: 1.0e-3, until: 20}
output: {every: 0.1, columns: ["pin*.angle"]}
END
for at in "double-pendulum: $decks/double-pendulum.yaml" "orbit: $ROOT/tests/tolerance/orbit.yaml" \
    "16 links: -s parameters.N=16 -s integrate.until=20 -s output.every=0.1 $decks/chain.yaml"; do
    told="summed over the steps, which grow in proportion to time at least:"
    [ "${at%%: *}" = "16 links" ] && told="not known, above half the range of 'energy.kinetic':"
    "$FMDSUB" run ${at##*: } >out 2>err
    tail -n 1 err | grep -q "$told small differences grow all the way, at [0-9.]* /s and more[:;] " &&
        ok "differences that grow: ${at%%: *}" || not_ok "differences that grow: ${at%%: *}" "it says" err
done
for quiet in "$decks/pendulum" "$decks/four-bar" "$decks/governor" "$decks/spring-pendulum" hanging; do
    "$FMDSUB" run "$quiet.yaml" >out 2>err
    tail -n 1 err | grep -q "summed over the steps; .fmdsub" && ok "none that grow: ${quiet##*/}" || not_ok "none that grow: ${quiet##*/}" "it says" err
done
"$FMDSUB" run -s parameters.N=60 "$decks/chain.yaml" >out 2>err
tail -n 1 err | grep -q "summed over the steps; whether small differences grow was not looked at: " && ok "60 links: not looked at" ||
    not_ok "60 links: not looked at" "it says" err

# Two wheels with backlash: a motion that lies next to it parts from it by teeth that strike, 71 times within 2 s and for a few
# milliseconds each.  Between these, where records stand, nothing grows: at 1e-6 'e.angle' is off by 2e-4 of its range, the force by
# two fifths.  With a drag that bends as often, where the wheels turn back, and no teeth the error is known.
cat >backlash.yaml <<END
fmdsub: 1
parameters: {k: 5.0e4, b: 0.01, c: 2}
bodies: {drv: {mass: 5, inertia: 0.2, at: [0, 0]}, drn: {mass: 8, inertia: 0.5, at: [1, 0]}}
constraints: {a: {revolute: [ground, drv], at: [0, 0]}, e: {revolute: [ground, drn], at: [1, 0]}}
forces:
  motor: {torque: a, value: 20*sin(9*t)}
  load: {torque: e, value: -0.2*e.angle_rate}
  one: {torque: a, value: -tooth}
  two: {torque: e, value: -2*tooth}
signals:
  gap: a.angle + 2*e.angle
  rate: a.angle_rate + 2*e.angle_rate
  tooth: "if(gap > b, k*(gap - b) + c*rate, if(gap < -b, k*(gap + b) + c*rate, 0))"
integrate: {scheme: radau9, tolerance: 1.0e-6, until: 2}
output: {every: 0.01, columns: [a.angle, e.angle, tooth]}
END
for scheme in radau9 dopri5 midpoint; do
    "$FMDSUB" run -s integrate.scheme=$scheme -s integrate.tolerance=1e-4 backlash.yaml >out 2>err
    grep -q "^estimated error: not known: brief pushes (stops, contacts, backlash) come again and again, each time otherwise" err &&
        ok "backlash, $scheme: not known" || not_ok "backlash, $scheme: not known" "it says" err
    sed 's/^  tooth: .*/  tooth: 2*abs(rate)*rate/' backlash.yaml >drag.yaml
    "$FMDSUB" run -s integrate.scheme=$scheme -s integrate.tolerance=1e-4 drag.yaml >out 2>err
    grep -q '^estimated error: [0-9.e-]* of the range of ' err && ok "drag, $scheme: known" || not_ok "drag, $scheme: known" "it says" err
done

# What the motion keeps changes by errors alone, which say nothing of the steps: a free body's kinetic energy.
for scheme in dopri5 radau5 newmark; do
    "$FMDSUB" run --strict -s integrate.scheme=$scheme -s integrate.tolerance=1e-3 "$decks/free-top.yaml" >out 2>err
    expect "energy that is kept, $scheme" "0 1" \
        "$? $(grep -c "^estimated error: 0.00[0-9]* of the range of .*, without 'energy.kinetic', which changes by no more than its error; " err)" err
done
"$FMDSUB" run -s integrate.scheme=dopri5 -s integrate.tolerance=1e-3 --columns energy.kinetic "$decks/free-top.yaml" >out 2>err
expect "energy that is kept, alone" 1 "$(grep -c "^estimated error: not known: 'energy.kinetic' changes by no more than that$" err)" err

# Errors of bodies that pull at each other cancel in the momenta that midpoint keeps, however little these change by.
"$FMDSUB" run --strict -s integrate.scheme=midpoint -s integrate.tolerance=1e-3 "$ROOT/tests/decks/audit-two-free.yaml" >out 2>err
ended "momenta that are kept, of what is pushed" 0 $? out err

# Kinetic energy is off by what the others are: signs that are drawn know nothing of the sum, which the motion keeps.
"$FMDSUB" run -q --stats=energies -s integrate.scheme=dopri5 -s integrate.tolerance=1e-5 -s 'output.columns=[energy.kinetic,energy.gravity]' \
    "$decks"/chain.yaml >out 2>err
told=$(awk '$1 == "estimated_error" { print ($2 > 1e-9 && $2 < 1e-6 ? "fine" : $2) }' energies)
expect "the estimate of energies that a chain exchanges" fine "$told" err

# A second run: the table, the summary, the same records.
"$FMDSUB" run -q "$deck" >plain 2>err
"$FMDSUB" run --verify "$deck" >out 2>err
expect "--verify: the first run's records" 0 "$([ -s plain ] && cmp plain out >/dev/null; echo $?)" out
expect "--verify: a line for each column" 7 "$(grep -cE '^(pin|ball)\.[a-z_]+ +[0-9.e-]+ +[0-9.e-]+ ' err)" err
grep -q '^verified by a second run at step 0.0005: ' err && ok "--verify: half the step" || not_ok "--verify: half the step" "it says" err
measured=$("$FMDSUB" run -q --verify -f ndjson "$deck" 2>err | tail -n 1 | tr ',{' '\n\n' | awk -F: '
    { gsub(/"/, "") } $1 == "estimated_error" { e = $2 } $1 == "verified_difference" { v = $2 } $1 == "difference.pin.fx" { c = $2 }
    END { if (e > v / 3 && e < 30 * v && c == v && v > 1e-6 && v < 1e-3) print "fine"; else print e, v, c }')
expect "--verify: in the summary, beside the estimate" fine "$measured" err
"$FMDSUB" run --verify -s integrate.scheme=dopri5 -s integrate.tolerance=1e-6 "$deck" 2>err >out
grep -q '^verified by a second run at tolerance 1e-07: ' err && ok "--verify: a tenth of the tolerance" || not_ok "--verify: a tenth of the tolerance" "it says" err
"$FMDSUB" run --verify --every-steps 7 -s integrate.ratio=4 "$decks"/bar-slider.yaml 2>err >out
grep -q '^verified by a second run at step 0.0005: what differs, at most, at the 7[23] records' err && ok "--verify: records by steps, ratio kept" ||
    not_ok "--verify: records by steps, ratio kept" "it says" err
"$FMDSUB" run -q --verify "$deck" >out 2>err
expect "--verify: status, nothing said, records" "0 0 same" "$? $(wc -l <err | tr -d ' ') $([ -s out ] && cmp -s plain out && echo same)" err

# Errors far above the tolerance are told.
top="-s integrate.scheme=dopri5 -s integrate.tolerance=1e-3 -s integrate.until=300 -s output.every=10"
"$FMDSUB" run $top "$deck" >out 2>err
grep -q '^warning: the estimated error, .* is far above the tolerance of 0.001: .* \[W-tolerance\]$' err && ok "far above the tolerance" || not_ok "far above the tolerance" "it says" err
"$FMDSUB" run -q --strict $top "$deck" >out 2>err
expect "far above the tolerance, --strict" 1 $? err
# So are errors that are large whatever the tolerance: above a twentieth, here 100 times the tolerance.
large="-s integrate.scheme=dopri5 -s integrate.tolerance=1e-3 -s output.every=10"
"$FMDSUB" run -q $large -s integrate.until=100 "$deck" >out 2>err
expect "large, though near a loose tolerance" 1 "$(grep -c '^warning: the estimated error, 0.0[5-9].* is large, at a tolerance of 0.001: .* \[W-tolerance\]$' err)" err
"$FMDSUB" run -q --strict $large -s integrate.until=15 "$deck" >out 2>err
ended "small" 0 $? out err
"$FMDSUB" explain W-tolerance >out 2>err
ended "and that is explained" 0 $? out err

# Round-off is not judged, whatever it is a large share of: the moment of a rail that forces through its joint do not turn, what
# moves after a static start, an angle that nothing turns.
cat >crane.yaml <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies: {trolley: {mass: 3, at: [0, 0]}, load: {mass: 2, inertia: 0.1, at: [0, -1]}}
constraints:
  rail: {prismatic: [ground, trolley], axis: [1, 0]}
  rope: {revolute: [trolley, load], at: [0, 0]}
drives: {move: {drive: rail, value: "2*smooth(t, 0.5, 2)"}}
integrate: {until: 3}
output: {every: 0.25, columns: ["rail.*", "rope.*"]}
END
cat >tip.yaml <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies:
  b: {beam: {from: [0, 0], to: [1, 0]}, section: {rectangle: [0.01, 0.01]}, material: steel}
  w: {mass: 0.5, inertia: 0.01, at: [1, 0]}
constraints: {f: {fixed: [ground, b], at: [0, 0]}, ax: {revolute: [b, w], at: [1, 0]}}
initial: static
integrate: {until: 0.01}
output: {columns: [ax.angle]}
END
cat >shaft.yaml <<'END'
fmdsub: 1
gravity: [0, 0, -9.81]
bodies:
  shaft:
    beam: {from: [0, 0, 0], to: [1, 0, 0]}
    modes: 5
    section: {circle: 0.01}
    material: steel
    masses: {disk: {station: 0.5, mass: 2, inertia: [0.02, 0.01, 0.01]}}
constraints:
  left: {revolute: [ground, shaft], at: [0, 0, 0], axis: [1, 0, 0]}
  right: {cylindrical: [ground, shaft], at: [1, 0, 0], axis: [1, 0, 0]}
initial: static
integrate: {until: 0.01}
output: {columns: [energy.kinetic]}
END
cat >rests.yaml <<'END'
fmdsub: 1
gravity: [0, 0, -9.81]
bodies:
  arm: {beam: {from: [0, 0, 0], to: [1.2, 0, 0], elements: 16}, section: {circle: 0.03}, material: steel, modes: 6, points: {tip: {station: 1}}}
constraints: {wall: {fixed: [ground, arm], at: [0, 0, 0]}}
initial: {static: true}
integrate: {scheme: radau9, tolerance: 1.0e-4, until: 1}
output: {every: 0.01, columns: ["arm.*"]}
END
for at in crane "crane --columns rail.mz" tip shaft rests; do
    "$FMDSUB" run -q --strict ${at%%" "*}.yaml $(echo "$at" | cut -s -d ' ' -f 2-) >out 2>err
    ended "round-off is not judged: $at" 0 $? out err
done
"$FMDSUB" run -q --strict $top -s 'output.columns=[pin.fx,pin.fy]' "$deck" >out 2>err
expect "forces above round-off are" 1 $? err

# What rolls on what has no estimate: nothing of it is seen where it is pushed.
cat >"$work/roll.yaml" <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies: {b: {mass: 1, inertia: 0.005, at: [0, 1.1]}}
constraints: {f: {free: [ground, b]}}
surfaces: {drum: {sphere: ground, at: [0, 0], radius: 1}, disc: {sphere: b, radius: 0.1}}
contacts: {c: {between: [disc, drum], friction: 50}}
initial: {f.x_rate: 0.01, f.angle_rate: -0.1}
integrate: {step: 1.0e-3, until: 2.8}
output: {columns: [b.y]}
END
"$FMDSUB" run "$work/roll.yaml" >"$work/out" 2>"$work/err"
expect "rolling: no estimate" 1 "$(grep -c 'estimated error: not known: bodies push' "$work/err")" "$work/err"

# Why it is not known: friction of joints, an iteration that gives up steps, a run of few steps.
words() { # PATTERN NAME ARGUMENT...
    pattern=$1 name=$2
    shift 2
    "$FMDSUB" run "$@" >"$work/out" 2>"$work/err"
    expect "not known: $name" 1 "$(tail -n 1 "$work/err" | grep -c "^estimated error: not known: $pattern; ")" "$work/err"
}
pin='fmdsub: 1\ngravity: [0, -9.81]\nbodies: {bob: {mass: 1, inertia: 0.1, at: [1, 0]}, rod: {mass: 0.2, inertia: 0.02, at: [2.5, 0]}}
forces: {%s}\nintegrate: {step: 1.0e-3, until: 1%s}\noutput: {columns: [bob.x]}\n'
mid='mid: {revolute: [bob, rod], at: [2, 0]}'
{ printf "$pin" 'k: {spring: mid, stiffness: 50}' ''; echo "constraints: {pin: {revolute: [ground, bob], at: [0, 0], friction: {coefficient: 0.3, radius: 0.05}}, $mid}"; } >"$work/rub.yaml"
{ printf "$pin" 'p: {bushing: [ground, bob], at: [0, 0], stiffness: [1.0e+12, 1.0e+12]}' ', scheme: subcycle, ratio: 10'
    echo "constraints: {f: {free: [ground, bob]}, $mid}"; echo 'partition: {fast: [mid]}'; } >"$work/cut.yaml"
words 'friction acts in joints' 'friction in joints' "$work/rub.yaml"
words 'too many major steps did not converge at their length and were cut: a lower ratio takes less' 'steps cut' "$work/cut.yaml"
words 'the run has too few steps' 'few steps' -s integrate.scheme=midpoint -s integrate.order=4 -s integrate.until=0.003 -s output.every=0.001 "$deck"

# A mass between two stops that a force shakes: past six strikes that are unlike each other nothing is told of how far it
# has gone astray (by four tenths of its range, at any tolerance); where it settles into a cycle, or there are few, the estimate is.
cat >"$work/shaken.yaml" <<'END'
fmdsub: 1
bodies: {m: {mass: 1, at: [0, 0]}}
constraints: {s: {prismatic: [ground, m], axis: [1, 0], range: {lower: -0.05, upper: 1, hold: {stiffness: 2.0e+5, damping: 60}}}}
forces: {back: {spring: s, stiffness: 100, damping: 1}, shake: {force: s, value: 20*sin(25*t)}}
integrate: {scheme: dopri5, tolerance: 1.0e-6, until: 20}
output: {every: 0.02, columns: [s.displacement]}
END
stray='brief pushes (stops, contacts, backlash) come again and again, each time otherwise, and small differences may grow from one to the next'
words "$stray" 'strikes' "$work/shaken.yaml"
words "$stray" 'strikes, fixed steps' -s integrate.scheme=rk4 -s integrate.step=2e-4 -s integrate.until=10 "$work/shaken.yaml"
words "$stray" 'strikes, two rates' -s integrate.scheme=subcycle -s integrate.until=10 "$work/shaken.yaml"
sed 's/, range:.*}}}/}}/; s/^forces: {/&low: {force: s, value: "if(s.displacement < -0.05, -2.0e+5*(s.displacement + 0.05), 0)"}, high: {force: s, value: "if(s.displacement > 1, -2.0e+5*(s.displacement - 1), 0)"}, /' \
    "$work/shaken.yaml" >"$work/walls.yaml"
words "$stray" 'strikes on expressions' "$work/walls.yaml"
"$FMDSUB" run -s integrate.until=0.8 "$work/shaken.yaml" >"$work/out" 2>"$work/err"
expect "few strikes" 1 "$(grep -c "^estimated error: .*e-0.* of the range of 's.displacement'" "$work/err")" "$work/err"
sed 's/25\*t/18*t/' "$work/shaken.yaml" >"$work/cycle.yaml"
"$FMDSUB" run "$work/cycle.yaml" >"$work/out" 2>"$work/err"
expect "strikes of a cycle" 1 "$(grep -c "^estimated error: .* of the range of 's.displacement'" "$work/err")" "$work/err"

# A force on a hard stop by an expression is not 0 in a few records alone (by newmark at 1e-4 it was told 0.019 of what is found).
(cd "$ROOT" && sh tests/tools/trust.sh struck) >"$work/out" 2>&1
expect "a force that pushes but briefly" 0 $? "$work/out"

# Under a torque of time, too, a delay grows behind a slow passage (by rk4 at 2e-3 0.03 of what is found was told), as it is followed,
# by tolerance, too (by radau5 at 1e-5 230 times); so do the pulses of a crank (0.12 times by newmark at 1e-4) and of a ram (210 times
# by radau5 at 1e-5).
(cd "$ROOT" && sh tests/tools/trust.sh slow-passage pulsed-ram pulsed-crank) >"$work/out" 2>&1
expect "a slow passage, pulses" 0 $? "$work/out"
# So are errors under forces that are quick beside the motion, where sums count what cancels (150 to 1000 times what is found).
(cd "$ROOT" && sh tests/tools/trust.sh quick-push quick-shake) >"$work/out" 2>&1
expect "forces that are quick beside the motion" 0 $? "$work/out"

# What an explicit pair leaves is of another order than its estimate, whose signs do not tell how it adds up (by dopri5 at 1e-4 0.22 of
# what is found was told of a four-bar that turns against a damper).
(cd "$ROOT" && sh tests/tools/trust.sh braked) >"$work/out" 2>&1
expect "a turn against a damper" 0 $? "$work/out"

# What iterations leave takes no signs from the local errors of an implicit scheme (29 times what is found was told, 2.1e-8).
"$FMDSUB" run -q --stats="$work/stats" -s integrate.scheme=radau9 -s integrate.tolerance=1e-6 "$ROOT/tests/trust/leaning.yaml" >"$work/out" 2>"$work/err"
expect "signs beside what iterations leave" fine "$(awk '$1 == "estimated_error" { print ($2 > 7e-9 && $2 < 2e-7 ? "fine" : $2) }' "$work/stats")" "$work/err"

# Energies are of the motion, works are sums: an error of 0 is nobody's.
"$FMDSUB" run --columns energy.kinetic "$ROOT/decks/double-pendulum.yaml" >"$work/out" 2>"$work/err"
expect "the error of an energy" 1 "$(grep -c "^estimated error: 0.000[1-9]* of the range of 'energy.kinetic'" "$work/err")" "$work/err"
"$FMDSUB" run --columns energy.external,energy.drive "$ROOT/decks/double-pendulum.yaml" >"$work/out" 2>"$work/err"
expect "the error of works" 1 "$(grep -c "^estimated error: not known: no column of the motion is written" "$work/err")" "$work/err"

# A momentum that is kept as far as the steps are accurate: its range is of errors alone, which tell nothing of the steps.
cat >"$work/flies.yaml" <<'EOF'
fmdsub: 1
bodies:
  hub: {mass: 60, at: [0, 0], inertia: 9}
  arm: {mass: 3, at: [1, 0], inertia: 0.5}
constraints:
  f: {free: [ground, hub]}
  w: {revolute: [hub, arm], at: [0.4, 0]}
forces:
  k: {spring: w, stiffness: 5, damping: 0.1}
initial: {f.x_rate: 0.2, f.angle_rate: 0.5, w.angle: 0.4}
integrate: {until: 4, tolerance: 1.0e-4}
output: {every: 0.05, columns: [f.angle, w.angle, "momentum.*"]}
EOF
for scheme in dopri5 radau5 newmark midpoint; do
    "$FMDSUB" run --strict -s integrate.scheme=$scheme "$work/flies.yaml" >"$work/out" 2>"$work/err"
    expect "momenta beside what moves, $scheme" "0 1" "$? $(grep -c "^estimated error: [0-9.e-]* of the range of '[fw].angle'" "$work/err")" "$work/err"
done
for at in radau5,1e-6 radau9,1e-6 newmark,1e-6 radau9,1e-9; do
    "$FMDSUB" run --strict -s integrate.scheme=${at%,*} -s integrate.tolerance=${at#*,} "$work/flies.yaml" >"$work/out" 2>"$work/err"
    expect "momenta beside what moves, $at" "0 1" "$? $(grep -c "^estimated error: [0-9.e-]* of the range of '[fw].angle'" "$work/err")" "$work/err"
done
"$FMDSUB" run -s integrate.scheme=newmark --columns 'momentum.*' "$work/flies.yaml" >"$work/out" 2>"$work/err"
expect "momenta alone" 1 "$(grep -c "^estimated error: not known: no column of the motion is written" "$work/err")" "$work/err"

# --verify: a run that stops has no second, and says of itself what it says alone; where no column is of the motion nothing is
# compared, and a difference that is not known is no number.
stops="-s integrate.scheme=rk4 -s integrate.ratio=1 -s integrate.step=0.5 -s integrate.until=10 -s output.every=1"
"$FMDSUB" run -q -f ndjson $stops "$decks/stiff-leaf-chain.yaml" >"$work/alone" 2>"$work/err1"
expect "--verify of a run that stops: status alone" 5 $?
"$FMDSUB" run -q -f ndjson --verify $stops "$decks/stiff-leaf-chain.yaml" >"$work/out" 2>"$work/err"
expect "--verify of a run that stops: status, nothing verified" "5 0" "$? $(cat "$work/out" "$work/err" | grep -c verified)" "$work/err"
same "--verify of a run that stops: its words" "$work/err1" "$work/err"
"$FMDSUB" run --verify $stops "$decks/stiff-leaf-chain.yaml" >"$work/out" 2>"$work/err"
expect "--verify of a run that stops: no table" "5 0" "$? $(grep -c '^verified\|^most of all' "$work/err")" "$work/err"
"$FMDSUB" run --verify -c energy.residual "$deck" >"$work/out" 2>"$work/err"
expect "--verify, no column of the motion: status, said, no worst" "0 1 0" \
    "$? $(grep -c '^verified by a second run at step ' "$work/err") $(grep -c '^most of all' "$work/err")" "$work/err"
expect "--verify, no column of the motion: no number" 1 \
    "$("$FMDSUB" run -q -f ndjson --verify -c energy.residual "$deck" | grep -c '"verified_difference":null')"
cat >"$work/once.yaml" <<'EOF'
fmdsub: 1
bodies: {m: {mass: 1, at: [0, 0]}}
constraints: {r: {prismatic: [ground, m], axis: [1, 0]}}
forces: {k: {spring: r, stiffness: 100}}
initial: {r.displacement_rate: 1}
integrate: {scheme: midpoint, step: 0.02, until: 0.3}
output: {every: 0.02, columns: [r.displacement, {late: "if(t > 0.29 and r.displacement > 0.0145, 2, 0)"}]}
EOF
"$FMDSUB" run --verify "$work/once.yaml" >"$work/out" 2>"$work/err"
expect "--verify, a column that stands still in the second run" "most of all 'late', by 2, which does not change in the second run" \
    "$(grep '^most of all' "$work/err")" "$work/err"

# What happens on the way is told once, by the first run, beside a second and beside what is left out.
"$FMDSUB" run -q -f ndjson "$decks/effect-friction.yaml" 2>"$work/err" | grep '"type":"event"' >"$work/events"
"$FMDSUB" run -q -f ndjson --verify "$decks/effect-friction.yaml" 2>"$work/err" | grep '"type":"event"' >"$work/twice"
same "--verify: events of the first run" "$work/events" "$work/twice"
"$FMDSUB" run -q -f ndjson -s effects.gravity=false "$decks/effect-friction.yaml" >"$work/out" 2>"$work/err"
expect "left out: events of the first run, and what is left out" "3 1" "$(grep -c '"type":"event"' "$work/out") $(grep -c '"neglected_gravity":' "$work/out")" "$work/err"

# A run whose balance breaks has its second run all the same, and ends as it does alone.
"$FMDSUB" run --verify -s integrate.scheme=rk4 -s integrate.step=0.02 "$decks/slider-crank.yaml" >"$work/out" 2>"$work/err"
expect "--verify of a broken balance: status, verified, told" "1 1 1" \
    "$? $(grep -c '^verified by a second run at step 0.01: ' "$work/err") $(grep -c '^fmdsub: the energy balance .* is broken: ' "$work/err")" "$work/err"

# Fixed steps over the touch of a damper, whose push is there at once, are of order 1, and none of the steps beside it knows:
# against the closed form of a mass that flies freely and then turns in the spring and the damper.
for how in unilateral contacts range; do
    { cat <<'END'
fmdsub: 1
bodies: {m: {mass: 1.3, at: [0, 0]}}
integrate: {until: 0.2}
initial: {s.displacement: -0.13, s.displacement_rate: 1.7}
output: {every: 0.01, columns: [s.displacement, s.displacement_rate]}
END
        case $how in
        unilateral) echo 'constraints: {s: {prismatic: [ground, m], axis: [1, 0]}}'
            echo 'forces: {buffer: {unilateral: s, side: above, stiffness: 400, damping: 6}}' ;;
        contacts) echo 'constraints: {s: {prismatic: [ground, m], axis: [1, 0]}}'
            echo 'surfaces: {wall: {plane: ground, at: [0, 0], normal: [-1, 0]}, nose: {point: m}}'
            echo 'contacts: {hit: {between: [nose, wall], stiffness: 400, damping: 6}}' ;;
        range) echo 'constraints: {s: {prismatic: [ground, m], axis: [1, 0], range: {upper: 0, hold: {stiffness: 400, damping: 6}}}}' ;;
        esac; } >"buffer-$how.yaml"
    for setting in 'midpoint 2.5e-5' 'midpoint 1e-3' 'newmark 2e-4' 'generalized-alpha 5e-4' 'rk4 2.5e-4' 'rk4 5e-5' 'subcycle 1.25e-4'; do
        "$FMDSUB" run -q --stats=touched -s integrate.scheme=${setting% *} -s integrate.step=${setting#* } "buffer-$how.yaml" >out 2>err
        expect "a damper's touch by $how, $setting" within "$(awk -F, '
            FNR == NR { if (split($0, w, " ") && w[1] == "estimated_error") told = w[2]; next }
            FNR == 1 || /^#/ { next }
            function abs(x) { return x < 0 ? -x : x }
            {
                k = 400 / 1.3; d = 6 / 2.6; w0 = sqrt(k - d * d); u = $1 - 0.13 / 1.7
                x = u < 0 ? 1.7 * u : 1.7 / w0 * exp(-d * u) * sin(w0 * u)
                v = u < 0 ? 1.7 : 1.7 / w0 * exp(-d * u) * (w0 * cos(w0 * u) - d * sin(w0 * u))
                if (u > 0 && 400 * x + 6 * v < 0) next # it has let go
                if (abs($2 - x) > ex) ex = abs($2 - x)
                if (abs($3 - v) > ev) ev = abs($3 - v)
                if ($2 < lx || FNR == 2) lx = $2
                if ($2 > hx || FNR == 2) hx = $2
                if ($3 < lv || FNR == 2) lv = $3
                if ($3 > hv || FNR == 2) hv = $3
            }
            END { ex /= hx - lx; ev /= hv - lv; e = ex > ev ? ex : ev
                  print (e > 1e-7 && told > e / 3 && told < 30 * e ? "within" : told " for " e) }' touched out)" err
    done
done

# A clutch that slips by a force of its own: the scheme does tell what its steps leave, but none of these is free of friction.
cat >clutch.yaml <<END
fmdsub: 1
bodies: {motor: {mass: 5, inertia: 0.4, at: [0, 0]}, load: {mass: 20, inertia: 1.6, at: [0, 0]}}
constraints:
  a: {revolute: [ground, motor], at: [0, 0]}
  b: {revolute: [motor, load], at: [0, 0], friction: {torque: 60}}
initial: {a.angle_rate: 100, b.angle_rate: -100}
integrate: {scheme: midpoint, step: 1.0e-3, until: 2}
output: {every: 0.05, columns: [a.angle_rate]}
END
"$FMDSUB" run clutch.yaml >out 2>err
expect "a clutch: why not known" "estimated error: not known: no step was free of friction or of what may touch; \`fmdsub run --verify\` measures it" \
    "$(tail -n 1 err)" err
