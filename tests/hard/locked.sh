# locked.sh -- a drive that locks an axle: no posture beside the dead point is better, and the power of the drive is found another way.
# SCHEMES, one a line: others than a quick one.
. tests/tools/lib.sh
echo "${SCHEMES:-rk4, step: 1.0e-3}" >"$work/schemes"
while read -r scheme; do
    "$FMDSUB" run -q -s 'drives.steering.value=-0.5432667801122102*(1 - cos(5*t))' -s 'forces.road1.value=[0,0,330]' \
        -s "integrate={scheme: $scheme, until: 1}" decks/axle.yaml >"$work/out" 2>"$work/err"
    expect "a locked axle, ${scheme%,*}: stops" "5 1" "$? $(grep -c 'stopped at t = 0.11.*\[dead-point\]$' "$work/err")" "$work/err"
done <"$work/schemes"
