# turns.sh -- an angle in space, which a posture gives up to whole turns, goes on through half a turn: as a column, under
# a spring, in an expression and as the end of a run.
. tests/tools/lib.sh

cat >"$work/winding.yaml" <<'END'
fmdsub: 1
space: 3d
gravity: [0, 0, -9.81]
bodies:
  rotor: {mass: 1, inertia: [0.1, 0.2, 0.25], at: [0, 0, 0]}
  disc:  {mass: 1, inertia: [0.1, 0.2, 0.25], at: [0, 0, 1]}
constraints:
  shaft: {revolute: [ground, rotor], at: [0, 0, 0], axis: [0, 0, 1]}
  pin:   {revolute: [rotor, disc], at: [0, 0, 1], axis: [0, 0, 1]}
measures:
  twist: {angle: [rotor, disc], axis: [0, 0, 1]}
  turn:  {angle: [ground, disc], axis: [0, 0, 1]}
  back:  {angle: [disc, rotor], axis: [0, 0, 1]}
forces:
  wind:  {spring: twist, stiffness: 0.5}
  brake: {torque: shaft, value: 0.02*twist}
initial: {shaft.angle_rate: -3, pin.angle_rate: 12}
integrate: {scheme: midpoint, step: 1.0e-3, until: 4}
output: {every: 0.1, columns: [shaft.angle, pin.angle, twist, turn, back, wind.elongation, energy.residual]}
END
for scheme in midpoint newmark subcycle miao rk4 dopri5; do
    how="--set integrate.scheme=$scheme"
    [ $scheme = dopri5 ] && how="$how --set integrate.tolerance=1.0e-8"
    "$FMDSUB" run -q $how "$work/winding.yaml" >"$work/measure" 2>"$work/err"
    ended "winding, $scheme: status" 0 $? "$work/measure" "$work/err"
    "$FMDSUB" run -q $how --set forces.wind.spring=pin --set 'forces.brake.value=0.02*pin.angle' "$work/winding.yaml" >"$work/joint" 2>"$work/err"
    awk -F, '
        function off(d) { d = d < 0 ? -d : d; if (d > worst) worst = d }
        FNR == 1 { next }
        NR == FNR { shaft[$1] = $2; pin[$1] = $3; next }
        { off($2 - shaft[$1]); off($3 - pin[$1]); off($4 - $3); off($5 - $2 - $3); off($6 + $3); off($7 - $3)
          if ($4 > most) most = $4; if ($5 > far) far = $5; rows++ }
        END { printf "%.2g rad apart, wound up by %.3g, turned by %.3g", worst, most, far
              exit !(worst < 1e-9 && most > 5 && far > 13 && rows == 41) }' "$work/joint" "$work/measure" >"$work/line"
    if [ $? = 0 ]; then ok "winding, $scheme: measure and joint $(cat "$work/line")"
    else not_ok "winding, $scheme" "measure and joint $(cat "$work/line")" "$work/err"; fi
done
"$FMDSUB" run -q --set 'integrate.until={when: turn > 10, latest: 4}' "$work/winding.yaml" >"$work/out" 2>"$work/err"
expect "ends when it has turned by 10 rad" yes "$(awk -F, 'END { print ($5 > 10 && $5 < 10.02) ? "yes" : $5 }' "$work/out")" "$work/err"

# The crank of a loop goes round.
"$FMDSUB" run -q --set 'measures={round: {angle: [ground, crank], axis: [0, 0, 1]}}' --set initial.shaft.angle_rate=20 \
    --columns shaft.angle,round tests/decks/spatial-four-bar.yaml >"$work/out" 2>"$work/err"
awk -F, 'NR > 1 { d = $2 - $3; d = d < 0 ? -d : d; if (d > worst) worst = d }
    END { printf "%.2g rad apart, turned by %.3g", worst, $2; exit !(worst < 1e-9 && $2 > 20) }' "$work/out" >"$work/line"
if [ $? = 0 ]; then ok "a loop's crank: measure and joint $(cat "$work/line")"
else not_ok "a loop's crank" "measure and joint $(cat "$work/line")" "$work/err"; fi

# Nearly a turn, and more than one, in every step: the rates tell.
cat >"$work/rotor.yaml" <<'END'
fmdsub: 1
bodies:
  rotor: {mass: 1, inertia: [0.1, 0.2, 0.25], at: [0, 0, 0]}
constraints:
  shaft: {revolute: [ground, rotor], at: [0, 0, 0], axis: [0, 0, 1]}
measures:
  turn: {angle: [ground, rotor], axis: [0, 0, 1]}
forces:
  load: {torque: shaft, value: -0.5*t}
