# dead-centres.sh -- coordinates that lead until they cannot: the error of the motion behind a new choice of independent
# coordinates is that of a choice that was good from the first, whatever the scheme, the step, and what is called fast.
#
# One freedom each: M(a) a'' + M'(a) a'^2/2 = Q(a), by RK4 in small steps.
. tests/tools/lib.sh

# reference KIND SECONDS EVERY: angle and rate at each record, from where the decks begin.
reference() {
    awk -v kind="$1" -v T="$2" -v every="$3" '
        function point(p,    s, c, b, db) { # x, slopes of what has mass
            s = sin(p); c = cos(p)
            if (kind == "change") { x = 2 * c; dx = -2 * s; ux = -1.5 * s; uy = c / 2; return -1 }
            b = r * s / l; db = r * c / sqrt(l * l - r * r * s * s)
            x = r * c + l * sqrt(1 - b * b); dx = -r * s - l * b * db; ux = -r * s - l / 2 * b * db; uy = r * c / 2
            return db
        }
        function mass(p,    db) {
            db = point(p)
            if (kind == "change") return 1 / 12 + 1 / 4 + db * db / 12 + ux * ux + uy * uy + dx * dx
            return 0.01 + r * r / 4 + 0.01 * db * db + ux * ux + uy * uy + dx * dx
        }
        function accel(p, w,    m, slope, e) {
            e = 1e-3
            slope = (8 * (mass(p + e) - mass(p - e)) - mass(p + 2 * e) + mass(p - 2 * e)) / (12 * e)
            m = mass(p)
            return ((kind == "change" ? -9.81 * cos(p) : -1000 * (x - x0) * dx) - slope * w * w / 2) / m
        }
        BEGIN {
            r = 0.15; l = 0.35
            p = kind == "change" ? 0.3 : atan2(1, 0); w = kind == "change" ? 1 : 30
            point(p); x0 = x; from = p; sub_ = int(every / 1e-4 + 0.5); h_ = every / sub_
            for (i = 0; i * every < T + 1e-9; i++) {
                printf "%.12g %.12g\n", p - from, w
                for (j = 0; j < sub_; j++) {
                    a1 = accel(p, w); p2 = p + h_ / 2 * w; w2 = w + h_ / 2 * a1
                    a2 = accel(p2, w2); p3 = p + h_ / 2 * w2; w3 = w + h_ / 2 * a2
                    a3 = accel(p3, w3); p4 = p + h_ * w3; w4 = w + h_ * a3; a4 = accel(p4, w4)
                    p += h_ / 6 * (w + 2 * w2 + 2 * w3 + w4); w += h_ / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
                }
            }
        }'
}

# worst REFERENCE CSV: the largest error of the angle.
worst() {
    awk -F, 'function size(x) { return x < 0 ? -x : x }
        NR == FNR { split($0, want, " "); p[FNR] = want[1]; next }
        FNR > 1 && size($2 - p[FNR - 1]) > most { most = size($2 - p[FNR - 1]) }
        END { if (FNR - 1 == length(p)) printf "%.3g", most; else printf "9e99" }' "$1" "$2"
}

# errors NAME DECK REFERENCE MOST SETTING...: at four steps error/h^2 is at most MOST, and the same within 2.
errors() {
    name=$1 deck=$2 ref=$3 most=$4
    shift 4
    : >"$work/line"
    for h in 1.0e-3 5.0e-4 2.5e-4 1.25e-4; do
        "$FMDSUB" run -q "$@" --set integrate.step=$h "$deck" >"$work/out" 2>"$work/err" || { not_ok "$name at $h" "stopped:" "$work/err"; return; }
        echo "$h $(worst "$ref" "$work/out")" >>"$work/line"
    done
    awk -v limit="$most" '{ e = $2 / $1 / $1; if (e > most) most = e; if (!least || e < least) least = e; printf " %.3g", e }
        END { exit !(most <= 2 * least && most <= limit) }' "$work/line" >"$work/got"
    if [ $? = 0 ]; then ok "$name: error/h^2$(cat "$work/got")"; else not_ok "$name" "error/h^2$(cat "$work/got"), allowed $most" "$work/err"; fi
}

