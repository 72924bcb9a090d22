# evidence.sh -- modes: auto keeps what a deck asks for: a panel slewed in its stiff plane bends there, equal ones stay
# together, modes that the deck names are there, and a body from a file is chosen from, too.
. tests/tools/lib.sh

panel() { # MODES
    cat <<DECK
fmdsub: 1
bodies:
  hub: {mass: 1, inertia: [1, 1, 1], at: [0, 0, 0]}
  panel:
    beam: {from: [0.1, 0, 0], to: [2.1, 0, 0], elements: 10}
    section: {rectangle: [0.4, 0.004]}
    material: aluminium
    modes: $1
    points: {tip: {station: 1}}
constraints:
  shaft: {revolute: [ground, hub], at: [0, 0, 0], axis: [0, 0, 1]}
  clamp: {fixed: [hub, panel], at: [0.1, 0, 0]}
drives:
  slew: {drive: shaft.angle, value: "t^3"}
integrate: {scheme: midpoint, step: 1.0e-3, until: 0.5}
output: {every: 0.05, columns: [panel.tip.dy]}
DECK
}

last_of() { tail -n 1 "$1" | cut -d, -f2; }

panel 3 | "$FMDSUB" run -q - >"$work/three" 2>"$work/err"
panel 40 | "$FMDSUB" run -q - >"$work/all" 2>"$work/err"
panel auto | "$FMDSUB" run -q - >"$work/auto" 2>"$work/err"
near=$(awk -v a="$(last_of "$work/auto")" -v b="$(last_of "$work/all")" 'BEGIN { print a + 0 != 0 && (a - b)^2 <= (1e-3 * b)^2 }')
expect "a panel slewed in its stiff plane bends as with all modes" 1 "$near" "$work/auto" "$work/all" "$work/err"
expect "its three lowest modes do not" 1 "$(awk -v a="$(last_of "$work/three")" -v b="$(last_of "$work/all")" 'BEGIN { print b + 0 != 0 && (a < 0 ? -a : a) < 0.1 * (b < 0 ? -b : b) }')"
panel auto | "$FMDSUB" check - >"$work/check" 2>"$work/err"
expect "no mode that bends it the other way is kept" "yes 0" "$(grep -q 'bending y  *kept' "$work/check" && echo yes) $(grep -c 'bending z  *kept' "$work/check")" "$work/check"
expect "those that bend it in its plane are" 1 "$(grep -q 'bending y  *kept, share' "$work/check" && echo 1)" "$work/check"
panel auto | sed 's/^integrate/initial: {panel.mode3: 1.0e-6}\nintegrate/' | "$FMDSUB" check - >"$work/check" 2>"$work/err"
expect "a mode that the deck names is there" 1 "$(grep -q 'panel.mode3 ' "$work/check" && echo 1)" "$work/check" "$work/err"
panel 0 | "$FMDSUB" check - >"$work/check" 2>"$work/err"
expect "no mode at all is refused" 3 "$?" "$work/err"

# A round shaft pulled to one side: both of each pair.
cat >"$work/shaft.yaml" <<'DECK'
fmdsub: 1
bodies:
  shaft:
    beam: {from: [0, 0, 0], to: [1, 0, 0], elements: 8}
    section: {circle: 0.01}
    material: steel
    modes: auto
    points: {tip: {station: 1}}
constraints:
  clamp: {fixed: [ground, shaft], at: [0, 0, 0]}
forces:
  pull: {force: shaft.tip, value: [0, "5*t", 0]}
effects: {tolerance: 1.0e-2}
integrate: {scheme: midpoint, step: 1.0e-3, until: 0.1}
output: {every: 0.05, columns: [shaft.tip.dy]}
DECK
"$FMDSUB" check "$work/shaft.yaml" >"$work/check" 2>"$work/err"
y=$(grep -c 'bending y  *kept' "$work/check") z=$(grep -c 'bending z  *kept' "$work/check")
expect "equal modes are kept together" "$y yes" "$z $([ "$z" -gt 0 ] && echo yes)" "$work/check"
expect "and there are some" 1 "$([ "$y" -gt 0 ] && echo 1)" "$work/check"

# From a file: the airscrew's blade.
sed -e 's/flexible: blade.json/flexible: blade.json, modes: auto/' decks/airscrew/airscrew-steady.yaml >"$work/deck.yaml"
cp decks/airscrew/blade.json decks/airscrew/screw.yml "$work/" 2>/dev/null
"$FMDSUB" check "$work/deck.yaml" >"$work/check" 2>"$work/err"
expect "modes of a file are chosen" 1 "$(grep -q 'modes: auto' "$work/check" && echo 1)" "$work/check" "$work/err"
