# piles.sh -- boxes and discs that fall on each other with friction in the plane.  Drawn at random; 155 once jammed where a
# foot lay within 1 nm of a corner, 54 and 230 never ended: beside a point that another impact had left 0.5 nm inside, no part of a
# step moved on; 147 once gained 1 J where rates were settled to round-off only; 1032 lost 0.5 mJ where an impact had turned
# round what slides elsewhere, which was taken to stick; 1094 made 34 PJ where the place of an impact was not found in 60 trials,
# 0.2 um inside.
. tests/tools/lib.sh

# pile NAME: the deck by standard input; it runs to its end, and keeps its energy to 10 uJ of some 30 J.
pile()
{
    cat >"$work/pile.yaml"
    timeout -s KILL 100 "$FMDSUB" run -q "$work/pile.yaml" >"$work/out" 2>"$work/err"
    expect "pile $1: status, end, energy" "0 1.5 1" \
        "$? $(tail -n 1 "$work/out" | awk -F, '{ print $1, (NF == 4 && $4 * $4 < 1e-10) }')" "$work/err"
}

pile 54 <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies:
  b0: {mass: 1, inertia: 0.0215861, at: [0.075, 0.266000], points: {a: [-0.2265, -0.116], b: [0.2265, -0.116], c: [0.2265, 0.116], d: [-0.2265, 0.116]}}
  b1: {mass: 1, inertia: 0.0462231, at: [-0.045, 0.704000], points: {a: [-0.3395, -0.153], b: [0.3395, -0.153], c: [0.3395, 0.153], d: [-0.3395, 0.153]}}
  b2: {mass: 1, inertia: 0.0264097, at: [-0.066, 0.928000], points: {a: [-0.277, -0.05], b: [0.277, -0.05], c: [0.277, 0.05], d: [-0.277, 0.05]}}
constraints:
  f0: {planar: [ground, b0], at: [0.075, 0.266000]}
  f1: {planar: [ground, b1], at: [-0.045, 0.704000]}
  f2: {planar: [ground, b2], at: [-0.066, 0.928000]}
surfaces:
  floor: {plane: ground, at: [0, 0], normal: [0, 1]}
  p0: {points: [b0.a, b0.b, b0.c, b0.d]}
  f0: {points: [b0.a, b0.b]}
  t0: {plane: b0, at: [0.075, 0.382000], normal: [0, 1]}
  u0: {plane: b0, at: [0.075, 0.150000], normal: [0, -1]}
  p1: {points: [b1.a, b1.b, b1.c, b1.d]}
  f1: {points: [b1.a, b1.b]}
  t1: {plane: b1, at: [-0.045, 0.857000], normal: [0, 1]}
  u1: {plane: b1, at: [-0.045, 0.551000], normal: [0, -1]}
  p2: {points: [b2.a, b2.b, b2.c, b2.d]}
  f2: {points: [b2.a, b2.b]}
  t2: {plane: b2, at: [-0.066, 0.978000], normal: [0, 1]}
  u2: {plane: b2, at: [-0.066, 0.878000], normal: [0, -1]}
contacts:
  g0: {between: [p0, floor], friction: 0.5, restitution: 0.3}
  g1: {between: [p1, floor], friction: 0.5}
  k1: {between: [f1, t0], friction: 0.5}
  g2: {between: [p2, floor], friction: 0.8}
  k2: {between: [f2, t1], friction: 0.8}
initial: {f0.angle: 0, f0.x_rate: -0.6, f1.angle: 0, f1.angle_rate: 1.999, f1.x_rate: -0.444, f2.angle: 0}
integrate: {scheme: midpoint, step: 1.0e-3, until: 1.5}
output: {every: 0.5, columns: [b0.x, b0.y, energy.residual]}
END

