# H32: a beam that floats freely: its rigid motions have no frequency, and its first is 22.3733 sqrt(EI/(rho A L^4)).
cat >free.yaml <<'DECK'
fmdsub: 1
bodies:
  beam: {beam: {from: [0, 0, 0], to: [1, 0, 0], elements: 16}, section: {rectangle: [0.01, 0.012]}, material: {E: 2.0e+11, nu: 0.3, density: 7850}, modes: 8}
constraints: {float: {free: [ground, beam], at: [0.5, 0, 0]}}
integrate: {step: 1.0e-4, until: 0.1}
output: {columns: [float.x]}
DECK
begun=$(date +%s%N)
"$FMDSUB" modes -q -f csv free.yaml >out 2>err # about its weaker axis, I = 0.012*0.01^3/12
line modes 1e-2 $? "$(awk -F, "$words"'NR > 1 && NR < 8 && $2 > 1e-6 { bad = 1 } NR == 8 { w = 22.3733 * sqrt(2e11 * 1e-4 / 12 / 7850); f = $3 } END { printf "%.2g", bad ? 9 : abs(f / w - 1) }' out)"
for scheme in $schemes; do
    row $scheme 1e-12 'NR == 2 { p = $2 } NR > 1 { see($2 / p - 1) } END { printf "%.2g", worst }' --set initial='{float.x_rate: 0.3, float.omega: [0, 0, 2]}' --set output='{every: 0.001, columns: [momentum.x]}' <free.yaml
done