initial: {shaft.angle_rate: 100}
integrate: {scheme: midpoint, step: 0.05, until: 2}
output: {columns: [shaft.angle, turn]}
END
for step in 0.05 0.1; do
    for scheme in midpoint newmark rk4; do
        "$FMDSUB" run -q --set integrate.step=$step --set integrate.scheme=$scheme "$work/rotor.yaml" >"$work/out" 2>"$work/err"
        awk -F, 'NR > 1 { d = $2 - $3; d = d < 0 ? -d : d; if (d > worst) worst = d }
            END { printf "%.2g rad apart, turned by %.4g", worst, $2; exit !(worst < 1e-9 && $2 > 190) }' "$work/out" >"$work/line"
        if [ $? = 0 ]; then ok "$(awk "BEGIN { print 100*$step }") rad a step, $scheme: measure and joint $(cat "$work/line")"
        else not_ok "steps of $step s, $scheme" "measure and joint $(cat "$work/line")" "$work/err"; fi
    done
done

# Half of the winding, and the other half from its end: the spring stays wound.
"$FMDSUB" run -q --until 2 --set integrate.scheme=rk4 --final-state "$work/half.json" "$work/winding.yaml" >"$work/out" 2>"$work/err"
"$FMDSUB" run -q --set integrate.scheme=rk4 "$work/winding.yaml" 2>>"$work/err" | tail -n 1 | cut -d, -f1-6 >"$work/whole"
"$FMDSUB" run -q --set integrate.scheme=rk4 --set 'initial={from: half.json, time: keep}' "$work/winding.yaml" 2>>"$work/err" |
    tail -n 1 | cut -d, -f1-6 >"$work/halves"
same "wound up, then on from there" "$work/whole" "$work/halves"
expect "wound up there" yes "$(awk -F'[ ,]+' '/"twist"/ { print ($2 < -3.2) ? "yes" : $2 }' "$work/half.json")" "$work/half.json"

# Steps of a scheme with its own go over many turns, to and fro: what is driven, and what is thrown.
cat >"$work/fro.yaml" <<'END'
fmdsub: 1
bodies:
  wheel: {mass: 1, inertia: [1, 1, 1], at: [0, 0, 0]}
constraints:
  shaft: {revolute: [ground, wheel], at: [0, 0, 0], axis: [0, 0, 1]}
measures: {turn: {angle: [ground, wheel], axis: [0, 0, 1]}}
forces: {throw: {torque: shaft, value: "-900*sin(3*t)"}}
initial: {shaft.angle_rate: 300}
integrate: {scheme: radau9, tolerance: 1.0e-7, until: 5}
output: {every: 0.5, columns: [shaft.angle, turn]}
END
sed -e '/^forces/d; /^initial/d' -e '$a\
drives: {spin: {drive: shaft, value: "100*sin(3*t)"}}' "$work/fro.yaml" >"$work/driven.yaml"
sed -e 's/^  wheel:.*/&\n  ring: {mass: 1, inertia: [1, 1, 1], at: [0, 0, 0]}/; s/^  shaft:.*/&\n  free: {revolute: [ground, ring], at: [0, 0, 0], axis: [0, 0, 1]}\n  weld: {cylindrical: [ring, wheel], at: [0, 0, 0], axis: [0, 0, 1], loop: true}/' \
    -e 's/columns:.*/columns: [{difference: shaft.angle-free.angle}, weld.angle]}/; $a\
drives: {spin: {drive: shaft, value: "100*sin(3*t)"}, hold: {drive: free, value: "5*t"}}' -e '/^forces/d; /^initial/d' "$work/fro.yaml" >"$work/loop.yaml"
for deck in fro driven loop; do
    for scheme in radau9 radau5 dop853 dopri5; do
        "$FMDSUB" run -q --set integrate.scheme=$scheme "$work/$deck.yaml" >"$work/out" 2>"$work/err"
        awk -F, 'NR > 1 { d = $2 - $3; d = d < 0 ? -d : d; if (d > worst) worst = d; if ($2 > most) most = $2; if ($2 < least) least = $2 }
            END { printf "%.2g rad apart, from %.4g to %.4g", worst, least, most; exit !(worst < 1e-9 && most > 80 && least < -90) }' \
            "$work/out" >"$work/line"
        if [ $? = 0 ]; then ok "to and fro, $deck, $scheme: posture and joint $(cat "$work/line")"
        else not_ok "to and fro, $deck, $scheme" "posture and joint $(cat "$work/line")" "$work/out" "$work/err"; fi
    done
done