pile 147 <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies:
  b0: {mass: 23.021, inertia: 0.493213, at: [0.047, 0.344000]}
  b1: {mass: 1.413, inertia: 0.1158, at: [0.018, 0.833964], points: {a: [-0.448, -0.2125], b: [0.448, -0.2125], c: [0.448, 0.2125], d: [-0.448, 0.2125]}}
  b2: {mass: 1, inertia: 0.0313414, at: [0.051, 1.456164], points: {a: [-0.232, -0.2005], b: [0.232, -0.2005], c: [0.232, 0.2005], d: [-0.232, 0.2005]}}
  b3: {mass: 1, inertia: 0.0209451, at: [-0.025, 2.039525], points: {a: [-0.225, -0.1105], b: [0.225, -0.1105], c: [0.225, 0.1105], d: [-0.225, 0.1105]}}
  b4: {mass: 1, inertia: 0.0831668, at: [-0.029, 2.532676], points: {a: [-0.4405, -0.2355], b: [0.4405, -0.2355], c: [0.4405, 0.2355], d: [-0.4405, 0.2355]}}
  b5: {mass: 0.112, inertia: 0.00575405, at: [-0.04, 3.060741], points: {a: [-0.3265, -0.218], b: [0.3265, -0.218], c: [0.3265, 0.218], d: [-0.3265, 0.218]}}
constraints:
  f0: {planar: [ground, b0], at: [0.047, 0.344000]}
  f1: {planar: [ground, b1], at: [0.018, 0.833964]}
  f2: {planar: [ground, b2], at: [0.051, 1.456164]}
  f3: {planar: [ground, b3], at: [-0.025, 2.039525]}
  f4: {planar: [ground, b4], at: [-0.029, 2.532676]}
  f5: {planar: [ground, b5], at: [-0.04, 3.060741]}
surfaces:
  floor: {plane: ground, at: [0, 0], normal: [0, 1]}
  s0: {sphere: b0, radius: 0.207}
  p1: {points: [b1.a, b1.b, b1.c, b1.d]}
  f1: {points: [b1.a, b1.b]}
  t1: {plane: b1, at: [0.018, 1.046464], normal: [0, 1]}
  u1: {plane: b1, at: [0.018, 0.621464], normal: [0, -1]}
  p2: {points: [b2.a, b2.b, b2.c, b2.d]}
  f2: {points: [b2.a, b2.b]}
  t2: {plane: b2, at: [0.051, 1.656664], normal: [0, 1]}
  u2: {plane: b2, at: [0.051, 1.255664], normal: [0, -1]}
  p3: {points: [b3.a, b3.b, b3.c, b3.d]}
  f3: {points: [b3.a, b3.b]}
  t3: {plane: b3, at: [-0.025, 2.150025], normal: [0, 1]}
  u3: {plane: b3, at: [-0.025, 1.929025], normal: [0, -1]}
  p4: {points: [b4.a, b4.b, b4.c, b4.d]}
  f4: {points: [b4.a, b4.b]}
  t4: {plane: b4, at: [-0.029, 2.768176], normal: [0, 1]}
  u4: {plane: b4, at: [-0.029, 2.297176], normal: [0, -1]}
  p5: {points: [b5.a, b5.b, b5.c, b5.d]}
  f5: {points: [b5.a, b5.b]}
  t5: {plane: b5, at: [-0.04, 3.278741], normal: [0, 1]}
  u5: {plane: b5, at: [-0.04, 2.842741], normal: [0, -1]}
contacts:
  g0: {between: [s0, floor], friction: 0.5}
  g1: {between: [p1, floor], friction: 0.3}
  k1: {between: [s0, u1], friction: 0.3}
  g2: {between: [p2, floor], friction: 0.3, restitution: 0.8}
  k2: {between: [f2, t1], friction: 0.3, restitution: 0.8}
  g3: {between: [p3, floor], friction: 0.8}
  k3: {between: [f3, t2], friction: 0.8}
  g4: {between: [p4, floor], friction: 0.1}
  k4: {between: [f4, t3], friction: 0.1}
  g5: {between: [p5, floor], friction: 1.2, restitution: 0.8}
  k5: {between: [f5, t4], friction: 1.2, restitution: 0.8}
