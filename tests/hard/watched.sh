# watched.sh -- effects that a deck turns off are watched: told at the end, beyond the tolerance of `effects` with a warning.
. tests/tools/lib.sh
deck=decks/spin-up-slow.yaml
off="-s effects.stiffening=false -s integrate.until=10"

"$FMDSUB" run $off "$deck" >"$work/out" 2>"$work/err"
ended "stiffening turned off runs" 0 $? "$work/out" "$work/err"
expect "its share is told at the end" 1 "$(grep -c 'left out: stiffening: about .* of .arm.tip.*, by a second run with it' "$work/err")" "$work/err"
expect "without a tolerance it is no warning" "1 0" "$(grep -c 'left out: ' "$work/err") $(grep -c W-effect "$work/err")" "$work/err"
"$FMDSUB" run $off -s effects.tolerance=1e-2 "$deck" >"$work/out" 2>"$work/err"
expect "beyond the tolerance it is one, with the time" 1 "$(grep -c 'passed at t = .*W-effect' "$work/err")" "$work/err"
undamped="-s effects.damping=false decks/cantilever.yaml"
"$FMDSUB" run --strict -s effects.tolerance=1e-2 $undamped >"$work/out" 2>"$work/err"
expect "with --strict that ends with 1" 1 $? "$work/err"
"$FMDSUB" run --strict -s effects.tolerance=0.5 $undamped >"$work/out" 2>"$work/err"
ended "within it all is well" 0 $? "$work/out" "$work/err"
expect "and nothing is warned of" "yes 0" "$([ -s "$work/err" ] && echo yes) $(grep -c W-effect "$work/err")" "$work/err"
"$FMDSUB" run -f json $off "$deck" 2>/dev/null | grep -q '"neglected_stiffening":[01]\.[0-9]' && ok "the summary has it" || not_ok "the summary has it" "no neglected_stiffening"
"$FMDSUB" run "$deck" -s integrate.until=1 >"$work/out" 2>"$work/err"
expect "what is on is not told" "yes 0" "$([ -s "$work/err" ] && echo yes) $(grep -c 'left out' "$work/err")" "$work/err"
"$FMDSUB" run $undamped >"$work/out" 2>"$work/err"
expect "damping likewise" 1 "$(grep -c 'left out: damping: about .* of .arm' "$work/err")" "$work/err"
"$FMDSUB" run -s effects.tolerance=1 $undamped >"$work/out" 2>"$work/err"
expect "far from the tolerance records are enough" 1 "$(grep -c 'left out: damping of .arm.: about .* of how it bends' "$work/err")" "$work/err"
# Effects without a watch at records are watched by a second run; what is booked, such as energies, is not judged.
heavy="-s effects.gyroscopic=false --until 0.1 decks/heavy-top.yaml"
"$FMDSUB" run $heavy --columns t,top.x >"$work/out" 2>"$work/err"
expect "w x J w is told of a column" 1 "$(grep -c "left out: gyroscopic: about .* of 'top.x'" "$work/err")" "$work/err"
"$FMDSUB" run $heavy --columns t,energy.kinetic >"$work/out" 2>"$work/err"
expect "of energies alone it is not" 1 "$(grep -c 'left out: gyroscopic: what it would change has not been watched' "$work/err")" "$work/err"
"$FMDSUB" run -q $heavy >"$work/out" 2>"$work/err"
expect "quiet runs say nothing" "0 wrote" "$(wc -c <"$work/err" | tr -d ' ') $(wrote "$work/out")" "$work/err"
"$FMDSUB" run -q --strict -s effects.tolerance=1e-3 $heavy >"$work/out" 2>"$work/err"
expect "but what is beyond the tolerance" "1 1" "$? $(grep -c W-effect "$work/err")" "$work/err"
"$FMDSUB" run -q -s effects.gyroscopic=false -s 'integrate={scheme: dopri5, tolerance: 1e-5, until: 0.1}' decks/heavy-top.yaml >"$work/out" 2>"$work/err"
expect "the run's tolerance gives one, a tenth of it" 1 "$(grep -c "the tolerance of 'effects', 1e-06, is passed.*W-effect" "$work/err")" "$work/err"
"$FMDSUB" run -f json -q -s effects.gravity=false decks/pendulum.yaml 2>/dev/null | grep -q '"neglected_gravity":[12]' && ok "the summary has gravity" || not_ok "the summary has gravity" "no neglected_gravity"
for given in "1.0e-4 1e-3 1e-05" "1.0e-2 1e-2 0.001" "1.0e-2 1e-4 0.0001"; do
    set -- $given
    "$FMDSUB" check --no-trial -s bodies.arm.modes=auto -s effects.tolerance=$2 -s "integrate={scheme: dopri5, tolerance: $1, until: 0.1}" decks/cantilever.yaml >"$work/out" 2>"$work/err"
    expect "modes: auto, run to $1, effects to $2: to $3" 1 "$(grep -c "modes: auto: .* tolerance $3\$" "$work/out")" "$work/out" "$work/err"
