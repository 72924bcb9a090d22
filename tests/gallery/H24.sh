# H24: a ball on a stop with restitution 0.5 comes to rest at 1.354571 s after impacts without end; a rod on a soft stop of 1e8.
ball() { printf 'fmdsub: 1\ngravity: [0, -9.81]\nbodies: {ball: {mass: 1, at: [0, 1]}}\nconstraints: {rail: {prismatic: [ground, ball], axis: [0, 1], range: {lower: -1, hold: {restitution: 0.5}}}}\nintegrate: {step: %s, until: 3}\noutput: {every: {steps: 7}, columns: [ball.y, ball.vy, energy.impact]}\n' $1; }
for step in 1.0e-2 1.0e-3 1.3e-3; do # after rest nothing moves, and 9.81 J are lost
    ball $step | touching 1e-9 'NR > 1 && $1 > 1.3546 { see($2); see($3) } END { printf "%.2g", worst + abs(abs($4) - 9.81) }'
done
for scheme in midpoint newmark subcycle generalized-alpha; do
    limit=1e-9
    case $scheme in newmark|generalized-alpha) limit=1e-3 ;; esac # theirs swings, and does not drift
    row $scheme $limit 'NR > 1 { see($2) } END { printf "%.2g", worst / 9.81 }' <<'DECK'
fmdsub: 1
gravity: [0, -9.81]
bodies: {rod: {mass: 1, at: [0, 1]}}
constraints: {rail: {prismatic: [ground, rod], axis: [0, 1]}}
forces: {stop: {unilateral: rail, stiffness: 1.0e+8, from: -1, side: below}}
integrate: {step: 1.0e-3, until: 100}
output: {every: {steps: 10}, columns: [energy.residual]}
DECK
done
