# fourth.sh -- two rates of order 4 go on to gain a digit in accuracy and energy where their minor steps get short, ten of them or
# more to a major one: no part of the iteration's error is left where nothing looks.
. tests/tools/lib.sh
cat >"$work/crank.yaml" <<'DECK'
fmdsub: 1
title: A slider-crank on a stiff key
gravity: [0, -9.81]
bodies:
  wheel:  {mass: 50, inertia: 5, at: [0, 0]}
  crank:  {mass: 0.5, inertia: 5.0e-3, at: [0.1, 0]}
  rod:    {mass: 1, inertia: 1/12, at: [0.7, 0]}
  piston: {mass: 0.5, inertia: 1.0e-2, at: [1.2, 0]}
constraints:
  shaft: {revolute: [ground, wheel], at: [0, 0]}
  key:   {revolute: [wheel, crank], at: [0, 0]}
  pin:   {revolute: [crank, rod], at: [0.2, 0]}
  bore:  {prismatic: [ground, piston], axis: [1, 0]}
  wrist: {revolute: [rod, piston], at: [1.2, 0]}
forces:
  stiff: {spring: key, stiffness: 2.0e+4}
initial: {shaft.angle: 0, shaft.angle_rate: 10, key.angle: 0.01, key.angle_rate: 0}
partition: {fast: [key]}
integrate: {scheme: subcycle, order: 4, step: 2.5e-5, ratio: 10, until: 1}
output: {every: 0.02, columns: [key.angle, energy.residual]}
DECK
cat >"$work/chain.yaml" <<'DECK'
fmdsub: 1
title: A stiff joint at the root carries a slow chain
gravity: [0, -9.81]
bodies:
  post: {mass: 2, inertia: 0.2, at: [0, 0.5]}
  l$i:  {repeat: {i: [1, 6]}, mass: 1, inertia: 1/12, at: [0, 1.5 - i]}
constraints:
  foot: {prismatic: [ground, post], axis: [1, 0]}
  q1:   {revolute: [post, l1], at: [0, 1]}
  q$i:  {repeat: {i: [2, 6]}, revolute: [l$(i-1), l$i], at: [0, 2 - i]}
forces:
  stiff: {spring: foot, stiffness: 4.0e+5}
initial: {q1.angle: 0.5, foot.displacement: 0.001}
partition: {fast: [foot]}
integrate: {scheme: subcycle, order: 4, step: 2.5e-5, ratio: 20, until: 1}
output: {every: 0.02, columns: [foot.displacement, energy.residual]}
DECK
# fine NAME ERROR BALANCE: against dop853, over the range of the fast coordinate; off in energy, of all there is.
fine() {
    "$FMDSUB" run -q --set integrate='{scheme: dop853, tolerance: 1.0e-11, until: 1}' "$work/$1.yaml" >"$work/want" 2>"$work/err"
    "$FMDSUB" run "$work/$1.yaml" >"$work/out" 2>"$work/err"
    ended "order 4, $1: ends" 0 $? "$work/out" "$work/err"
    awk -F, -v most="$2" 'FNR == 1 { next } NR == FNR { x[FNR] = $2; if ($2 < low) low = $2; if ($2 > high) high = $2; next }
        { n++; d = ($2 - x[FNR]) / (high - low); if (d < 0) d = -d; if (d > off) off = d } END { print off; exit !(n == 51 && off < most) }' "$work/want" "$work/out" >"$work/off"
    expect "order 4, $1: error below $2" 0 $? "$work/off"
    sed -n 's/^energy balance kept.*(\([0-9.e-]*\); limit.*/\1/p' "$work/err" | awk -v most="$3" '{ n++; off = $1 } END { print off; exit !(n == 1 && off < most) }' >"$work/off"
    expect "order 4, $1: energy off by less than $3" 0 $? "$work/off"
}
fine crank 4e-7 2e-7
fine chain 4e-8 1e-9