initial: {f1.angle: 0.068, f1.x_rate: 0.333, f2.angle: 0.098, f2.angle_rate: 0.943, f3.angle: 0.145, f4.angle: -0.092, f5.angle: -0.043, f5.angle_rate: 0.087}
integrate: {scheme: midpoint, step: 1.0e-3, until: 1.5}
output: {every: 0.5, columns: [b0.x, b0.y, energy.residual]}
END

pile 155 <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies:
  b0: {mass: 1, inertia: 0.0171125, at: [-0.017, 0.454000]}
  b1: {mass: 1, inertia: 0.0708533, at: [-0.08, 1.022352], points: {a: [-0.456, -0.068], b: [0.456, -0.068], c: [0.456, 0.068], d: [-0.456, 0.068]}}
  b2: {mass: 6.361, inertia: 0.306454, at: [0.016, 1.325623], points: {a: [-0.373, -0.0735], b: [0.373, -0.0735], c: [0.373, 0.0735], d: [-0.373, 0.0735]}}
  b3: {mass: 1, inertia: 0.0273401, at: [0.032, 1.646705], points: {a: [-0.2125, -0.192], b: [0.2125, -0.192], c: [0.2125, 0.192], d: [-0.2125, 0.192]}}
  b4: {mass: 1, inertia: 0.0257645, at: [-0.039, 2.140867]}
  b5: {mass: 1, inertia: 0.0861281, at: [-0.028, 2.739015], points: {a: [-0.458, -0.2205], b: [0.458, -0.2205], c: [0.458, 0.2205], d: [-0.458, 0.2205]}}
constraints:
  f0: {planar: [ground, b0], at: [-0.017, 0.454000]}
  f1: {planar: [ground, b1], at: [-0.08, 1.022352]}
  f2: {planar: [ground, b2], at: [0.016, 1.325623]}
  f3: {planar: [ground, b3], at: [0.032, 1.646705]}
  f4: {planar: [ground, b4], at: [-0.039, 2.140867]}
  f5: {planar: [ground, b5], at: [-0.028, 2.739015]}
surfaces:
  floor: {plane: ground, at: [0, 0], normal: [0, 1]}
  s0: {sphere: b0, radius: 0.185}
  p1: {points: [b1.a, b1.b, b1.c, b1.d]}
  f1: {points: [b1.a, b1.b]}
  t1: {plane: b1, at: [-0.08, 1.090352], normal: [0, 1]}
  u1: {plane: b1, at: [-0.08, 0.954352], normal: [0, -1]}
  p2: {points: [b2.a, b2.b, b2.c, b2.d]}
  f2: {points: [b2.a, b2.b]}
  t2: {plane: b2, at: [0.016, 1.399123], normal: [0, 1]}
  u2: {plane: b2, at: [0.016, 1.252123], normal: [0, -1]}
  p3: {points: [b3.a, b3.b, b3.c, b3.d]}
  f3: {points: [b3.a, b3.b]}
  t3: {plane: b3, at: [0.032, 1.838704], normal: [0, 1]}
  u3: {plane: b3, at: [0.032, 1.454705], normal: [0, -1]}
  s4: {sphere: b4, radius: 0.227}
  p5: {points: [b5.a, b5.b, b5.c, b5.d]}
  f5: {points: [b5.a, b5.b]}
  t5: {plane: b5, at: [-0.028, 2.959515], normal: [0, 1]}
  u5: {plane: b5, at: [-0.028, 2.518515], normal: [0, -1]}
contacts:
  g0: {between: [s0, floor], friction: 0.8, restitution: 0.3}
  g1: {between: [p1, floor], friction: 0.5}
  k1: {between: [s0, u1], friction: 0.5}
  g2: {between: [p2, floor], friction: 0.5, restitution: 0.5}
  k2: {between: [f2, t1], friction: 0.5, restitution: 0.5}
  g3: {between: [p3, floor], friction: 0.5}
  k3: {between: [f3, t2], friction: 0.5}
  g4: {between: [s4, floor], friction: 0.5, restitution: 0.3}
  k4: {between: [s4, t3], friction: 0.5, restitution: 0.3}
  g5: {between: [p5, floor], friction: 0.8}
  k5: {between: [s4, u5], friction: 0.8}
