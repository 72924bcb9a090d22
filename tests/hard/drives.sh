# drives.sh -- drives that cannot be followed, that say things twice, and what they cost in energy.
. tests/tools/lib.sh

# The crank is longer than the rod: nothing beyond asin(0.15/0.35) = 0.442911 s.
for scheme in midpoint newmark subcycle rk4 dopri5; do
    how="--set integrate.scheme=$scheme"
    [ $scheme = dopri5 ] && how="$how --set integrate.tolerance=1.0e-8"
    "$FMDSUB" run -q $how tests/hard/locked-drive.yaml >"$work/out" 2>"$work/err"
    expect "locked, $scheme: status" 5 $? "$work/err"
    grep -q "stopped at t = 0.442.*'wrist' cannot be kept" "$work/err" && ok "locked, $scheme: told" ||
        not_ok "locked, $scheme: told" "stderr:" "$work/err"
    expect "locked, $scheme: records up to the last step, whole" "0.442 4 444" \
        "$(awk -F, 'END { print $1, NF, NR }' "$work/out")"
done

# Rates that grow without bound ahead of the lock: steps of the scheme's own shrink to nothing there.
cat >"$work/boom.yaml" <<'END'
fmdsub: 1
parameters: {L0: sqrt(1.04)}
bodies:
  ground: {points: {foot: [0, 0, -1]}}
  boom: {mass: 50, inertia: [1, 1, 1], at: [1, 0, 0], points: {eye: [-0.8, 0, 0]}}
  load: {mass: 20, at: [2, 0, -0.5], inertia: [0.1, 0.1, 0.1]}
constraints:
  hinge: {revolute: [ground, boom], at: [0, 0, 0], axis: [0, -1, 0]}
  rope: {universal: [boom, load], at: [2, 0, 0], axis: [1, 0, 0], axis2: [0, 1, 0]}
measures: {cyl: {distance: [ground.foot, boom.eye]}}
drives: {lift: {drive: cyl, value: "L0 + 0.1*(1-cos(t))"}}
integrate: {scheme: radau9, tolerance: 1.0e-9, until: 3}
END
for scheme in radau5 radau9; do
    "$FMDSUB" run -q --set integrate.scheme=$scheme "$work/boom.yaml" >"$work/out" 2>"$work/err"
    expect "boom, $scheme: status" 5 $? "$work/err"
    grep -q "drive 'lift' cannot be kept.*dead-point" "$work/err" && ok "boom, $scheme: told" ||
        not_ok "boom, $scheme: told" "stderr:" "$work/err"
done

# Two drives of one freedom: alike, then off by next to nothing, then by too much.
for d in 0 1.0e-9; do
    "$FMDSUB" run --set parameters.d=$d tests/hard/two-drives.yaml >"$work/out.$d" 2>"$work/err"
    ended "two drives, $d apart: status" 0 $? "$work/out.$d" "$work/err"
    grep -q "W-redundant" "$work/err" && ok "two drives, $d apart: warned" ||
        not_ok "two drives, $d apart: warned" "stderr:" "$work/err"
done
"$FMDSUB" run --set parameters.d=1.0e-3 tests/hard/two-drives.yaml >"$work/out" 2>"$work/err"
expect "two drives, 1e-3 apart: status" 4 $? "$work/err"
expect "two drives, 1e-3 apart: nothing written" "1 " "$(grep -c contradicts "$work/err") $(cat "$work/out")"
grep -q "drive 'two' contradicts" "$work/err" && ok "two drives, 1e-3 apart: told" ||
    not_ok "two drives, 1e-3 apart: told" "stderr:" "$work/err"
# They part later.
"$FMDSUB" run --set 'drives.two.value=0.2*sin(t) + if(t < 0.5, 0, (t - 0.5)^2)' tests/hard/two-drives.yaml >"$work/out" 2>"$work/err"
expect "two drives that part: status" 5 $? "$work/err"

