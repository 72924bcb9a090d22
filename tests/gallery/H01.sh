# H01: a slider-crank whose slider leads until its dead centre: the crank's angle after 2 s beside that of one coordinate.
# M(p) p'' + M'(p) p'^2/2 = Q(p), by Runge and Kutta's rule in steps of 1e-4 s.
want=$(awk 'function point(p) {
        s = sin(p); c = cos(p); b = r * s / l; db = r * c / sqrt(l * l - r * r * s * s)
        x = r * c + l * sqrt(1 - b * b); dx = -r * s - l * b * db; ux = -r * s - l / 2 * b * db; uy = r * c / 2
    }
    function mass(p) { point(p); return 0.01 + r * r / 4 + 0.01 * db * db + ux * ux + uy * uy + dx * dx }
    function accel(p, w,    m, slope) {
        slope = (8 * (mass(p + 1e-3) - mass(p - 1e-3)) - mass(p + 2e-3) + mass(p - 2e-3)) / 0.012
        m = mass(p); return (-1000 * (x - x0) * dx - slope * w * w / 2) / m
    }
    BEGIN {
        r = 0.15; l = 0.35; h = 1e-4; p = atan2(1, 0); from = p; w = 30; point(p); x0 = x
        for (i = 0; i < 20000; i++) {
            a1 = accel(p, w); p2 = p + h / 2 * w; w2 = w + h / 2 * a1; a2 = accel(p2, w2); p3 = p + h / 2 * w2; w3 = w + h / 2 * a2
            a3 = accel(p3, w3); p4 = p + h * w3; w4 = w + h * a3; a4 = accel(p4, w4)
            p += h / 6 * (w + 2 * w2 + 2 * w3 + w4); w += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
        }
        printf "%.12g", p - from
    }')
for scheme in dopri5 radau9 dop853; do
    row $scheme 1e-8 'END { printf "%.2g", abs($2 - '$want') }' --set "integrate={tolerance: 1.0e-11, until: 2}" --set output.every=2 <"$ROOT/tests/hard/fast-slider.yaml"
done
for scheme in $schemes; do # 3e4 h^2
    row $scheme 5e-4 'END { printf "%.2g", abs($2 - '$want') }' --set integrate.step=1.25e-4 --set output.every=2 <"$ROOT/tests/hard/fast-slider.yaml"
done
