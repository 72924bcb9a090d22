# H42: 1e4 steps and the same back from there: the start; the order by halving the step twice.
swing() { printf 'fmdsub: 1\ngravity: [0, -9.81]\nbodies: {a: {mass: 1, inertia: 1/12, at: [0, -0.5]}, b: {mass: 1, inertia: 1/12, at: [0, -1.5]}}\nconstraints: {pin: {revolute: [ground, a], at: [0, 0]}, knee: {revolute: [a, b], at: [0, -1]}}\npartition: {fast: [knee]}\ninitial: {%s}\nintegrate: {step: %s, until: %s, newton_tolerance: 1.0e-14}\noutput: {every: %s, columns: [pin.angle, knee.angle, pin.angle_rate, knee.angle_rate]}\n' "$1" $2 $3 $3; }
for scheme in $schemes; do
    swing "pin.angle: 0.5, knee.angle: 0.3" 1.0e-3 10 >there.yaml
    set -- $("$FMDSUB" run -q --set integrate.scheme=$scheme --set integrate.newton_tolerance=1.0e-14 there.yaml 2>/dev/null | tail -n 1 | tr , ' ')
    swing "pin.angle: $2, knee.angle: $3, pin.angle_rate: -($4), knee.angle_rate: -($5)" 1.0e-3 10 |
        row $scheme 1e-8 'END { printf "%.2g", abs($2 - 0.5) + abs($3 - 0.3) + abs($4) + abs($5) }'
done
for scheme in $schemes; do
    for step in 4.0e-3 2.0e-3 1.0e-3; do
        swing "pin.angle: 0.5, knee.angle: 0.3" $step 2 >there.yaml
        "$FMDSUB" run -q --set integrate.scheme=$scheme there.yaml 2>err | tail -n 1 | cut -d, -f2
    done >ends # how far from 2
    begun=$(date +%s%N)
    line $scheme 0.1 0 "$(awk '{ x[NR] = $1 } END { r = (x[1] - x[2]) / (x[2] - x[3]); p = log(r > 0 ? r : 9) / log(2) - 2; printf "%.2g", p < 0 ? -p : p }' ends)"
done