# A corner next to a singular posture, from which drives alone can step aside.  The angle is that of a smooth passage.
for eps in 1.0e-4 1.0e-5 1.0e-6 1.0e-9; do
    for scheme in midpoint newmark subcycle rk4 dopri5; do
        how="--set parameters.eps=$eps --set integrate.scheme=$scheme"
        [ $scheme = dopri5 ] && how="$how --set integrate.tolerance=1.0e-8"
        "$FMDSUB" run -q $how tests/hard/flat-drive.yaml >"$work/out" 2>"$work/err"
        ended "flat by $eps, $scheme: status" 0 $? "$work/out" "$work/err"
        expect "flat by $eps, $scheme: angle" 0.2441 "$(awk -F, 'END { printf "%.4f", $2 + ('$eps' * 0.84) }' "$work/out")"
    done
done

# A drive that has no value from some time on, alone and with a freedom left.
for value in 'sqrt(0.3 - t)' '0.1*asin(t/0.3)'; do
    for scheme in midpoint newmark subcycle rk4; do
        "$FMDSUB" run -q --set "drives.one.value=$value" --set drives.two.value="$value" \
            --set integrate.scheme=$scheme --set "initial={assemble: true}" tests/hard/two-drives.yaml >"$work/out" 2>"$work/err"
        expect "$value, $scheme: status" 5 $? "$work/err"
        grep -q "drive 'one' or a rate of it is not a number" "$work/err" && ok "$value, $scheme: told" ||
            not_ok "$value, $scheme: told" "stderr:" "$work/err"
    done
done

# A value that jumps: nothing follows.  The run stops before, whatever the scheme and its step.
cat >"$work/rail.yaml" <<'END'
fmdsub: 1
bodies:
  car: {mass: 1, at: [0, 0]}
constraints:
  rail: {prismatic: [ground, car], axis: [1, 0]}
drives:
  slide: {drive: rail, value: "if(t < 0.0105, t, 1)"}
integrate: {scheme: newmark, step: 1.0e-3, until: 0.02}
END
for scheme in midpoint newmark subcycle miao rk4 dopri5; do
    how="--set integrate.scheme=$scheme"
    [ $scheme = dopri5 ] && how="$how --set integrate.tolerance=1.0e-8"
    "$FMDSUB" run -q $how "$work/rail.yaml" >"$work/out" 2>"$work/err"
    expect "jump, $scheme: status" 5 $? "$work/err"
    grep -q "stopped at t = 0.01 s: drive 'slide' jumps by 0.99, from 0.0105 to 1, at t = 0.0105 s ($work/rail.yaml:7:31)" "$work/err" &&
        ok "jump, $scheme: told" || not_ok "jump, $scheme: told" "stderr:" "$work/err"
    expect "jump, $scheme: records before it, whole" "0.01 4 12" "$(awk -F, 'END { print $1, NF, NR }' "$work/out")"
done
# Constants of a few digits: told once, and as an event.  Pieces that meet: nothing.
for end in 10.5001:2 10.5:0; do
    "$FMDSUB" run -f ndjson --set "drives.slide.value='if(t < 0.0105, 1000*t, ${end%:*})'" "$work/rail.yaml" >"$work/out" 2>"$work/err"
    ended "pieces that end at 10.5 and ${end%:*}: status" 0 $? "$work/out" "$work/err"
    expect "pieces that end at 10.5 and ${end%:*}: told" "summary ${end#*:}" \
        "$(grep -o '"type":"summary"' "$work/out" | cut -d '"' -f 4) $(cat "$work/out" "$work/err" | grep -c "drive 'slide' jumps by 0.0001, from 10.5 to 10.5001, at t = 0.0105 s")" "$work/err"
done

# A drive that begins elsewhere than it is drawn: told, unless the deck says so elsewhere, too.
for how in "title=x:1" 'initial={rail.displacement: 0.3}:0' 'initial={assemble: true}:0' 'drives.slide.value=0.3*sin(t):0'; do
    "$FMDSUB" run -q --set 'drives.slide.value=0.3*cos(t)' --set "${how%:*}" "$work/rail.yaml" >"$work/out" 2>"$work/err"
    expect "begins elsewhere, ${how%:*}: told" "records ${how##*:}" "$([ -s "$work/out" ] && echo records) $(grep -c W-drive-start "$work/err")" "$work/err"
