# C01: a ball bounces with restitution 0.5 and comes to rest: its height at 1.15 s, in closed form; schemes that cannot stop at an impact refuse rigid contacts.
want=$(awk 'BEGIN { g = 9.81; t = 1.15; v = sqrt(2 * g); from = sqrt(2 / g); while (1) { v /= 2; last = 2 * v / g; if (t < from + last) { printf "%.15g", (t - from) * (v - g / 2 * (t - from)); exit } from += last } }')
ball() { printf 'fmdsub: 1\ngravity: [0, -9.81]\nbodies: {b: {mass: 1, inertia: 0.1, at: [0, 1]}}\nconstraints: {f: {planar: [ground, b], at: [0, 0]}}\nsurfaces: {floor: {plane: ground, at: [0, 0], normal: [0, 1]}, skin: {point: b}}\ncontacts: {c: {between: [skin, floor], restitution: 0.5}}\nintegrate: {step: %s, until: 1.15}\noutput: {every: 1.15, columns: [b.y]}\n' $1; }
for step in 1.0e-2 1.0e-3 2.3e-2; do
    ball $step | touching 1e-9 'END { printf "%.2g", abs($2 - '$want') }'
done
for scheme in newmark generalized-alpha miao; do ball 1.0e-2 | row $scheme told 'rigid'; done
