# H31: a double pendulum from 120 degrees, chaotic with 1.3 per second: the first angle at 5, 10 and 15 s; by fixed steps at 5 s, for later what they miss has grown too far.
cat >double.yaml <<'DECK'
fmdsub: 1
gravity: [0, -9.81]
bodies: {one: {mass: 1, at: [0, -1]}, two: {mass: 1, at: [0, -2]}}
constraints: {pin: {revolute: [ground, one], at: [0, 0]}, knee: {revolute: [one, two], at: [0, -1]}}
initial: {pin.angle: 2*pi/3}
integrate: {step: 1.0e-4, until: 5}
output: {every: 5, columns: [pin.angle]}
DECK
for end in 5:-2.0769407:1e-6 10:3.116229:5e-6 15:0.868:1e-3; do
    for scheme in dop853 dopri5; do
        row $scheme ${end##*:} 'END { d = $2 - '$(echo $end | cut -d: -f2)'; p = 8 * atan2(1, 1); d -= p * int(d / p + (d < 0 ? -0.5 : 0.5)); printf "%.2g", abs(d) }' \
            --set "integrate={tolerance: 1.0e-13, until: ${end%%:*}}" --set output.every=${end%%:*} <double.yaml
    done
done
for scheme in $schemes; do row $scheme 1e-3 'END { printf "%.2g", abs($2 + 2.0769407) }' <double.yaml; done
