# corners.sh -- a drive whose rate jumps while joints rub or rigid contacts are closed is told, once, and rounded it is right.
. tests/tools/lib.sh

CORNER='"if(t < 0.5, t, 0.5 + 3*(t - 0.5))"'
TABLE='{table: [[0, 0], [0.25, 0.25], [0.5, 0.5], [0.75, 1.25], [1, 1]]}'
ROUNDED='"t + 2*if(t < 0.5, 0, if(t < 0.5001, (t - 0.5)^2/2.0e-4, t - 0.50005))"'

# carried DRIVE JOINT REST-OF-IT [FOOT]: a carriage of 2 kg driven along y, rate 1 to 3 at 0.5 s; on it, at 3 m/s across, a block of 1 kg.
carried() {
    cat >"$work/deck.yaml" <<EOF
fmdsub: 1
bodies: {s: {mass: 2, inertia: 0.1, at: [0, 0]}, b: {mass: 1, inertia: 0.05, at: [0, 0], points: {foot: [0, ${4:-0}]}}}
constraints:
  g: {prismatic: [ground, s], axis: [0, 1]}
  j: $2
drives: {lift: {drive: g, value: $1}}
$3
integrate: {until: 1}
output: {every: 0.5, columns: [b.vx]}
EOF
}

# told WHAT EXPECTED ARGUMENT...: exit status under --strict, warnings of corners, their times and drives, the last b.vx.
told() {
    told_what=$1 told_want=$2
    shift 2
    "$FMDSUB" run -q --strict "$@" "$work/deck.yaml" >"$work/out" 2>"$work/err"
    expect "$told_what" "$told_want" "$? $(grep -c W-corner "$work/err") $(sed -n "s/^warning: \(t = [0-9.]* s\): the rate of \(drive '[a-z]*'\) jumps.*W-corner.*/\1 \2 /p" "$work/err")$(tail -n 1 "$work/out" | awk -F, '{ printf "%.4f", $2 }')" "$work/err"
}

SLIDE='{prismatic: [s, b], axis: [1, 0], friction: 0.3}'
SLIDES='initial: {g.displacement_rate: 1, j.displacement_rate: 3}'
FIXED='--set integrate.scheme=midpoint --set integrate.step=1e-3'
carried "$CORNER" "$SLIDE" "$SLIDES"
told "a slide that rubs" "1 1 t = 0.5 s drive 'lift' 3.0000"
told "at fixed steps" "1 1 t = 0.5 s drive 'lift' 3.0000" $FIXED
told "steps that do not end at the corner" "1 1 t = 0.5 s drive 'lift' 3.0000" $FIXED --set integrate.step=3e-3 --set integrate.until=1.002 --set output.every=0.501
"$FMDSUB" run "$work/deck.yaml" >"$work/out" 2>"$work/err"
ended "not strict: status" 0 $? "$work/out" "$work/err"
expect "the estimated error is not known" 1 "$(grep -c '^estimated error: not known: the rate of a drive jumps' "$work/err")" "$work/err"
carried "$ROUNDED" "$SLIDE" "$SLIDES"
told "a slide, rounded" "0 0 2.4000"
told "fixed steps shorter than the round" "0 0 2.4000" $FIXED --set integrate.step=2e-5
carried "$TABLE" "$SLIDE" "$SLIDES"
told "a table of two corners: once" "1 1 t = 0.5 s drive 'lift' 3.0000"
carried "$CORNER" '{prismatic: [s, b], axis: [1, 0], friction: {force: 0.001}}' "$SLIDES"
told "friction of a given force" "0 0 2.9990"
carried "$CORNER" '{prismatic: [s, b], axis: [1, 0]}' "$SLIDES"
told "without friction" "0 0 3.0000"
told "without friction, at fixed steps" "0 0 3.0000" $FIXED

# What the blow does not reach: a slide that rubs on the ground beside it.  A spring hands on no impulse; a joint does.
beside() {
    carried "$CORNER" '{prismatic: [s, b], axis: [1, 0]}' "$SLIDES"
    sed -i "s/^bodies: {/&d: {mass: 1, inertia: 0.1, at: [5, 0]}, /; s/^constraints:/&\n  beside: {prismatic: [ground, d], axis: [1, 0], friction: 0.3}\n  ${1:-}/" "$work/deck.yaml"
    [ -z "${2:-}" ] || echo "$2" >>"$work/deck.yaml"
}
beside
told "what rubs is beside it" "0 0 3.0000"
told "what rubs is beside it, at fixed steps" "0 0 3.0000" $FIXED
beside "" "forces: {f: {spring: [s, d], stiffness: 0.001}}"
told "what rubs hangs on a spring" "0 0 3.0000"
beside "rod: {distance: [s, d]}"
told "what rubs hangs on a rod" "1 1 t = 0.5 s drive 'lift' 3.0000"

# Two corners within a step cancel in its rates: of a table, and of an expression.
carried '{table: [[0, 0], [0.5003, 0.5003], [0.5006, 0.5009], [1, 1.0003]]}' "$SLIDE" "$SLIDES"
told "two corners of a table in one step" "1 1 t = 0.5003 s drive 'lift' 3.0000" $FIXED
carried '"t + if(t < 0.5003, 0, if(t < 0.5006, t - 0.5003, 0.0003))"' "$SLIDE" "$SLIDES"
told "two corners of an expression in one step" "1 1 t = 0.5003 s drive 'lift' 3.0000" $FIXED

# on DRIVE [HEIGHT]: the block lies on the carriage, or its foot is above it.
on() {
    carried "$1" '{planar: [ground, b]}' "surfaces: {top: {plane: s, at: [0, 0], normal: [0, 1]}, p: {point: b.foot}}
contacts: {c: {between: [p, top], friction: 0.3}}
initial: {g.displacement_rate: 1, j.x_rate: 3, j.y_rate: 1}" "${2:-0}"
}
on "$CORNER"
told "a contact that is closed" "1 1 t = 0.5 s drive 'lift' 2.4000"
told "the same at fixed steps" "1 1 t = 0.5 s drive 'lift' 2.4000" $FIXED
on "$ROUNDED"
told "a contact, rounded" "0 0 2.4000"
on "$CORNER" 5
told "a contact that is open" "0 0 3.0000"
told "open at fixed steps" "0 0 3.0000" $FIXED

# A run that goes on from another knows of its corner, but has none to tell; one more it tells.
on "$CORNER"
"$FMDSUB" run -q --until 0.6 --set output.every=0.1 --final-state "$work/half.json" "$work/deck.yaml" >"$work/out" 2>"$work/err"
"$FMDSUB" run --set output.every=0.1 --set "initial={from: half.json, time: keep}" "$work/deck.yaml" >"$work/out" 2>"$work/err"
expect "going on behind a corner" "0 1 6" \
    "$(grep -c W-corner "$work/err") $(grep -c '^estimated error: not known: the rate of a drive jumps' "$work/err") $(wc -l <"$work/out" | tr -d ' ')" "$work/err"
"$FMDSUB" run -q --until 0.5 --set output.every=0.1 --final-state "$work/half.json" "$work/deck.yaml" >"$work/out" 2>"$work/err"
expect "ending at a corner: none is met" "0 wrote" "$(grep -c W-corner "$work/err") $(wrote "$work/out")" "$work/err"
"$FMDSUB" run -q --set output.every=0.1 --set "initial={from: half.json, time: keep}" "$work/deck.yaml" >"$work/out" 2>"$work/err"
expect "going on right at a corner" 1 "$(grep -c W-corner "$work/err")" "$work/err"
