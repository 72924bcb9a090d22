# branches.sh -- a parallelogram drawn flat, where branches meet: the rates of `initial` name one, or it is refused.
. tests/tools/lib.sh

# flat NAME STATUS RATES RECORD: all bars 1 m long, no gravity; on each branch the rates stay
flat() {
    cat >"$work/deck.yaml" <<END
fmdsub: 1
bodies:
  a: {mass: 1, inertia: 1/12, at: [0.5, 0]}
  c: {mass: 1, inertia: 1/12, at: [1.5, 0]}
  b: {mass: 1, inertia: 1/12, at: [1.5, 0]}
constraints:
  A: {revolute: [ground, a], at: [0, 0]}
  B: {revolute: [a, c], at: [1, 0]}
  C: {revolute: [c, b], at: [2, 0]}
  D: {revolute: [ground, b], at: [1, 0]}
initial: {$3}
integrate: {scheme: midpoint, step: 1.0e-3, until: 8}
output: {every: 8, columns: [A.angle, D.angle]}
END
    "$FMDSUB" run "$work/deck.yaml" >"$work/out" 2>"$work/err"
    ended "$1: status" "$2" $? "$work/out" "$work/err"
    [ "$2" = 0 ] || return 0
    grep -q W-branch "$work/err" && ok "$1: told" || not_ok "$1: told" "no W-branch" "$work/err"
    tail -n 1 "$work/out" | awk -F, -v want="$4" '{ split(want, w, ","); fine = NF == 3 && ($2 - w[1]) ^ 2 + ($3 - w[2]) ^ 2 < 1e-10 } END { exit !fine }' &&
        ok "$1" || not_ok "$1" "expected 8,$4" "$work/out"
}
flat "flat, as a parallelogram" 0 "A.angle_rate: 1, D.angle_rate: 1" 8,8
flat "flat, by another pair of rates" 0 "A.angle_rate: -2, B.angle_rate: 2" -16,-16
flat "flat, folded" 0 "A.angle_rate: 0, D.angle_rate: 1" 0,8
flat "flat, one rate fits both" 4 "A.angle_rate: 1"
flat "flat, rates of no branch" 4 "A.angle_rate: 1, D.angle_rate: -1"
flat "flat, at rest" 4 ""

# A third crank, longer by e: the loops are redundant, and near a dead point the misfit is its root.
"$FMDSUB" run - >"$work/out" 2>"$work/err" <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies:
  a: {mass: 1, inertia: 1/12, at: [0, 0.5]}
  b: {mass: 1, inertia: 1/12, at: [1, 0.5]}
  d: {mass: 1, inertia: 1/12, at: [2, 0.5]}
  c: {mass: 1, inertia: 1/12, at: [1, 1]}
constraints:
  A: {revolute: [ground, a], at: [0, 0]}
  B: {revolute: [ground, b], at: [1, 0]}
  D: {revolute: [ground, d], at: [2, 0]}
  P: {revolute: [a, c], at: [0, 1]}
  Q: {revolute: [b, c], at: [1, 1]}
  R: {revolute: [d, c], at: [2, 1 + 1.0e-4]}
initial: {A.angle_rate: -1}
integrate: {scheme: midpoint, step: 1.0e-3, until: 10}
output: {every: 1, columns: [A.angle]}
END
expect "a third crank, longer by 1e-4: status" 5 $? "$work/err"
grep -q "others hold the same freedom, and sizes that differ from theirs" "$work/err" &&
    ok "a third crank, longer by 1e-4: the reason" || not_ok "a third crank, longer by 1e-4: the reason" "not told" "$work/err"
