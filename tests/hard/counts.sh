# counts.sh -- freedoms none, all, or not to be counted: trusses, loose bodies, nothing at all, more equations than unknowns.
. tests/tools/lib.sh
try() { # NAME WANTED WORDS: the deck on stdin
    "$FMDSUB" run - >"$work/out" 2>"$work/err"
    rc=$?
    ended "$1: status" "$2" $rc "$work/out" "$work/err"
    if grep -q -- "$3" "$work/err"; then ok "$1: told"; else not_ok "$1: told" "'$3' is not in" "$work/err"; fi
    if [ $rc != "$2" ] || { [ $rc = 0 ] && [ ! -s "$work/out" ]; } || grep -qi 'nan\|inf' "$work/out"; then not_ok "$1: numbers" "none, or not finite:" "$work/out"; else ok "$1: numbers"; fi
}

try "triangle truss" 4 "0 freedoms" <<'END'
fmdsub: 1
bodies:
  a: {mass: 1, inertia: 0.1, at: [0.5, 0]}
  b: {mass: 1, inertia: 0.1, at: [0.75, 0.5]}
  c: {mass: 1, inertia: 0.1, at: [0.25, 0.5]}
constraints:
  foot: {fixed: [ground, a], at: [0, 0]}
  ab: {revolute: [a, b], at: [1, 0]}
  bc: {revolute: [b, c], at: [0.5, 1]}
  ca: {revolute: [c, a], at: [0, 0]}
integrate: {scheme: midpoint, step: 1.0e-3, until: 0.01}
END

try "everything fixed" 0 "0 freedoms" <<'END'
fmdsub: 1
bodies:
  a: {mass: 1, inertia: 0.1, at: [0.5, 0]}
constraints:
  foot: {fixed: [ground, a], at: [0, 0]}
integrate: {scheme: midpoint, step: 1.0e-3, until: 0.01}
END

try "no joints" 0 "6 freedoms" <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies:
  a: {mass: 1, inertia: 0.1, at: [0, 0]}
  b: {mass: 2, inertia: 0.2, at: [1, 0]}
integrate: {scheme: midpoint, step: 1.0e-3, until: 1}
output: {every: 0.5, columns: [a.y, b.y]}
END
awk -F, 'END { d = $2 + 9.81 / 2; e = $3 + 9.81 / 2; exit !(d * d + e * e < 1e-20) }' "$work/out" && ok "no joints: both fall" ||
    not_ok "no joints: both fall" "last:" "$work/out"

try "no bodies" 3 "E-" <<'END'
fmdsub: 1
bodies: {}
integrate: {scheme: midpoint, step: 1.0e-3, until: 1}
END

# Five bars side by side between ground and one bridge: 10 equations of loops for 6 coordinates, one freedom.
try "more equations than unknowns" 0 "redundant, the first" <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies:
  bar$i: {repeat: {i: [1, 6]}, mass: 1, inertia: 1/12, at: [i, -0.5]}
  bridge: {mass: 1, inertia: 1, at: [3.5, -1]}
constraints:
  foot$i: {repeat: {i: [1, 6]}, revolute: [ground, bar$i], at: [i, 0]}
  head$i: {repeat: {i: [1, 6]}, revolute: [bar$i, bridge], at: [i, -1]}
initial: {foot1.angle_rate: 1}
integrate: {scheme: midpoint, step: 1.0e-3, until: 1}
END

try "a free body without mass" 4 "'.*a'" <<'END'
fmdsub: 1
bodies:
  a: {mass: 0, inertia: 0, at: [0, 0]}
  b: {mass: 1, inertia: 1, at: [1, 0]}
integrate: {scheme: midpoint, step: 1.0e-3, until: 1}
END

# The planar four-bar of decks/ and the same from four spatial revolutes, three of whose equations are redundant.
"$FMDSUB" run -q --set integrate.newton_tolerance=1.0e-13 --columns shaft.angle,pivot.angle,shaft.angle_rate,wrist.fx,wrist.fy \
    decks/four-bar.yaml >"$work/plane" 2>"$work/err"
"$FMDSUB" run -q --set integrate.newton_tolerance=1.0e-13 --columns shaft.angle,pivot.angle,shaft.angle_rate \
    tests/decks/spatial-four-bar.yaml >"$work/room" 2>"$work/err"
if "$COMPARE" --reference --within 1e-9 --columns "shaft.angle pivot.angle shaft.angle_rate" "$work/plane" "$work/room" >"$work/cmp" 2>&1
then ok "four-bar of spatial revolutes: differs by $(cat "$work/cmp")"
else not_ok "four-bar of spatial revolutes" "not the planar one's motion" "$work/cmp" "$work/err"; fi

# Bricard's mechanism has one freedom where 6 - 6 are counted: rank 29 of 30 with all bodies free, here 4 of 5.
"$FMDSUB" check decks/bricard.yaml >"$work/out" 2>"$work/err"
grep -q "5 equations, rank 4" "$work/out" && grep -q "pin4 .*1 of them redundant; reactions not unique" "$work/out" &&
    ok "bricard: the redundant row" || not_ok "bricard: the redundant row" "check:" "$work/out"
