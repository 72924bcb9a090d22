# limbs.sh -- what sub-cycling keeps of limbs without fast coordinates saves evaluations of them, and is given up where links so
# unlike hang on each other that the iteration would pay for it: there at most 5 percent more sweeps than with all anew in each
# step, 3345.
. tests/tools/lib.sh
few() { awk -v key="$1" -v most="$2" '$1 == key { n = $2 } END { print (n > 0 && n <= most ? "few" : n) }' "$work/stats"; }
falls() { # HEAVY SWEEPS SLOW: at most so many
    "$FMDSUB" run -q --stats="$work/stats" --set parameters.heavy="$1" - >"$work/out" 2>"$work/err" <<'YAML'
fmdsub: 1
parameters: {heavy: 1}
gravity: [0, -9.81]
bodies:
  a$i: {repeat: {i: [1, 20]}, mass: "if(i == 7, heavy, if(i == 14, heavy, 1))", inertia: 1/12, at: [i - 0.5, 0]}
  e$i: {repeat: {i: [1, 2]}, mass: 1, inertia: 1/12, at: [40, 0.5 - i]}
constraints:
  pa1:  {revolute: [ground, a1], at: [0, 0]}
  pa$i: {repeat: {i: [2, 20]}, revolute: [a$(i-1), a$i], at: [i - 1, 0]}
  pe1:  {revolute: [ground, e1], at: [40, 0]}
  pe2:  {revolute: [e1, e2], at: [40, -1]}
forces: {s: {spring: pe2, stiffness: 2.0e+4}}
initial: {pe1.angle: 0.5, pe2.angle: 0.02}
partition: {fast: [pe2]}
integrate: {scheme: subcycle, order: 4, step: 5.0e-4, ratio: 5, until: 0.4}
output: {every: 0.1, columns: [a20.y, pe2.angle]}
YAML
    ended "a falling chain, two links of $1 kg: status" 0 $? "$work/out" "$work/err"
    expect "a falling chain, two links of $1 kg: sweeps, evaluations of slow bodies" "few few" \
        "$(few sweeps "$2") $(few slow_evaluations "$3")" "$work/err"
}
falls 1.0e+4 3512 5576
falls 1 1900 2300
