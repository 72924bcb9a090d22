# H13: a joint as a spring of 1e12 N/m against the rigid joint: the place of the tip.
pendulum() { printf 'fmdsub: 1\ngravity: [0, -9.81]\nbodies: {bob: {mass: 1, inertia: 0.1, at: [1, 0], points: {tip: [1, 0], root: [-1, 0]}}}\nconstraints: {%s}\n%s\nintegrate: {step: 1.0e-4, until: 2}\noutput: {every: 2, columns: [bob.tip.x, bob.tip.y]}\n' "$1" "$2"; }
for scheme in $schemes; do
    limit=1e-6
    case $scheme in newmark|generalized-alpha|miao) limit=1e-3 ;; esac # what Newton's method leaves over, times the stiffness
    pendulum 'pin: {revolute: [ground, bob], at: [0, 0]}' '' >rigid.yaml
    "$FMDSUB" run -q --set integrate.scheme=$scheme rigid.yaml >rigid 2>err
    want=$(tail -n 1 rigid)
    pendulum 'float: {free: [ground, bob]}' 'forces: {joint: {bushing: [ground, bob], at: [0, 0], stiffness: [1.0e+12, 1.0e+12]}}' |
        row $scheme $limit 'END { split("'$want'", w); printf "%.2g", abs($2 - w[2]) + abs($3 - w[3]) }'
done