# tighter NAME DECK REFERENCE SETTING...: dopri5 gets better with its tolerance, down to round-off.
tighter() {
    name=$1 deck=$2 ref=$3
    shift 3
    : >"$work/line"
    for tol in 1e-6 1e-8 1e-10 1e-12; do
        "$FMDSUB" run -q "$@" --set "integrate={scheme: dopri5, tolerance: $tol, until: 2}" "$deck" >"$work/out" 2>"$work/err" ||
            { not_ok "$name at $tol" "stopped:" "$work/err"; return; }
        echo "$tol $(worst "$ref" "$work/out")" >>"$work/line"
    done
    awk '{ printf " %s", $2; if (NR > 1 && $2 > last / 4 && $2 > 1e-10) bad = 1; last = $2 } END { exit bad || last > 1e-9 }' "$work/line" >"$work/got"
    if [ $? = 0 ]; then ok "$name: errors$(cat "$work/got")"; else not_ok "$name" "errors$(cat "$work/got")" "$work/err"; fi
}

reference change 2 0.1 >"$work/change"
reference slider 2 0.01 >"$work/slider"
change=tests/hard/change-point.yaml slider=tests/hard/fast-slider.yaml
for scheme in midpoint newmark "subcycle --set integrate.ratio=2 --set partition.fast=[slide]"; do
    errors "change point, ${scheme%% *}" $change "$work/change" 25 --set integrate.scheme=$scheme
done
for scheme in midpoint newmark "subcycle --set integrate.ratio=1" "subcycle --set integrate.ratio=2"; do
    errors "fast slider, $scheme" $slider "$work/slider" 3e4 --set integrate.scheme=$scheme
done
tighter "change point" $change "$work/change"
tighter "fast slider" $slider "$work/slider" --set output.every=0.01

# What is called fast does not change the motion, nor whose start is given.
run_four_bar() { "$FMDSUB" run -q "$@" --every 2 --set "integrate={scheme: dopri5, tolerance: 1.0e-9, until: 2}" decks/four-bar.yaml 2>"$work/err"; }
run_four_bar | tail -n 1 >"$work/plain"
for joint in shaft pivot elbow wrist; do
    run_four_bar --set "partition={fast: [$joint]}" | tail -n 1 >"$work/out"
    paste -d, "$work/plain" "$work/out" | awk -F, '{ off = $2 - $12; fine = NF == 20 && off * off < 1e-14 } END { exit !fine }'
    if [ $? = 0 ]; then ok "four-bar, $joint fast: the same motion"; else not_ok "four-bar, $joint fast" "its end is not" "$work/plain" "$work/out" "$work/err"; fi
done
"$FMDSUB" run -q --set "initial={shaft.angle: 0.2, pivot.angle_rate: 1}" --set "partition={fast: [elbow]}" --until 0.1 \
    --columns shaft.angle,pivot.angle_rate decks/four-bar.yaml >"$work/out" 2>"$work/err"
expect "four-bar: where from one coordinate, how fast from another" "0 0.2 1" \
    "$(awk -F, 'NR == 2 { printf "%g %g %.12g", $1, $2, $3 }' "$work/out")" "$work/err"

# How near it came to a posture where the loops do not hold what follows: two windows lie flat at 0.714355529 s and every half
# of 1.942514922607 s behind that (closed form); equal arms at a right angle; a four-bar that turns round has none.
for scheme in midpoint newmark subcycle; do
    "$FMDSUB" run --stats="$work/stats" --until 1 --set "integrate={scheme: $scheme, step: 1.25e-4, until: 1}" decks/windows.yaml >"$work/out" 2>"$work/err"
    expect "windows, $scheme: the dead point is told" "0 1 yes" \
        "$? $(grep -c "^nearest to a dead point at t = 0.714[0-9]* s: the loops hold '.*.angle' by .* of what they do at best" "$work/err") $(awk '$1 == "dead_point_ratio" { r = $2 } $1 == "dead_point_t" { t = $2 } END { if (r < 2e-3 && t > 0.714355529 - 2e-2 * (r > 1e-3) - 1.3e-4 && t < 0.714355529 + 1.3e-4) print "yes" }' "$work/stats")" "$work/err" "$work/stats"
done
"$FMDSUB" run --stats="$work/stats" decks/slider-crank.yaml >"$work/out" 2>"$work/err"
expect "equal arms: the dead point is told" "1 rail.displacement 0" "$(grep -c '^nearest to a dead point' "$work/err") $(awk '$1 == "dead_point_at" { print $2 } $1 == "dead_point_ratio" { print ($2 > 1e-2) }' "$work/stats" | sort -r | tr '\n' ' ' | sed 's/ $//')" "$work/stats"
"$FMDSUB" run --stats="$work/stats" decks/four-bar.yaml >"$work/out" 2>"$work/err"
expect "four-bar: far from any" "0 1" "$(grep -c '^nearest to a dead point' "$work/err") $(awk '$1 == "dead_point_ratio" { print ($2 > .1 && $2 < 1) }' "$work/stats")" "$work/stats"