initial: {f1.angle: 0.117, f1.angle_rate: -1.869, f2.angle: 0.103, f2.x_rate: 0.272, f3.angle: -0.029, f3.angle_rate: 1.404, f3.x_rate: 0.882, f5.angle: -0.056}
integrate: {scheme: midpoint, step: 1.0e-3, until: 1.5}
output: {every: 0.5, columns: [b0.x, b0.y, energy.residual]}
END

pile 230 <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies:
  b0: {mass: 1, inertia: 0.0143683, at: [0.076, 0.363240], points: {a: [-0.156, -0.137], b: [0.156, -0.137], c: [0.156, 0.137], d: [-0.156, 0.137]}}
  b1: {mass: 1, inertia: 0.0652304, at: [-0.038, 0.570980], points: {a: [-0.439, -0.0545], b: [0.439, -0.0545], c: [0.439, 0.0545], d: [-0.439, 0.0545]}}
  b2: {mass: 1.358, inertia: 0.0112992, at: [0.044, 0.859480]}
constraints:
  f0: {planar: [ground, b0], at: [0.076, 0.363240]}
  f1: {planar: [ground, b1], at: [-0.038, 0.570980]}
  f2: {planar: [ground, b2], at: [0.044, 0.859480]}
surfaces:
  floor: {plane: ground, at: [0, 0], normal: [0, 1]}
  p0: {points: [b0.a, b0.b, b0.c, b0.d]}
  f0: {points: [b0.a, b0.b]}
  t0: {plane: b0, at: [0.076, 0.500240], normal: [0, 1]}
  u0: {plane: b0, at: [0.076, 0.226240], normal: [0, -1]}
  p1: {points: [b1.a, b1.b, b1.c, b1.d]}
  f1: {points: [b1.a, b1.b]}
  t1: {plane: b1, at: [-0.038, 0.625480], normal: [0, 1]}
  u1: {plane: b1, at: [-0.038, 0.516480], normal: [0, -1]}
  s2: {sphere: b2, radius: 0.129}
contacts:
  g0: {between: [p0, floor], friction: 0.8, restitution: 0.5}
  g1: {between: [p1, floor], friction: 0.8, restitution: 0.8}
  k1: {between: [f1, t0], friction: 0.8, restitution: 0.8}
  g2: {between: [s2, floor], friction: 0}
  k2: {between: [s2, t1], friction: 0}
initial: {f0.angle: 0.04, f0.angle_rate: -0.368, f1.angle: 0, f1.x_rate: -0.047, f2.x_rate: -0.549}
integrate: {scheme: midpoint, step: 1.0e-3, until: 1.5}
output: {every: 0.5, columns: [b0.x, b0.y, energy.residual]}
END

pile 1032 <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies:
  b0: {mass: 1, inertia: 0.0215895, at: [-0.054, 0.190400], points: {a: [-0.2379, -0.0904], b: [0.2379, -0.0904], c: [0.2379, 0.0904], d: [-0.2379, 0.0904]}}
  b1: {mass: 1, inertia: 0.0480475, at: [0.035, 0.583500], points: {a: [-0.3662, -0.1002], b: [0.3662, -0.1002], c: [0.3662, 0.1002], d: [-0.3662, 0.1002]}}
  b2: {mass: 1, inertia: 0.0651467, at: [-0.06, 1.046500], points: {a: [-0.412, -0.1603], b: [0.412, -0.1603], c: [0.412, 0.1603], d: [-0.412, 0.1603]}}
  b3: {mass: 1, inertia: 0.0447114, at: [0.025, 1.532500], points: {a: [-0.3449, -0.1232], b: [0.3449, -0.1232], c: [0.3449, 0.1232], d: [-0.3449, 0.1232]}}
  b4: {mass: 1, inertia: 0.0475922, at: [-0.013, 2.007135], points: {a: [-0.339, -0.1669], b: [0.339, -0.1669], c: [0.339, 0.1669], d: [-0.339, 0.1669]}}