"$FMDSUB" run -q --every 0.05 --columns energy.residual decks/bricard.yaml >"$work/out" 2>"$work/err"
awk -F, 'NR > 1 { e = $2 < 0 ? -$2 : $2; if (e > worst) worst = e } END { printf "%.2g J", worst; exit !(NR > 100 && worst < 1e-3) }' \
    "$work/out" >"$work/line"
if [ $? = 0 ]; then ok "bricard: energy to $(cat "$work/line") in 10 s"; else not_ok "bricard: energy" "$(cat "$work/line")"; fi

# Three cranks, one longer by 1e-6: they swing as equal ones do; where all lies flat the branch that the third forbids
# would be taken, and the run stops.
sed -e 's/\[1, 3\]/[1, 2]/' -e '/^  bridge:/a\
\  odd: {mass: 1, inertia: 1/12, at: [1.5 + (1 + e)/2*cos(a), (1 + e)/2*sin(a)], orient: a}' -e '/^  head/a\
\  foot4: {revolute: [ground, odd], at: [1.5, 0]}\
\  head4: {revolute: [odd, bridge], at: [1.5 + (1 + e)*cos(a), (1 + e)*sin(a)]}' \
    -e 's/a: 0.3/a: -0.5, e: 1.0e-6/' decks/double-four-bar.yaml >"$work/odd.yaml"
"$FMDSUB" run "$work/odd.yaml" >"$work/out" 2>"$work/err"
ended "a crank too long by 1e-6: status" 0 $? "$work/out" "$work/err"
grep -q "W-redundant" "$work/err" && ok "a crank too long by 1e-6: warned" || not_ok "a crank too long by 1e-6: warned" "stderr:" "$work/err"
"$FMDSUB" run -q --set parameters.e=0 "$work/odd.yaml" >"$work/equal" 2>"$work/err"
if "$COMPARE" --reference --within 1e-4 --columns "foot1.angle bridge.x bridge.y" "$work/equal" "$work/out" >"$work/cmp" 2>&1
then ok "a crank too long by 1e-6: differs by $(cat "$work/cmp")"
else not_ok "a crank too long by 1e-6" "not the motion of equal cranks" "$work/cmp" "$work/err"; fi
"$FMDSUB" run --set parameters.a=0.3 "$work/odd.yaml" >"$work/out" 2>"$work/err"
expect "a crank too long by 1e-6, through the flat posture: status" 5 $? "$work/err"
# Nothing that goes by the root of e is without its word: whatever the scheme and e, the run ends with it or stops by it.
for scheme in 'newmark, step: 1.0e-3' 'midpoint, step: 1.0e-3' 'subcycle, step: 1.0e-3' 'dop853, tolerance: 1.0e-6' 'radau9, tolerance: 1.0e-6'; do
    for e in 1.0e-5 1.0e-7 1.0e-9; do
        "$FMDSUB" run -s "integrate={scheme: $scheme, until: 2}" --set parameters.a=0.3 --set parameters.e=$e "$work/odd.yaml" >"$work/out" 2>"$work/err"
        rc=$?
        case $rc in 0 | 1 | 5) ;; *) rc="a status of $rc" ;; esac
        grep -q "constraint 'head[0-9]' .*make the sizes agree exactly, or" "$work/err" && [ ${#rc} = 1 ] && [ -s "$work/out" ] &&
            ok "a crank too long by $e, $scheme: told" || not_ok "a crank too long by $e, $scheme: told" "$rc, stderr:" "$work/err"
    done
done
"$FMDSUB" run -q --set parameters.a=0.3 --set parameters.e=0 "$work/odd.yaml" >"$work/equal" 2>"$work/err"
ended "equal cranks, through the flat posture: status" 0 $? "$work/equal" "$work/err"
expect "equal cranks: nothing to tell" "records 0" "$([ -s "$work/equal" ] && echo records) $(grep -c 'not quite the same' "$work/err")" "$work/err"
"$FMDSUB" run -q --set parameters.a=0.3 --set parameters.e=1.0e-8 "$work/odd.yaml" >"$work/out" 2>"$work/err"
grep -q "'head[0-9]' miss by up to 1.[0-9]e-08 of the mechanism's size.*not quite the same" "$work/err" &&
    ok "a crank too long by 1e-8, through the flat posture: told" ||
    not_ok "a crank too long by 1e-8, through the flat posture: told" "stderr:" "$work/err"
"$FMDSUB" run --set parameters.e=1.0e-2 "$work/odd.yaml" >"$work/out" 2>"$work/err"
expect "a crank too long by 1e-2: status" 4 $? "$work/err"
grep -q "dead point, or is locked: constraint '[a-z0-9]*' cannot close" "$work/err" && ok "a crank too long by 1e-2: told" ||
    not_ok "a crank too long by 1e-2: told" "stderr:" "$work/err"
