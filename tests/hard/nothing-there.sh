# nothing-there.sh -- what is in a scene and does nothing changes nothing: neither the motion nor what it takes.
. tests/tools/lib.sh

counts() { grep -E '^(major_steps|minor_steps|slow_evaluations|fast_evaluations|factorizations|sweeps|rejected) ' "$1"; }
go() { "$FMDSUB" run -q -c 't,shaft.*,slide.*,coupler.*,wrist.*' --stats="$work/stats" $(echo "$2" | sed 's/[^ ]*/--set integrate.&/g') "$1" 2>"$work/err"; }

# nothing NAME FORCES [TOP]: lines in forces and at the top of the deck that do nothing; not under the scheme BUT.
nothing() {
    awk -v more="$2" -v top="${3:-}" '{ print } /^forces:/ && more != "" { print more } END { if (top != "") print top }' tests/hard/units/loop.yaml >"$work/with.yaml"
    for how in 'scheme=midpoint' 'scheme=newmark' 'scheme=subcycle ratio=4' 'scheme=dopri5 tolerance=1e-6' 'scheme=radau5 tolerance=1e-5'; do
        case $how in "scheme=${BUT:-none}"*) continue ;; esac
        go tests/hard/units/loop.yaml "$how" >"$work/one"
        counts "$work/stats" >"$work/was"
        go "$work/with.yaml" "$how" >"$work/two"
        counts "$work/stats" >"$work/is"
        same "$1, $how: the same bytes" "$work/one" "$work/two"
        same "$1, $how: the same effort" "$work/was" "$work/is"
    done
}

# Beside what may touch radau5 differs by round-off, over the corners of a table newmark halves steps that spoil the balance.
BUT=radau5 nothing "a stop that is not touched" "  stop: {unilateral: slide, stiffness: 1.0e+5, from: 5}"
nothing "a spring of no stiffness" "  limp: {spring: [coupler.tip, [3, 3]], stiffness: 0}"
nothing "a damper of nothing" "  dry: {damper: [crank.end, rocker], damping: 0}"
BUT=newmark nothing "a curve of zeros" "  flat: {curve: elbow, table: [[-9, 0], [0, 0], [9, 0]]}"
nothing "a force of none" "  calm: {force: coupler.tip, value: [0, 0]}"
nothing "a bushing of nothing" "  air: {bushing: [crank, rocker], at: [0.5, 0.5]}"
BUT=radau5 nothing "a compliant contact far off" "" "surfaces: {skin: {sphere: weight, radius: 0.1}, wall: {plane: ground, at: [9, 0], normal: [-1, 0]}}
contacts: {far: {between: [skin, wall], stiffness: 1.0e+5}}"
nothing "an expression that has not begun" "  late: {torque: pivot, value: \"if(t < 90, 0, 5)\"}"
