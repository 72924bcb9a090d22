# watched.sh -- effects that a deck turns off are watched: told at the end, beyond the tolerance of `effects` with a warning.
. tests/tools/lib.sh
deck=decks/spin-up-slow.yaml
off="-s effects.stiffening=false -s integrate.until=10"

"$FMDSUB" run $off "$deck" >"$work/out" 2>"$work/err"
ended "stiffening turned off runs" 0 $? "$work/out" "$work/err"
expect "its share is told at the end" 1 "$(grep -c 'left out: stiffening of .arm.: about' "$work/err")" "$work/err"
expect "without a tolerance it is no warning" "1 0" "$(grep -c 'left out: ' "$work/err") $(grep -c W-effect "$work/err")" "$work/err"
"$FMDSUB" run $off -s effects.tolerance=1e-2 "$deck" >"$work/out" 2>"$work/err"
expect "beyond the tolerance it is one, with the time" 1 "$(grep -c 'passed at t = .*W-effect' "$work/err")" "$work/err"
undamped="-s effects.damping=false decks/cantilever.yaml"
"$FMDSUB" run --strict -s effects.tolerance=1e-2 $undamped >"$work/out" 2>"$work/err"
expect "with --strict that ends with 1" 1 $? "$work/err"
"$FMDSUB" run --strict -s effects.tolerance=0.5 $undamped >"$work/out" 2>"$work/err"
ended "within it all is well" 0 $? "$work/out" "$work/err"
expect "and nothing is warned of" "yes 0" "$([ -s "$work/err" ] && echo yes) $(grep -c W-effect "$work/err")" "$work/err"
"$FMDSUB" run -f json $off "$deck" 2>/dev/null | grep -q '"neglected_stiffening":0\.[0-9]' && ok "the summary has it" || not_ok "the summary has it" "no neglected_stiffening"
"$FMDSUB" run "$deck" -s integrate.until=1 >"$work/out" 2>"$work/err"
expect "what is on is not told" "yes 0" "$([ -s "$work/err" ] && echo yes) $(grep -c 'left out' "$work/err")" "$work/err"
"$FMDSUB" run $undamped >"$work/out" 2>"$work/err"
expect "damping likewise" 1 "$(grep -c 'left out: damping of .arm.: about' "$work/err")" "$work/err"
# A run that is resumed adds on.
mkdir -p "$work/a" && cp decks/cantilever.yaml "$work/a/deck.yaml" && cd "$work/a" || exit 1
"$FMDSUB" run -q -f ndjson -s effects.damping=false deck.yaml | tail -n 1 | grep -o '"neglected_damping":[0-9.e-]*' >"$work/whole"
"$FMDSUB" run -q -f ndjson -s effects.damping=false -s 'checkpoint={every: 0.2, file: kept}' -o two.ndjson deck.yaml >/dev/null 2>"$work/err"
"$FMDSUB" run -q -f ndjson -s effects.damping=false -s 'checkpoint={every: 0.2, file: kept}' -o two.ndjson --resume kept deck.yaml >/dev/null 2>>"$work/err"
tail -n 1 two.ndjson | grep -o '"neglected_damping":[0-9.e-]*' >"$work/resumed"
same "a resumed run tells the same share" "$work/whole" "$work/resumed"
