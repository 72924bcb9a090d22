# C02: a block on a slope at 0.9 of the friction angle stays for 100 s, at 1.1 it slides as the closed form says.
slope() { awk -v of=$1 -v until=$2 'BEGIN { tilt = atan2(of * 0.5, 1)
    printf "fmdsub: 1\ngravity: [%.17g, %.17g]\n", 9.81 * sin(tilt), -9.81 * cos(tilt)
    printf "bodies: {b: {mass: 1, inertia: 0.1, at: [0, 0]}}\nconstraints: {f: {planar: [ground, b], at: [0, 0]}}\nsurfaces: {floor: {plane: ground, at: [0, 0], normal: [0, 1]}, toe: {point: b}}\n"
    printf "contacts: {c: {between: [floor, toe], friction: 0.5}}\nintegrate: {step: 1.0e-2, until: %s}\noutput: {every: 1, columns: [b.x, b.y]}\n", until }'; }
slope 0.9 100 >deck2.yaml
touching 0 'NR > 1 { see($2); see($3) } END { print worst + 0 }' <deck2.yaml
slope 1.1 1 >deck2.yaml
touching 1e-13 'END { t = atan2(0.55, 1); printf "%.2g", abs($2 - 0.5 * 9.81 * (sin(t) - 0.5 * cos(t))) }' <deck2.yaml
