# H36: a mechanism of 1e-100 m and 1e-200 kg, one of 1e100 m, and a spring of 1e-310 N/m: the energy, over what moves.
small() { printf 'fmdsub: 1\nparameters: {l: %s, m: %s}\ngravity: [0, -9.81*l]\nbodies: {a: {mass: m, inertia: m*l^2/12, at: [l/2, 0]}, b: {mass: m, inertia: m*l^2/12, at: [3*l/2, 0]}}\nconstraints: {pin: {revolute: [ground, a], at: [0, 0]}, knee: {revolute: [a, b], at: [l, 0]}}\nforces: {k: {spring: knee, stiffness: %s}}\nintegrate: {step: 1.0e-3, until: 1}\noutput: {every: 0.1, columns: [{share: energy.residual/(1.0e-300 + energy.kinetic)}, pin.angle]}\n' $1 $2 $3; }
small 1 1 0 >one.yaml
for scheme in $schemes; do
    want=$("$FMDSUB" run -q --set integrate.scheme=$scheme one.yaml 2>/dev/null | tail -n 1 | cut -d, -f3)
    for case in "1.0e-60 1.0e-60 0" "1.0e+60 1.0e+60 0" "1 1 1.0e-310"; do
        set -- $case
        small $1 $2 $3 | row $scheme 1e-6or-told 'END { printf "%.2g", abs($3 - ('"$want"')) }'
    done
done
small 1.0e-200 1.0e-300 0 | row deck told 'small\|range\|zero\|mass'
