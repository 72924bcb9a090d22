# H16: a gimbal of three hinges that comes to its singular posture: the ball joint passes without event, three starts alike.
ball() { printf 'fmdsub: 1\nspace: 3d\nbodies: {top: {mass: 1, at: [0, 0, 0], inertia: [1, 2, 2.5]}}\nconstraints: {ball: {spherical: [ground, top], at: [0, 0, 0]}}\ninitial: {ball.rotation: {axis: [0, 1, 0], angle: pi/2 + %s}, ball.omega: [0.3, 1, 0.2]}\nintegrate: {step: 1.0e-3, until: 2}\noutput: {every: 2, columns: [top.wx, top.wy, top.wz]}\n' $1; }
hinges() { printf 'fmdsub: 1\nspace: 3d\nbodies:\n  outer: {mass: 1, at: [0, 0, 0], inertia: [1, 1, 1]}\n  inner: {mass: 1, at: [0, 0, 0], inertia: [1, 1, 1]}\n  top: {mass: 1, at: [0, 0, 0], inertia: [1, 2, 2.5]}\nconstraints:\n  yaw: {revolute: [ground, outer], at: [0, 0, 0], axis: [0, 0, 1]}\n  pitch: {revolute: [outer, inner], at: [0, 0, 0], axis: [0, 1, 0]}\n  roll: {revolute: [inner, top], at: [0, 0, 0], axis: [1, 0, 0]}\ninitial: {pitch.angle: pi/2 + %s, yaw.angle_rate: 0.3, pitch.angle_rate: 0.7}\nintegrate: {step: 1.0e-3, until: 2}\noutput: {every: 2, columns: [top.wx, top.wy, top.wz]}\n' $1; }
for kind in ball hinges; do
    for scheme in $schemes; do
        $kind 0 >exact.yaml
        want=$("$FMDSUB" run -q --set integrate.scheme=$scheme exact.yaml 2>/dev/null | tail -n 1)
        for off in 1.0e-8 -1.0e-8; do
            $kind $off | row $scheme 1e-6 'END { split("'$want'", w); printf "%.2g", abs($2 - w[2]) + abs($3 - w[3]) + abs($4 - w[4]) }'
        done
    done
done