constraints:
  f0: {planar: [ground, b0], at: [-0.054, 0.190400]}
  f1: {planar: [ground, b1], at: [0.035, 0.583500]}
  f2: {planar: [ground, b2], at: [-0.06, 1.046500]}
  f3: {planar: [ground, b3], at: [0.025, 1.532500]}
  f4: {planar: [ground, b4], at: [-0.013, 2.007135]}
surfaces:
  floor: {plane: ground, at: [0, 0], normal: [0, 1]}
  p0: {points: [b0.a, b0.b, b0.c, b0.d]}
  f0: {points: [b0.a, b0.b]}
  t0: {plane: b0, at: [-0.054, 0.280800], normal: [0, 1]}
  u0: {plane: b0, at: [-0.054, 0.100000], normal: [0, -1]}
  p1: {points: [b1.a, b1.b, b1.c, b1.d]}
  f1: {points: [b1.a, b1.b]}
  t1: {plane: b1, at: [0.035, 0.683700], normal: [0, 1]}
  u1: {plane: b1, at: [0.035, 0.483300], normal: [0, -1]}
  p2: {points: [b2.a, b2.b, b2.c, b2.d]}
  f2: {points: [b2.a, b2.b]}
  t2: {plane: b2, at: [-0.06, 1.206800], normal: [0, 1]}
  u2: {plane: b2, at: [-0.06, 0.886200], normal: [0, -1]}
  p3: {points: [b3.a, b3.b, b3.c, b3.d]}
  f3: {points: [b3.a, b3.b]}
  t3: {plane: b3, at: [0.025, 1.655700], normal: [0, 1]}
  u3: {plane: b3, at: [0.025, 1.409300], normal: [0, -1]}
  p4: {points: [b4.a, b4.b, b4.c, b4.d]}
  f4: {points: [b4.a, b4.b]}
  t4: {plane: b4, at: [-0.013, 2.174035], normal: [0, 1]}
  u4: {plane: b4, at: [-0.013, 1.840235], normal: [0, -1]}
contacts:
  g0: {between: [p0, floor], friction: 0, restitution: 0.5}
  g1: {between: [p1, floor], friction: 0.3, restitution: 0.3}
  k1: {between: [f1, t0], friction: 0.3, restitution: 0.3}
  g2: {between: [p2, floor], friction: 1.2, restitution: 0.3}
  k2: {between: [f2, t1], friction: 1.2, restitution: 0.3}
  g3: {between: [p3, floor], friction: 0.3, restitution: 0.8}
  k3: {between: [f3, t2], friction: 0.3, restitution: 0.8}
  g4: {between: [p4, floor], friction: 0.5}
  k4: {between: [f4, t3], friction: 0.5}
initial: {f3.angle_rate: 0.165, f4.angle: -0.09, f4.angle_rate: 0.522}
integrate: {scheme: midpoint, step: 0.001, until: 1.5}
output: {every: 0.5, columns: [b0.x, b0.y, energy.residual]}
END