done

# What balances is a drive's work and gravity's; kinetic energy next to them is none.
"$FMDSUB" run -q tests/hard/slow-lift.yaml >"$work/out" 2>"$work/err"
ended "slow lift: status" 0 $? "$work/out" "$work/err"

# Twenty seconds with the fast part resolved, omega h = 0.084: the balance holds, and does not wander.
for n in 1 5 10 20; do
    "$FMDSUB" run -q --set integrate.step=5.0e-4 --set integrate.ratio=$n --every 0.05 --until 20 \
        --columns energy.residual,energy.kinetic decks/driven-telescope.yaml >"$work/out" 2>"$work/err"
    awk -F, '
        function size(x) { return x < 0 ? -x : x }
        NR > 1 { half = $1 > 10; if (size($2) > worst[half]) worst[half] = size($2); if ($3 > kinetic) kinetic = $3 }
        END {
            printf "%.2g and %.2g of %.3g J", worst[0], worst[1], kinetic
            exit !(kinetic > 1 && worst[0] <= 1e-3 * kinetic && worst[1] <= 1e-3 * kinetic && worst[1] < 2 * worst[0])
        }' "$work/out" >"$work/line"
    if [ $? = 0 ]; then ok "driven telescope n=$n: residual in both halves $(cat "$work/line")"
    else not_ok "driven telescope n=$n" "residual in both halves $(cat "$work/line")" "$work/err"; fi
done

# The axle with its rack held and both wheels on the same bump: one side mirrors the other.
"$FMDSUB" run -q --set 'drives.steering.value=0*t' --set 'forces.road2.value=[0, 0, 330 + 2500*exp(-((t - 0.3)/0.04)^2)]' \
    --columns low1.angle,low2.angle,hub1.z,hub2.z,hub1.qz,hub2.qz decks/axle.yaml >"$work/out" 2>"$work/err"
awk -F, '
    function size(x) { return x < 0 ? -x : x }
    NR > 1 { d = size($2 + $3) + size($4 - $5) + size($6 + $7); if (d > worst) worst = d; if (size($2) > most) most = size($2) }
    END { printf "%.2g of %.2g rad", worst, most; exit !(most > 0.02 && worst < 1e-12) }' "$work/out" >"$work/line"
if [ $? = 0 ]; then ok "axle: left and right differ by $(cat "$work/line")"
else not_ok "axle: left and right" "differ by $(cat "$work/line")" "$work/err"; fi

# A table that begins on the way: the cart starts with a jerk at 0.1 s, the rod on it takes the impulse, 1.5 rad/s, whole.
cat >"$work/jerk.yaml" <<'END'
fmdsub: 1
bodies:
  cart: {mass: 2, at: [0, 0]}
  rod: {mass: 1, inertia: 1/12, at: [0, -0.5]}
constraints:
  rail: {prismatic: [ground, cart], at: [0, 0], axis: [1, 0]}
  pin: {revolute: [cart, rod], at: [0, 0]}
drives: {mv: {drive: rail, value: {table: [[0.1, 0], [0.3, 0.2], [0.6, 0.2]]}}}
integrate: {until: 0.2}
output: {every: 0.1, columns: [pin.angle_rate, energy.residual]}
END
for scheme in midpoint newmark generalized-alpha hht subcycle rk4; do
    for how in step=1.0e-3 tolerance=1.0e-6; do echo "$scheme $how"; done
done >"$work/ways"
for scheme in dopri5 dop853 radau5 radau9; do echo "$scheme tolerance=1.0e-8"; done >>"$work/ways"
while read -r scheme how; do
    "$FMDSUB" run -q --set integrate.scheme=$scheme --set integrate.$how "$work/jerk.yaml" >"$work/out" 2>"$work/err" </dev/null
    said=$(awk -F, 'END { print (NR == 4 && $2 > -1.50001 && $2 < -1.49999 && $3 < 1e-4 && $3 > -1e-4) ? "whole" : $2 " rad/s, " $3 " J" }' "$work/out")
    expect "a table that begins on the way: $scheme, $how" whole "$said" "$work/err"
