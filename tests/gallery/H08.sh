# H08: a pendulum on a rod of 1 m drawn at 1.01 m: refused; with assemble its length is right to round-off.
rod() { printf 'fmdsub: 1\ngravity: [0, -9.81]\nbodies: {bob: {mass: 1, inertia: 0.1, at: [1.01, 0]}}\nconstraints: {rod: {distance: [[0, 0], bob], length: 1}}\n%s\nintegrate: {step: 1.0e-3, until: 1}\noutput: {every: 0.01, columns: [bob.x, bob.y]}\n' "$1"; }
rod "" | row deck told 'miss each other'
for scheme in $schemes; do
    rod "initial: {assemble: true}" | row $scheme 1e-12 'NR > 1 { see(sqrt($2 * $2 + $3 * $3) - 1) } END { printf "%.2g", worst }'
done
