# H37: units that were mixed: a Poisson's ratio of 3 is refused, a material with a sound of 1600 km/s or 1.6 m/s is told.
beam() { printf 'fmdsub: 1\nbodies:\n  arm: {beam: {from: [0, 0], to: [1, 0]}, section: {rectangle: [0.02, 0.01]}, material: {E: %s, nu: %s, density: %s}, modes: 2}\nconstraints: {clamp: {fixed: [ground, arm], at: [0, 0]}}\nintegrate: {step: 1.0e-5, until: 1.0e-3}\noutput: {columns: [arm.mode1]}\n' $1 $2 $3; }
beam 7.0e+10 3 2700 | row deck told 'nu'
beam 7.0e+6 0.3 2.78e-6 | row deck told 'sound\|units\|density' --strict
beam 7.0e+4 0.3 2700 | row deck told 'sound\|units\|density' --strict
for scheme in $schemes; do beam 7.0e+10 0.3 2700 | row $scheme 1e-12 'NR > 1 { see($2) } END { print worst + 0 }' --strict; done