pile 1094 <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies:
  b0: {mass: 1, inertia: 0.0132845, at: [0.026, 0.313000]}
  b1: {mass: 1, inertia: 0.0512694, at: [-0.003, 0.605800], points: {a: [-0.3765, -0.1098], b: [0.3765, -0.1098], c: [0.3765, 0.1098], d: [-0.3765, 0.1098]}}
  b2: {mass: 0.144, inertia: 0.00161194, at: [-0.031, 0.972800], points: {a: [-0.1749, -0.0547], b: [0.1749, -0.0547], c: [0.1749, 0.0547], d: [-0.1749, 0.0547]}}
  b3: {mass: 1, inertia: 0.0422077, at: [0.013, 1.458600], points: {a: [-0.2727, -0.2286], b: [0.2727, -0.2286], c: [0.2727, 0.2286], d: [-0.2727, 0.2286]}}
  b4: {mass: 0.514, inertia: 0.0166418, at: [-0.004, 2.059268], points: {a: [-0.2415, -0.197], b: [0.2415, -0.197], c: [0.2415, 0.197], d: [-0.2415, 0.197]}}
  b5: {mass: 1, inertia: 0.0190652, at: [0.069, 2.403936], points: {a: [-0.2333, -0.0526], b: [0.2333, -0.0526], c: [0.2333, 0.0526], d: [-0.2333, 0.0526]}}
constraints:
  f0: {planar: [ground, b0], at: [0.026, 0.313000]}
  f1: {planar: [ground, b1], at: [-0.003, 0.605800]}
  f2: {planar: [ground, b2], at: [-0.031, 0.972800]}
  f3: {planar: [ground, b3], at: [0.013, 1.458600]}
  f4: {planar: [ground, b4], at: [-0.004, 2.059268]}
  f5: {planar: [ground, b5], at: [0.069, 2.403936]}
surfaces:
  floor: {plane: ground, at: [0, 0], normal: [0, 1]}
  s0: {sphere: b0, radius: 0.163}
  p1: {points: [b1.a, b1.b, b1.c, b1.d]}
  f1: {points: [b1.a, b1.b]}
  t1: {plane: b1, at: [-0.003, 0.715600], normal: [0, 1]}
  u1: {plane: b1, at: [-0.003, 0.496000], normal: [0, -1]}
  p2: {points: [b2.a, b2.b, b2.c, b2.d]}
  f2: {points: [b2.a, b2.b]}
  t2: {plane: b2, at: [-0.031, 1.027500], normal: [0, 1]}
  u2: {plane: b2, at: [-0.031, 0.918100], normal: [0, -1]}
  p3: {points: [b3.a, b3.b, b3.c, b3.d]}
  f3: {points: [b3.a, b3.b]}
  t3: {plane: b3, at: [0.013, 1.687200], normal: [0, 1]}
  u3: {plane: b3, at: [0.013, 1.230000], normal: [0, -1]}
  p4: {points: [b4.a, b4.b, b4.c, b4.d]}
  f4: {points: [b4.a, b4.b]}
  t4: {plane: b4, at: [-0.004, 2.256268], normal: [0, 1]}
  u4: {plane: b4, at: [-0.004, 1.862268], normal: [0, -1]}
  p5: {points: [b5.a, b5.b, b5.c, b5.d]}
  f5: {points: [b5.a, b5.b]}
  t5: {plane: b5, at: [0.069, 2.456536], normal: [0, 1]}
  u5: {plane: b5, at: [0.069, 2.351336], normal: [0, -1]}
contacts:
  g0: {between: [s0, floor], friction: 0.5, restitution: 0.5}
  g1: {between: [p1, floor], friction: 0.3, restitution: 0.8}
  k1: {between: [s0, u1], friction: 0.3, restitution: 0.8}
  g2: {between: [p2, floor], friction: 0.5}
  k2: {between: [f2, t1], friction: 0.5}
  g3: {between: [p3, floor], friction: 0}
  k3: {between: [f3, t2], friction: 0}
  g4: {between: [p4, floor], friction: 1.2}
  k4: {between: [f4, t3], friction: 1.2}
  g5: {between: [p5, floor], friction: 0.8}
  k5: {between: [f5, t4], friction: 0.8}
initial: {f2.x_rate: -0.213, f4.angle: 0.089, f5.angle_rate: 0.598, f5.x_rate: 0.101}
integrate: {scheme: midpoint, step: 0.0005, until: 1.5}
output: {every: 0.5, columns: [b0.x, b0.y, energy.residual]}
END
