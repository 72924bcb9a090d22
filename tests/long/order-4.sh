# order-4.sh -- two rates of order 4 beside the cheapest of one rate at the same accuracy.
. tests/tools/lib.sh

# Two rates of order 4 are found by study itself, at ratios of its own, and told: a picked one is lines of a deck that run.
# Judged is a whole run, a short one: of the deck's own 2 s the budget leaves as much as the machine is quick.
timeout 120 "$FMDSUB" study --repeats 0 --budget 20 --until 0.2 --schemes subcycle,radau9 decks/satellite-instrument.yaml >"$work/rows" 2>"$work/err"
expect "order 4: the run is whole" "1 0" "$(grep -c '^reference: ' "$work/err") $(grep -c '^the budget takes it to' "$work/err")" "$work/err"
awk -F, '$16 == "ok" && $5 <= 1e-4 { if ($1 == "radau9" && (!one || $9 < one)) one = $9; if ($19 == 4 && (!two || $9 < two)) two = $9 }
    END { print two, one; exit !(two > 0 && one >= 4 * two) }' "$work/rows" >"$work/line"
expect "order 4 at 1e-4: a quarter of the work of one rate" 0 $? "$work/line" "$work/err"
expect "order 4 at 1e-4: told" 1 "$(grep -Ec '^error below 1e-04: subcycle of order 4 at step .*, ratio 20 .*radau9, which takes 5\.[34] times' "$work/err")" "$work/err"
timeout 120 "$FMDSUB" study --repeats 0 --budget 20 --schemes subcycle,radau9 decks/satellite-instrument.yaml >"$work/rows" 2>"$work/err"
# Trials at 1e-6 do not resolve the carriage on its bearing and promise both runs of the reference to 1e-11 within the budget:
# those are left, and two that get to records are found by what they have cost.
expect "runs dearer than foretold: the reference reaches records" 1 "$(grep -c '^the budget takes it to t = 0\.[2-9]* s of 2: ' "$work/err")" "$work/err"
timeout 120 "$FMDSUB" study -q --repeats 0 --budget 20 --schemes subcycle,radau9 --pick 1e-4 decks/satellite-instrument.yaml >"$work/picked" 2>"$work/err"
expect "order 4: picked" "2 ratio: 20 order: 4" "$(grep -c 'scheme: subcycle\|step: 0.00125' "$work/picked") $(grep -o 'ratio: .*\|order: .*' "$work/picked" | tr '\n' ' ' | sed 's/ $//')" "$work/picked" "$work/err"

# A small fast arm among large slow ones, which it does not shake: to 1e-4 a seventh of the work of the cheapest other scheme, at the most.
timeout 120 "$FMDSUB" study --repeats 0 --budget 10 --schemes subcycle,dop853,dopri5 --steps 1.6666666666666667e-5 --ratios 300 tests/bench/small-fast.yaml >"$work/rows" 2>"$work/err"
awk -F, '$16 == "ok" && $5 <= 1.1e-4 { if ($19 == 4 && (!two || $9 < two)) two = $9; else if ($1 != "subcycle" && (!one || $9 < one)) one = $9 }
    END { print two, one; exit !(two > 0 && one >= 7 * two) }' "$work/rows" >"$work/line"
expect "order 4 at 1e-4 beside what it does not shake: a seventh of the work" 0 $? "$work/line" "$work/err"
