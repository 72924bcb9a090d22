# H10: inertias that no body can have are refused by the rule; a rod without inertia about itself spins on.
rod() { printf 'fmdsub: 1\nbodies: {top: {mass: 1, at: [0, 0, 0], inertia: [%s]}}\nconstraints: {float: {free: [ground, top], at: [0, 0, 0]}}\ninitial: {float.omega: {value: [5, 0, 1], frame: body}}\nintegrate: {step: 1.0e-3, until: 1}\noutput: {every: 1, columns: [float.omega_z]}\n' "$1"; }
rod "1, 1, 3" | row deck told 'no body has this inertia'
rod "1, 1, -1" | row deck told 'no body has this inertia'
for scheme in $schemes; do rod "0, 1, 1" | row $scheme 1e-9or-told 'END { printf "%.2g", abs($2 - 1) }'; done
