# told.sh -- what a run says of keys that change nothing, and when it does not.
. tests/tools/lib.sh

cat >"$work/deck.yaml" <<'END'
fmdsub: 1
bodies:
  car: {mass: 1, at: [0, 0]}
  box: {mass: 1, at: [1, 0]}
constraints:
  rail: {prismatic: [ground, car], axis: [1, 0]}
  slot: {prismatic: [car, box], axis: [1, 0]}
forces:
  leaf: {spring: slot, stiffness: 100}
initial: {slot.displacement: 0.1}
integrate: {step: 1.0e-3, until: 0.1}
output: {every: 0.01}
END

# heard NAME WARNINGS ARGUMENT...: the words before the first "means" of every W-scheme, in order.
heard() {
    heard_name=$1 heard_want=$2
    shift 2
    "$FMDSUB" run -q "$@" "$work/deck.yaml" >"$work/out" 2>"$work/err" || {
        not_ok "$heard_name" "the run failed" "$work/err"
        return
    }
    expect "$heard_name" "$heard_want" \
        "$(sed -n "s/.*warning: '\([a-z_]*\)' means nothing to scheme \([a-z0-9]*\): .*W-scheme.*/\1 \2/p" "$work/err" | tr '\n' ';')" \
        "$work/err"
}

# with SECTION: the deck has it for its own.
with() {
    sed "s|^integrate: .*|integrate: $1|" "$work/deck.yaml" >"$work/deck" && mv "$work/deck" "$work/deck.yaml"
}

with '{scheme: newmark, step: 1.0e-3, until: 0.1, ratio: 5, rho_infinity: 0.9, tolerance: 1.0e-6, symmetric: true}'
heard "newmark reads neither rates nor damping" \
    "ratio newmark;rho_infinity newmark;tolerance newmark;symmetric newmark;"
heard "a scheme in place of the deck's passes over the deck's keys" "" --set integrate.scheme=midpoint
heard "but not over one given with it" "gamma midpoint;" --set integrate.scheme=midpoint --set integrate.gamma=0.5
heard "a key given to the deck's scheme" "rho_infinity newmark;tolerance newmark;symmetric newmark;ratio newmark;" \
    --set integrate.ratio=10
with '{step: 1.0e-3, until: 0.1, beta: 0.25, gamma: 0.5, newton_tolerance: 1.0e-9}'
heard "the default scheme reads no beta" "beta subcycle;gamma subcycle;"
with '{scheme: rk4, step: 1.0e-3, until: 0.1, ratio: 1, rho_infinity: 1, symmetric: false, iteration: newton}'
heard "words that say what is done anyway are not told" "iteration rk4;"
with '{scheme: dopri5, tolerance: 1.0e-6, step: 1.0e-3, until: 0.1}'
heard "dopri5 chooses its steps" "step dopri5;"
sed '/^output:/d' "$work/deck.yaml" >"$work/deck" && mv "$work/deck" "$work/deck.yaml"
heard "but records fall on them" ""
with '{scheme: newmark, step: 1.0e-3, until: 0.1, beta: 0.3, gamma: 0.55, iteration: fixed-point, newton_tolerance: 1.0e-9}'
heard "newmark reads its own" ""
with '{scheme: midpoint, step: 1.0e-3, until: 0.1}'
echo 'partition: {fast: [slot]}' >>"$work/deck.yaml"
heard "one rate has no fast coordinates" "fast midpoint;"
heard "unless it is there to be compared" "" --set integrate.scheme=newmark
with '{scheme: subcycle, step: 1.0e-3, until: 0.1, ratio: 5, rho_infinity: 0.9, symmetric: true, newton_tolerance: 1.0e-9}'
heard "subcycle reads its own" ""
"$FMDSUB" study -q --schemes newmark,midpoint --steps 1.0e-3 --repeats 1 --set integrate.gamma=0.5 "$work/deck.yaml" >"$work/out" 2>"$work/err"
expect "a study compares: status" 0 $? "$work/err"
expect "a study compares: nothing told" "" "$(grep W-scheme "$work/err")"
for deck in decks/*.yaml; do
    "$FMDSUB" check "$deck" 2>&1 | grep -q W-scheme && not_ok "$deck" "its scheme does not read what it says"
done
ok "shipped decks say nothing in vain"
