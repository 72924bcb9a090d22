# C04: a mass on a belt behind a spring sticks and slips, 0.4 and 0.3: its place over 3 s beside the closed form, arc by arc.
awk 'BEGIN { k = 100; V = 0.2; s = 0.4 * 9.81; d = 0.3 * 9.81; w = sqrt(k)
    t0 = 0; x0 = 0; slips = 0; pi = atan2(0, -1)
    for (i = 0; i <= 300; i++) { t = i / 100
        while (1) {
            if (!slips) { end = t0 + (s / k - x0) / V; if (t <= end) { x = x0 + V * (t - t0); break } t0 = end; x0 = s / k; slips = 1 }
            else { a = x0 - d / k; b = V / w; end = t0 + (2 * pi - 2 * atan2(a, b)) / w; if (t <= end) { x = d / k + a * cos(w * (t - t0)) + b * sin(w * (t - t0)); break }
                x0 = d / k - a; t0 = end; slips = 0 } }
        printf "%.12g\n", x } }' >belt
for case in "4.0e-3 8e-5" "2.0e-3 2e-5" "1.0e-3 5e-6"; do
    set -- $case
    touching $2 'BEGIN { while ((getline x <"belt") > 0) want[n++] = x } NR > 1 { i = int($1 * 100 + 0.5); see($2 - want[i]); m++ } END { printf "%.2g", (m > 100 ? worst : 9) }' --set integrate.step=$1 <<'DECK'
fmdsub: 1
gravity: [0, -9.81]
bodies: {b: {mass: 1, inertia: 0.1, at: [0, 0]}}
constraints: {f: {planar: [ground, b], at: [0, 0]}}
surfaces: {belt: {plane: ground, at: [0, 0], normal: [0, 1]}, toe: {point: b}}
forces: {k: {force: f.x, value: -100*f.x}}
contacts: {c: {between: [toe, belt], friction: {static: 0.4, kinetic: 0.3}, speed: 0.2}}
initial: {f.x_rate: 0.2}
integrate: {step: 1.0e-3, until: 3}
output: {every: 0.02, columns: [f.x]}
DECK
done
