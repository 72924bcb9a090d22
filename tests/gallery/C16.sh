# C16: a roller on a cam, whose lift is known; a disc that rolls without slip in a bowl, a pendulum; the curves are tables.
awk 'BEGIN { for (i = 0; i < 144; i++) { a = 8 * atan2(1, 1) * i / 144; b = a - 2 * atan2(1, 1)
    printf "%.17g,%.17g\n", a, .01 * cos(b) + sqrt(.0016 - (.01 * sin(b)) ^ 2) } }' >lobe.csv
awk 'BEGIN { for (i = 0; i <= 360; i++) { x = -.9 + .005 * i; printf "%.17g,%.17g\n", x, 1 - sqrt(1 - x * x) } }' >bowl.csv
for law in ':midpoint' stiff:midpoint stiff:newmark stiff:subcycle; do
    give=
    case $law in *stiff*) give='--set contacts.lift.stiffness=1.0e+8 --set contacts.lift.damping=500' ;; esac
    row "${law##*:}" 1e-6 'NR > 1 { x = -.01 * sin($2); see(.01 * cos($2) + sqrt(.0025 - x * x) - $3) } END { printf "%.2g", worst }' $give <<'DECK'
fmdsub: 1
gravity: [0, -9.81]
bodies: {cam: {mass: 1, inertia: 1.0e-3, at: [0, 0]}, follower: {mass: 0.2, inertia: 1.0e-4, at: [0, 0.06]}}
constraints: {shaft: {revolute: [ground, cam], at: [0, 0]}, guide: {prismatic: [ground, follower], axis: [0, 1]}}
forces: {spring: {spring: guide, stiffness: 2000, rest: -0.02}}
surfaces: {lobe: {cam: cam, file: lobe.csv}, roller: {sphere: follower, radius: 0.01}}
contacts: {lift: {between: [lobe, roller]}}
drives: {turn: {drive: shaft.angle, value: "20*t"}}
initial: {shaft.angle_rate: 20}
integrate: {step: 5.0e-4, until: 0.5}
output: {every: 0.025, columns: [shaft.angle, follower.y]}
DECK
done
touching 1e-6 'END { printf "%.2g", abs($2 + 0.01109009509) }' <<'DECK'
fmdsub: 1
gravity: [0, -9.81]
bodies: {disc: {mass: 1, inertia: 0.005, at: ["0.9*sin(0.05)", "1 - 0.9*cos(0.05)"]}}
surfaces: {road: {profile: ground, at: [0, 0], file: bowl.csv}, skin: {sphere: disc, radius: 0.1}}
contacts: {rolls: {between: [skin, road], friction: 0.5}}
integrate: {step: 1.0e-3, until: 10}
output: {every: 10, columns: [disc.x]}
DECK