done
# A run that ends by what happens: not by the one instant that both have, but by when they end.
"$FMDSUB" run -s effects.gravity=false -s 'integrate.until={when: "pin.angle > 0.1", latest: 3}' decks/pendulum.yaml >"$work/out" 2>"$work/err"
expect "an end at another time is a change" 1 "$(grep -c "left out: gravity: about 95 % of 't'" "$work/err")" "$work/err"
# A body's own key is watched as the deck's.
"$FMDSUB" run -s bodies.arm.stiffening=false -s integrate.until=10 "$deck" >"$work/out" 2>"$work/err"
expect "a body's own key is watched, too" 1 "$(grep -c 'left out: stiffening: about' "$work/err")" "$work/err"
"$FMDSUB" run -s bodies.arm.beam.rotary=false -s effects.rotary=true -s integrate.until=1 "$deck" >"$work/out" 2>"$work/err"
expect "also where it goes before" 1 "$(grep -c 'left out: rotary: about' "$work/err")" "$work/err"
# Shear, which counts by default where its factors are given: turned off, by either key, it is watched where they are known.
shear() { # NAME COUNT ARGUMENTS
    shear_name=$1 shear_count=$2
    shift 2
    "$FMDSUB" run -s integrate.until=0.1 "$@" decks/cantilever.yaml >"$work/out" 2>"$work/err"
    expect "$shear_name" "0 wrote $shear_count" "$? $(wrote "$work/out") $(grep -c 'left out: shear: about' "$work/err")" "$work/err"
}
shear "shear of a shape, off by the body's key" 1 -s bodies.arm.beam.shear=false
shear "off by the deck's" 1 -s effects.shear=false
shear "off by default" 0 -s title=x
shear "off by the deck's, on by the body's" 0 -s effects.shear=false -s bodies.arm.beam.shear=true
shear "of numbers without factors it is not known" 0 -s effects.shear=false -s 'bodies.arm.section={area: 3.0e-4, Iz: 2.5e-9, y: 0.005}'
shear "of a material without nu neither" 0 -s effects.shear=false -s 'bodies.arm.material={E: 2.1e+11, density: 7850}'
# On bodies in loops, which records do not watch.
"$FMDSUB" run -s effects.stiffening=false -s integrate.until=0.01 decks/flexible-crank.yaml >"$work/out" 2>"$work/err"
expect "and bodies in loops" 1 "$(grep -c 'left out: stiffening: about .* by a second run' "$work/err")" "$work/err"
# The records are those of a run that is not watched.
"$FMDSUB" run -q $heavy >"$work/quiet" 2>"$work/err"
"$FMDSUB" run $heavy >"$work/loud" 2>"$work/err"
same "watching changes no record" "$work/quiet" "$work/loud"
"$FMDSUB" run -s effects.gyroscopic=false --until 0.1 - <decks/heavy-top.yaml >"$work/loud" 2>"$work/err"
same "a deck from standard input likewise" "$work/quiet" "$work/loud"
expect "and it is watched" 1 "$(grep -c 'left out: gyroscopic: about' "$work/err")" "$work/err"
# A run that is resumed adds on: such runs are watched at records alone.
mkdir -p "$work/a" && cp decks/cantilever.yaml "$work/a/deck.yaml" && cd "$work/a" || exit 1
"$FMDSUB" run -q -f ndjson -s effects.damping=false -s 'checkpoint={every: 10, file: whole}' -o one.ndjson deck.yaml
tail -n 1 one.ndjson | grep -o '"neglected_damping":[0-9.e-]*' >"$work/whole"
"$FMDSUB" run -q -f ndjson -s effects.damping=false -s 'checkpoint={every: 0.2, file: kept}' -o two.ndjson deck.yaml >/dev/null 2>"$work/err"
"$FMDSUB" run -q -f ndjson -s effects.damping=false -s 'checkpoint={every: 0.2, file: kept}' -o two.ndjson --resume kept deck.yaml >/dev/null 2>>"$work/err"
tail -n 1 two.ndjson | grep -o '"neglected_damping":[0-9.e-]*' >"$work/resumed"
same "a resumed run tells the same share" "$work/whole" "$work/resumed"
