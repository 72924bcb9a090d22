# states.sh -- quantities of first order: an arm held by a controller with an integral and a filter, against Runge and Kutta's
# rule in awk; the modes of the loop against the roots of its polynomial; restarts; what is refused.
. tests/tools/lib.sh
cd "$work" || exit 1

cat >deck.yaml <<'YAML'
fmdsub: 1
gravity: [0, -9.81]
bodies: {arm: {mass: 1, inertia: 1/12, at: [0.5, 0]}}
constraints: {pin: {revolute: [ground, arm], at: [0, 0]}}
signals: {error: 0.3 - pin.angle}
states:
  late: error
  filtered: {rate: (error - filtered)/0.05, start: 0.3}
forces: {motor: {torque: pin, value: 60*filtered + 80*late - 8*pin.angle_rate}}
integrate: {scheme: midpoint, step: 1.0e-4, until: 2}
output: {every: 0.25, columns: [pin.angle, late, filtered, filtered_rate]}
YAML
awk 'function f(y, d) { d[0] = y[1]; d[1] = 3 * (-4.905 * cos(y[0]) + 60 * y[3] + 80 * y[2] - 8 * y[1]); d[2] = .3 - y[0]; d[3] = (.3 - y[0] - y[3]) / .05 }
    function at(z, y, h, d,   i) { for (i = 0; i < 4; i++) z[i] = y[i] + h * d[i] }
    BEGIN { h = 1e-4; y[3] = .3
        for (n = 1; n <= 20000; n++) {
            f(y, a); at(z, y, h / 2, a); f(z, b); at(z, y, h / 2, b); f(z, c); at(z, y, h, c); f(z, d)
            for (i = 0; i < 4; i++) y[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i])
        }
        f(y, a); printf "%.15g,%.15g,%.15g,%.15g,%.15g\n", 2, y[0], y[2], y[3], a[3] }' >want
while read -r limit words; do
    "$FMDSUB" run -q $words deck.yaml >out 2>err
    ended "$words: status" 0 $? out err
    near "$words" "$(cat want)" "$(tail -n 1 out)" "$limit"
done <<'LIST'
1e-7 -s integrate.scheme=midpoint
1e-7 -s integrate.scheme=newmark
1e-7 -s integrate.scheme=hht -s integrate.alpha=0
1e-9 -s integrate.scheme=rk4
1e-6 -s integrate.scheme=subcycle -s integrate.ratio=5 -s partition.fast=[pin]
1e-6 -s integrate.scheme=subcycle -s integrate.ratio=5 -s partition.fast=[filtered_axle]
1e-9 -s integrate.scheme=dop853 -s integrate.tolerance=1e-10
1e-9 -s integrate.scheme=radau9 -s integrate.tolerance=1e-10
LIST

# In space, a state by itself: x' = -x.
cat >space.yaml <<'YAML'
fmdsub: 1
gravity: [0, 0, -9.81]
bodies: {arm: {mass: 1, inertia: [0.1, 0.1, 0.1], at: [0.5, 0, 0]}}
constraints: {pin: {revolute: [ground, arm], at: [0, 0, 0], axis: [0, 1, 0]}}
states: {x: {rate: -x, start: 2}}
integrate: {scheme: rk4, step: 1.0e-3, until: 1}
output: {every: 1, columns: [x]}
YAML
"$FMDSUB" run -q space.yaml >out 2>err
near "in space: 2/e" "1,0.735758882342885" "$(tail -n 1 out)" 1e-12

# s^3 + 24 s^2 + 180 s + 240 = 0 without the filter: omega 11.9326544, damping .9350169 of the pair.
"$FMDSUB" modes -s 'forces.motor.value=60*error + 80*late - 8*pin.angle_rate' -s 'states={late: error}' -s 'output.columns=[pin.angle]' deck.yaml >out 2>err
near "modes of the loop" "11.9326544,0.9350169" "$(tail -n 1 out | cut -d , -f 3,4)" 1e-6

"$FMDSUB" run -q -s integrate.until=1 --final-state half.json deck.yaml >/dev/null 2>err
"$FMDSUB" run -q deck.yaml 2>>err | tail -n 4 >whole
"$FMDSUB" run -q -s 'initial={from: half.json, time: keep}' deck.yaml 2>>err | tail -n 4 >rest
same "a restart" whole rest
"$FMDSUB" check --expanded deck.yaml >expanded.yaml 2>err
"$FMDSUB" run -q deck.yaml >whole 2>>err
"$FMDSUB" run -q expanded.yaml >rest 2>>err
same "the deck as it is expanded" whole rest
"$FMDSUB" animate -q --every 0.5 -o film.html deck.yaml 2>err
expect "a state's wheel is not drawn" "2 0" "$(grep -c '"name":"arm"\|"name":"pin"' film.html) $(grep -c '"name":"late_' film.html)" err

wrong() { "$FMDSUB" check -s "$2" deck.yaml >out 2>err; expect "$1" 3 $? err; grep -q -- "$3" err && ok "$1: said" || not_ok "$1: said" "'$3' is not there" err; }
wrong "static" "initial=static" "'static' and 'states' do not go together"
wrong "a key" "states.late={rate: error, begin: 1}" "unknown key 'begin' in state 'late'"
wrong "no rate" "states.late={start: 1}" "rate"
wrong "a name that is taken" "bodies.late_wheel={mass: 1, at: [0, 0]}" "'late' makes 'late_wheel', which 'bodies' has already"
wrong "a name that is none" "states.a-b=1" "'a-b' cannot name a state"
wrong "a rate that is unknown" "states.late=eror" "did you mean 'error'"
