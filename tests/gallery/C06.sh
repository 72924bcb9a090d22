# C06: a pendulum with friction in its pin, by the joint's own force: it comes to rest at -0.00148817 rad, after 47.05 s.
for case in "1.0e-2 5.5e-3" "5.0e-3 1.4e-3" "2.5e-3 3.5e-4"; do
    set -- $case
    touching $2 'END { see($2 + 0.00148816539591); see($3); printf "%.2g", worst }' --set integrate.step=$1 <<'DECK'
fmdsub: 1
gravity: [0, -9.81]
bodies: {rod: {mass: 1, inertia: 1/12, at: [0, -0.5]}}
constraints: {pin: {revolute: [ground, rod], at: [0, 0], friction: {coefficient: 0.3, radius: 0.02}}}
initial: {pin.angle: 2}
integrate: {step: 1.0e-2, until: 60}
output: {every: 1, columns: [pin.angle, pin.angle_rate]}
DECK
done