done <"$work/ways"

# A blow somewhere in a step to what floats: the momenta are kept, and the books are 1e-4 of the energy off at this step, not more.
for share in 0.3 0.7; do
    at=$(awk "BEGIN { print 0.5 + $share * 0.02 }")
    cat >"$work/floats.yaml" <<END
fmdsub: 1
effects: {momentum: true}
bodies:
  a: {mass: 3, inertia: 0.4, at: [0.15, 0.05]}
  b: {mass: 1, inertia: 0.08, at: [1.1, 0.15]}
  c: {mass: 0.7, inertia: 0.05, at: [1.95, 0.2]}
constraints:
  ab: {revolute: [a, b], at: [0.65, 0.15]}
  bc: {revolute: [b, c], at: [1.55, 0.15]}
  go: {free: [ground, a], at: [0, 0]}
forces: {s: {spring: ab, stiffness: 6}}
drives: {d: {drive: bc.angle, value: "if(t < $at, 0, t - $at)"}}
initial: {ab.angle: 0.6, go.x_rate: 0.2, go.y_rate: -0.1, go.angle_rate: 1, ab.angle_rate: -2.5}
integrate: {scheme: midpoint, step: 0.02, until: 1}
output: {every: 0.5, columns: [momentum.x, momentum.y, momentum.lz, energy.residual]}
END
    "$FMDSUB" run -q "$work/floats.yaml" >"$work/out" 2>"$work/err"
    said=$(awk -F, '
        function off(a, b) { return a > b ? a - b : b - a }
        NR == 2 { for (k = 2; k <= 4; k++) first[k] = $k }
        NR == 4 { for (k = 2; k <= 4; k++) moved += off($k, first[k]); print (moved < 1e-11 && off($5, 0) < 2e-4) ? "kept" : moved " " $5 " J" }' "$work/out")
    expect "a blow at $share of a step to what floats" kept "$said" "$work/out" "$work/err"
done

# A stroke that is counted from the drawn length is the same motion as one that is given whole.
ram='fmdsub: 1
gravity: [0, -9.81]
bodies: {arm: {mass: 2, inertia: 0.2, at: [0.5, 0.3]}}
constraints: {pin: {revolute: [ground, arm], at: [0, 0]}}
measures: {ram: {distance: [[1, -1], arm]}}
drives: {push: {drive: ram, value: VALUE}}
integrate: {scheme: midpoint, step: 1.0e-3, until: 1}
output: {every: 0.1, columns: [pin.angle, pin.angle_rate, push.force]}'
for kind in expression table; do
    case $kind in
    expression) stroke='0.1*sin(3*t)^2' whole="'sqrt(1.94) + 0.1*sin(3*t)^2'" ;;
    *) stroke='{table: [[0, 0], [0.5, 0.05], [1, 0.2]]}' whole='{table: [[0, sqrt(1.94)], [0.5, sqrt(1.94) + 0.05], [1, sqrt(1.94) + 0.2]]}' ;;
    esac
    echo "$ram" | sed "s|VALUE|$whole|" >"$work/whole.yaml"
    echo "$ram" | sed "s|VALUE|$stroke, from: drawn|" >"$work/drawn.yaml"
    for deck in whole drawn; do "$FMDSUB" run -q "$work/$deck.yaml" >"$work/$deck.csv" 2>"$work/err"; done
    "$FMDSUB" diff -q --rel 1.0e-9 "$work/whole.csv" "$work/drawn.csv" >"$work/out" 2>&1
    expect "a stroke from the drawn length, $kind" "0 11" "$? $(($(wc -l <"$work/drawn.csv") - 1))" "$work/out" "$work/err"
done
