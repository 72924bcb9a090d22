# C09: one ball hits two that touch: both impacts at once give (-1/3, 2/3, 2/3); springs between give the linear chain's.
touching 1e-9 'END { printf "%.2g", abs($2 + 1 / 3) + abs($3 - 2 / 3) + abs($4 - 2 / 3) }' <<'DECK'
fmdsub: 1
bodies: {a: {mass: 1, inertia: 1, at: [-1, 0]}, b: {mass: 1, inertia: 1, at: [0.2, 0]}, c: {mass: 1, inertia: 1, at: [0.4, 0]}}
constraints: {fa: {prismatic: [ground, a], axis: [1, 0]}, fb: {prismatic: [ground, b], axis: [1, 0]}, fc: {prismatic: [ground, c], axis: [1, 0]}}
surfaces: {sa: {sphere: a, radius: 0.1}, sb: {sphere: b, radius: 0.1}, sc: {sphere: c, radius: 0.1}}
contacts: {ab: {between: [sa, sb], restitution: 1}, bc: {between: [sb, sc], restitution: 1}}
initial: {fa.displacement_rate: 1}
integrate: {step: 1.0e-2, until: 2}
output: {every: 2, columns: [a.vx, b.vx, c.vx]}
DECK
for scheme in midpoint newmark subcycle; do
    row $scheme 1e-5 'END { printf "%.2g", abs($2 + 0.130261695064521) + abs($3 - 0.150229569434774) + abs($4 - 0.980032125629747) }' <<'DECK'
fmdsub: 1
bodies: {a: {mass: 1, inertia: 1, at: [0, 0]}, b: {mass: 1, inertia: 1, at: [1, 0]}, c: {mass: 1, inertia: 1, at: [2, 0]}}
constraints: {fa: {prismatic: [ground, a], axis: [1, 0]}, fb: {prismatic: [ground, b], axis: [1, 0]}, fc: {prismatic: [ground, c], axis: [1, 0]}}
measures: {ab: {distance: [a, b]}, bc: {distance: [b, c]}}
forces: {kab: {unilateral: ab, stiffness: 1, from: 1, side: below}, kbc: {unilateral: bc, stiffness: 1, from: 1, side: below}}
initial: {fa.displacement_rate: 0.01}
integrate: {step: 1.0e-3, until: 30}
output: {every: 30, columns: [{a: a.vx/0.01}, {b: b.vx/0.01}, {c: c.vx/0.01}]}
DECK
done
