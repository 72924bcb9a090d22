# contacts.sh -- rigid contacts where outsiders broke them: fast, small, driven.
. tests/tools/lib.sh

# 250 impacts a step without loss: the speed stays.
cat >"$work/fast.yaml" <<'END'
fmdsub: 1
bodies: {a: {mass: 1, inertia: 1, at: [0, 0]}}
constraints: {s: {prismatic: [ground, a], axis: [1, 0], range: {lower: -1, upper: 1, hold: {restitution: 1}}}}
initial: {s.displacement_rate: 1000}
integrate: {step: 1, until: 2}
output: {every: 1, columns: [a.vx, s.upper.impacts, s.lower.impacts]}
END
"$FMDSUB" run -q "$work/fast.yaml" >"$work/out" 2>"$work/err"
expect "two stops, 500 impacts a step: speed, impacts" "1000 1000" \
    "$(tail -n 1 "$work/out" | awk -F, '{ v = $2 < 0 ? -$2 : $2; printf "%.9g %d", v, $3 + $4 }')" "$work/out"

# Two discs that would pass through each other between two ends of steps; closed form of the oblique impact.
cat >"$work/pass.yaml" <<'END'
fmdsub: 1
bodies: {a: {mass: 1, inertia: 1, at: [-1, 0]}, b: {mass: 1, inertia: 1, at: [1, 0.05]}}
constraints: {fa: {free: [ground, a], at: [-1, 0]}, fb: {free: [ground, b], at: [1, 0.05]}}
surfaces: {sa: {sphere: a, radius: 0.1}, sb: {sphere: b, radius: 0.1}}
contacts: {c: {between: [sa, sb], restitution: 1}}
initial: {fa.x_rate: 1000, fb.x_rate: -1000}
integrate: {step: 2.0e-3, until: 0.1}
output: {every: 0.1, columns: [a.vx, a.vy, c.impacts]}
END
for step in 2.0e-3 1.25e-2 5.0e-2 1.0e-4; do
    "$FMDSUB" run -q -s integrate.step=$step "$work/pass.yaml" >"$work/out" 2>"$work/err"
    expect "discs that meet within a step of $step s" "-875.000 -484.123 1" \
        "$(tail -n 1 "$work/out" | awk -F, '{ printf "%.3f %.3f %d", $2, $3, $4 }')" "$work/out"
done

# A ball of any size slides, then rolls on at 5/7 of its speed.
cat >"$work/roll.yaml" <<'END'
fmdsub: 1
parameters: {s: 1, m: 4000*s^3, I: 0.4*4000*s^5}
gravity: [0, -9.81]
bodies: {b: {mass: m, inertia: I, at: [0, s]}}
constraints: {f: {free: [ground, b]}}
surfaces: {floor: {plane: ground, at: [0, 0], normal: [0, 1]}, ball: {sphere: b, radius: s}}
contacts: {c: {between: [ball, floor], friction: 0.3}}
initial: {f.x_rate: sqrt(s)}
integrate: {step: 1.0e-3*sqrt(s), until: 2*sqrt(s)}
output: {every: 0.5*sqrt(s), columns: [{part: b.vx/sqrt(s)}]}
END
for s in 1 1.0e-2 1.0e-4 1.0e-6; do
    "$FMDSUB" run -q -s parameters.s=$s "$work/roll.yaml" >"$work/out" 2>"$work/err"
    expect "a ball of $s m: 5/7" 0.714286 "$(tail -n 1 "$work/out" | awk -F, '{ printf "%.6f", $2 }')" "$work/out"
done

# Driven into a plane: nothing gives way, and the run ends where they meet; also beside a body that is free.
cat >"$work/driven.yaml" <<'END'
fmdsub: 1
bodies: {p: {mass: 1, inertia: 1, at: [0, 1]}}
constraints: {sl: {prismatic: [ground, p], axis: [0, 1]}}
surfaces: {floor: {plane: ground, at: [0, 0], normal: [0, 1]}, tip: {point: p}}
contacts: {c: {between: [tip, floor]}}
drives: {d: {drive: sl.displacement, value: "-2*t"}}
integrate: {step: 1.0e-3, until: 1}
output: {every: 0.1, columns: [p.y]}
END
sed 's/^bodies: {/&z: {mass: 1, inertia: 1, at: [5, 5]}, /; s/^constraints: {/&zf: {free: [ground, z], at: [5, 5]}, /' "$work/driven.yaml" >"$work/beside.yaml"
for deck in driven beside; do
    "$FMDSUB" run -q "$work/$deck.yaml" >"$work/out" 2>"$work/err"
    expect "$deck: status" 5 $? "$work/err"
    expect "$deck: where they meet" 1 "$(grep -cE "stopped at t = 0\.(5|499)[0-9]* s.*'c'" "$work/err")" "$work/err"
done
