# H34: a damper that gives is told, one of 1e9 runs; constants of a rule outside what they may be are refused by each that has them.
car() { printf 'fmdsub: 1\nbodies: {car: {mass: 1, at: [0, 0]}}\nconstraints: {rail: {prismatic: [ground, car], axis: [1, 0]}}\nforces: {d: {damper: rail, damping: %s}}\ninitial: {rail.displacement_rate: 1.0e-6}\nintegrate: {step: 1.0e-3, until: 1}\noutput: {columns: [rail.displacement_rate]}\n' $1; }
car -1 | row deck told 'must be at least 0'
for scheme in $schemes; do car 1.0e+9 | row $scheme 1e-6 'END { printf "%.2g", abs($2) }'; done
for set in integrate.gamma=0.4 integrate.beta=0 integrate.beta=0.2; do
    for scheme in newmark miao; do fall 0.1 1 | row $scheme told 'must be\|not stable' --set $set; done
done
for scheme in subcycle midpoint newmark generalized-alpha; do fall 0.1 1 | row $scheme told "'rho_infinity' must be" --set integrate.rho_infinity=1.1; done