# Five steps of several radians each, records between their ends: the angle is followed to these, too.
cat >"$work/between.yaml" <<'END'
fmdsub: 1
bodies:
  yoke: {mass: 1, inertia: [0.1, 0.1, 0.2], at: [0, 0, 0]}
  wheel: {mass: 1, inertia: [0.1, 0.1, 0.2], at: [0, 0, 0]}
constraints:
  post: {revolute: [ground, yoke], at: [0, 0, 0], axis: [1, 0, 0]}
  shaft: {revolute: [yoke, wheel], at: [0, 0, 0], axis: [0, 0, 1]}
measures: {turn: {angle: [yoke, wheel], axis: [0, 0, 1]}}
initial: {shaft.angle_rate: 3, post.angle_rate: 0.3}
integrate: {scheme: dopri5, tolerance: 1.0e-4, until: 10}
output: {every: 0.25, columns: [shaft.angle, turn]}
END
"$FMDSUB" run "$work/between.yaml" >"$work/out" 2>"$work/err"
steps=$(sed -n 's/^done at.*: \([0-9]*\) major.*/\1/p' "$work/err")
awk -F, -v steps="$steps" 'NR > 1 { d = $2 - $3; d = d < 0 ? -d : d; if (d > worst) worst = d }
    END { printf "%.2g rad apart, turned by %.4g in %d steps", worst, $2, steps
          exit !(worst < 1e-9 && $2 > 29 && NR == 42 && steps > 0 && steps < 20) }' "$work/out" >"$work/line"
if [ $? = 0 ]; then ok "records between steps: posture and joint $(cat "$work/line")"
else not_ok "records between steps" "posture and joint $(cat "$work/line")" "$work/out" "$work/err"; fi

# A ball turns by five radians in a major step: its quaternion does not tell, its rates do.
cat >"$work/top.yaml" <<'END'
fmdsub: 1
gravity: [0, 0, 0]
bodies:
  top: {mass: 1, inertia: [0.1, 0.1, 0.2], at: [0, 0, 0]}
  slow: {mass: 1, inertia: [1, 1, 1], at: [0, 0, 3]}
constraints: {j: {free: [ground, top]}, k: {prismatic: [ground, slow], axis: [0, 0, 1]}}
measures: {m: {angle: [ground, top], axis: [0, 0, 1]}}
initial: {j.omega_z: 10}
partition: {fast: [j]}
integrate: {scheme: subcycle, step: 0.005, ratio: 100, until: 5}
output: {every: 1, columns: [m]}
END
"$FMDSUB" run -q "$work/top.yaml" >"$work/out" 2>"$work/err"
expect "a ball, five radians in a major step" 49.99 "$(tail -n 1 "$work/out" | awk -F, '{ printf "%.4g", $2 }')" "$work/err"

# A spring about all axes alike comes round by half a turn: the same whichever axes its marker has.
cat >"$work/alike.yaml" <<'END'
fmdsub: 1
gravity: [0, 0, 0]
bodies: {rotor: {mass: 1, inertia: [0.1, 0.2, 0.25], at: [0, 0, 0]}}
constraints: {ball: {spherical: [ground, rotor], at: [0, 0, 0]}}
forces: {round: {bushing: [ground, rotor], at: [0, 0, 0], axis: [0, 0, 1], rotation: [2, 2, 2]}}
initial: {ball.omega_x: 0.6, ball.omega_z: 20}
integrate: {step: 1.0e-3, until: 0.6, newton_tolerance: 1.0e-13}
output: {every: 0.05, columns: [rotor.wx, rotor.wy, rotor.wz]}
END
for scheme in midpoint subcycle; do
    "$FMDSUB" run -q --set integrate.scheme=$scheme "$work/alike.yaml" >"$work/z" 2>"$work/err"
    for axis in "[1, 0, 0]" "[0.3, 0.5, -1]"; do
        "$FMDSUB" run -q --set integrate.scheme=$scheme --set "forces.round.axis=$axis" "$work/alike.yaml" >"$work/out" 2>"$work/err"
        paste -d , "$work/z" "$work/out" | awk -F, '
            NR > 1 { for (i = 1; i <= 4; i++) { d = $i - $(i + 4); d = d < 0 ? -d : d; if (d > worst) worst = d } rows++ }
            END { printf "%.2g rad/s apart", worst; exit !(rows == 13 && $4 > 19 && $4 < 20 && worst < 1e-10) }' >"$work/line"
        if [ $? = 0 ]; then ok "half a turn round, $scheme, axis $axis: $(cat "$work/line")"
        else not_ok "half a turn round, $scheme, axis $axis" "$(cat "$work/line")" "$work/out" "$work/err"; fi
    done
done
