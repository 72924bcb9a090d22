# outlines.sh -- curves that are touched: a cam under a roller, a disc that rolls in a round bowl, bounces on one that gives way.
. tests/tools/lib.sh

# An eccentric disc, R = 40 mm, e = 10 mm, as a cam of 144 points, under a roller of 10 mm: its lift in closed form.
awk 'BEGIN { for (i = 0; i < 144; i++) { a = 8 * atan2(1, 1) * i / 144; b = a - 2 * atan2(1, 1)
    printf "%.17g,%.17g\n", a, .01 * cos(b) + sqrt(.0016 - (.01 * sin(b)) ^ 2) } }' >"$work/lobe.csv"
cam() { # CONTACT
    cat <<END
fmdsub: 1
gravity: [0, -9.81]
bodies: {cam: {mass: 1, inertia: 1.0e-3, at: [0, 0]}, follower: {mass: 0.2, inertia: 1.0e-4, at: [0, 0.06]}}
constraints: {shaft: {revolute: [ground, cam], at: [0, 0]}, guide: {prismatic: [ground, follower], axis: [0, 1]}}
forces: {spring: {spring: guide, stiffness: 2000, rest: -0.02}}
surfaces: {lobe: {cam: cam, file: lobe.csv}, roller: {sphere: follower, radius: 0.01}}
contacts: {lift: {between: [lobe, roller]${1:-}}}
drives: {turn: {drive: shaft.angle, value: "20*t"}}
initial: {shaft.angle_rate: 20}
integrate: {step: 1.0e-3, until: 0.5}
output: {every: 0.025, columns: [shaft.angle, follower.y, energy.residual]}
END
}
# lift LIMIT: how far the follower is from where the disc's centre has it, over a second.
lift() {
    awk -F, -v limit="$1" 'NR > 1 { x = -.01 * sin($2); d = .01 * cos($2) + sqrt(.0025 - x * x) - $3; if (d < 0) d = -d; if (d > most) most = d }
        END { print most; exit !(NR == 22 && most <= limit) }' "$work/out" >"$work/lift"
}
cam >"$work/cam"
# The decks stand beside the table.
at() { cat >"$work/deck.yaml" && (cd "$work" && "$FMDSUB" run -q "$@" deck.yaml >out 2>err); ended "$name: status" 0 $? "$work/out" "$work/err"; last=$(tail -n 1 "$work/out"); }
name="cam, rigid"
cam >"$work/cam"
at <"$work/cam"
lift 2e-8 && ok "$name: its lift" || not_ok "$name: its lift" "off by" "$work/lift" "$work/out"
near "$name: energy" "0.5,0" "$(echo "$last" | cut -d , -f 1,4)" 1e-13
for scheme in 'midpoint, step: 1.0e-3' 'radau5, tolerance: 1.0e-6' 'dopri5, tolerance: 1.0e-6'; do
    name="cam that gives way, $scheme"
    cam ', stiffness: 1.0e+8, damping: 500' >"$work/cam"
    at --set "integrate={scheme: $scheme, until: 0.5}" <"$work/cam"
    lift 1e-6 && ok "$name: its lift" || not_ok "$name: its lift" "off by" "$work/lift" "$work/out"
done

# A disc that rolls in a bowl of radius 1: (3/2) (R - r) a'' = -g sin a, here from 0.05 rad; at 10 s by Runge-Kutta.  Second order.
awk 'BEGIN { for (i = 0; i <= 360; i++) { x = -.9 + .005 * i; printf "%.17g,%.17g\n", x, 1 - sqrt(1 - x * x) } }' >"$work/bowl.csv"
bowl() {
    cat <<END
fmdsub: 1
gravity: [0, -9.81]
bodies: {disc: {mass: 1, inertia: 0.005, at: ["0.9*sin(0.05)", "1 - 0.9*cos(0.05)"]}}
surfaces: {road: {profile: ground, at: [0, 0], file: bowl.csv}, skin: {sphere: disc, radius: 0.1}}
contacts: {rolls: {between: [skin, road], friction: 0.5}}
integrate: {step: $1, until: 10}
output: {every: 10, columns: [disc.x, disc.y, rolls.gap, energy.residual]}
END
}
for step in 2.0e-3:3e-6 1.0e-3:8e-7; do
    name="disc that rolls in a bowl, h = ${step%:*}"
    bowl "${step%:*}" >"$work/b"
    at <"$work/b"
    near "$name: where it is" "10,-0.01109009509,0.10006833049,0,0" "$last" "${step#*:}"
    near "$name: gap and energy" "10,0,0" "$(echo "$last" | cut -d , -f 1,4,5)" 1e-12
done

# A ball that jumps in a parabola of any stiffness, in steps that do not resolve the impacts: its energy over 20 s, of 28 J.
for law in 'stiffness: 1.0e+4:1e-4' 'stiffness: 1.0e+8:1e-4' 'restitution: 1:1e-10'; do
    name="ball that jumps in a parabola, ${law%:*}"
    at <<END
fmdsub: 1
gravity: [0, -9.81]
bodies: {ball: {mass: 1, inertia: 0.004, at: [0.5, 1.5]}}
tables: {bowl: [[-2, 2], [-1.5, 1.125], [-1, 0.5], [-0.5, 0.125], [0, 0], [0.5, 0.125], [1, 0.5], [1.5, 1.125], [2, 2]]}
surfaces: {road: {profile: ground, at: [0, 0], table: bowl}, skin: {sphere: ball, radius: 0.1}}
contacts: {hit: {between: [skin, road], ${law%:*}}}
integrate: {step: 1.0e-3, until: 20}
output: {every: 20, columns: [energy.residual]}
END
    near "$name: energy" "20,0" "$last" "${law##*:}"
done
