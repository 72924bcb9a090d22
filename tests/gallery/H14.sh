# H14: a free body at 1e5 rad/s, 1e6 steps of 1e-6 s: its angular momentum; in steps of 10 rad it is told.
top() { printf 'fmdsub: 1\nbodies: {top: {mass: 1, at: [0, 0, 0], inertia: [1, 2, 2.5]}}\nconstraints: {float: {free: [ground, top], at: [0, 0, 0]}}\ninitial: {float.omega: [1.0e-3, 0, 1.0e+5]}\nintegrate: {step: %s, until: %s}\noutput: {every: {steps: 1000}, columns: [momentum.lz, energy.residual, energy.kinetic]}\n' $1 $2; }
for scheme in $schemes; do
    top 1.0e-6 1 | row $scheme 1e-9 'NR == 2 { l = $2 } NR > 1 { see($2 / l - 1); see($3 / $4) } END { printf "%.2g", worst }'
    top 1.0e-4 0.1 | row $scheme told 'more than pi/2' --strict
done
