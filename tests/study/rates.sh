# rates.sh -- sub-cycling at the accuracy of one rate: fast errors, and slow ones where the fast part recoils on the slow.
. tests/tools/lib.sh

# The fast error of `subcycle` at n = $3 in table $2 (deck $1) is at most 1.5 times that of the single rate at the small
# step, and with $4 = slow so is the slow one; `miao` is shown beside it.
as_near() {
    awk -F, -v n="$3" -v both="${4:-}" '
        $1 == "midpoint" { fast = $7; slow = $8 }
        $1 == "subcycle" && $4 == n { f = $7; s = $8; state = $16 }
        $1 == "miao" && $4 == n { mf = $7; ms = $8; mstate = $16 }
        END {
            printf "fast error %.3g against %.3g (%.2f), slow %.3g against %.3g; miao fast %.3g, slow %.3g (%s)\n",
                f, fast, f / fast, s, slow, mf, ms, mstate
            exit !(fast > 0 && f <= 1.5 * fast && (both == "" || s <= 1.5 * slow) && state == "ok")
        }' "$2" >"$work/line"
    if [ $? = 0 ]; then ok "$1 n=$3: $(cat "$work/line")"; else not_ok "$1 n=$3" "$(cat "$work/line")" "$work/err"; fi
}

# The chain with stiff leaf joints, plucked.
"$FMDSUB" study -q --schemes midpoint,subcycle,miao --ratios 5,10,20 --steps 1.0e-4 --repeats 1 \
    decks/stiff-leaf-chain.yaml >"$work/chain.csv" 2>"$work/err"
for n in 5 10 20; do as_near stiff-leaf-chain "$work/chain.csv" $n; done

# The same for a flexible arm on a hub with a hundredth of its inertia: the recoil of the arm moves the hub more than
# anything else.
"$FMDSUB" study -q --schemes midpoint,subcycle,miao --ratios 5,20 --steps 2.0e-5 --until 0.2 --repeats 1 \
    decks/light-hub.yaml >"$work/hub.csv" 2>"$work/err"
for n in 5 20; do as_near light-hub "$work/hub.csv" $n slow; done

# Two rates of order 4 are found by study itself, at ratios of its own, and told: a picked one is lines of a deck that run.
# Judged is a whole run, a short one: of the deck's own 2 s the budget leaves as much as the machine is quick.
timeout 120 "$FMDSUB" study --repeats 0 --budget 20 --until 0.2 --schemes subcycle,radau9 decks/satellite-instrument.yaml >"$work/rows" 2>"$work/err"
expect "order 4: the run is whole" "1 0" "$(grep -c '^reference: ' "$work/err") $(grep -c '^the budget takes it to' "$work/err")" "$work/err"
awk -F, '$16 == "ok" && $5 <= 1e-4 { if ($1 == "radau9" && (!one || $9 < one)) one = $9; if ($19 == 4 && (!two || $9 < two)) two = $9 }
    END { print two, one; exit !(two > 0 && one >= 4 * two) }' "$work/rows" >"$work/line"
expect "order 4 at 1e-4: a quarter of the work of one rate" 0 $? "$work/line" "$work/err"
expect "order 4 at 1e-4: told" 1 "$(grep -Ec '^error below 1e-04: subcycle of order 4 at step .*, ratio 20 .*radau9, which takes 5\.[01] times' "$work/err")" "$work/err"
timeout 120 "$FMDSUB" study --repeats 0 --budget 20 --schemes subcycle,radau9 decks/satellite-instrument.yaml >"$work/rows" 2>"$work/err"
# Trials at 1e-6 do not resolve the carriage on its bearing and promise both runs of the reference to 1e-11 within the budget:
# those are left, and two that get to records are found by what they have cost.
expect "runs dearer than foretold: the reference reaches records" 1 "$(grep -c '^the budget takes it to t = 0\.[2-9]* s of 2: ' "$work/err")" "$work/err"
timeout 120 "$FMDSUB" study -q --repeats 0 --budget 20 --schemes subcycle,radau9 --pick 1e-4 decks/satellite-instrument.yaml >"$work/picked" 2>"$work/err"
expect "order 4: picked" "2 ratio: 20 order: 4" "$(grep -c 'scheme: subcycle\|step: 0.00125' "$work/picked") $(grep -o 'ratio: .*\|order: .*' "$work/picked" | tr '\n' ' ' | sed 's/ $//')" "$work/picked" "$work/err"

# What Newton's method leaves in the stages of order 4 is below what the steps leave, 1e-7.
for left in 0 1.0e-12; do
    "$FMDSUB" run -q --set integrate.order=4 --set integrate.ratio=25 --set integrate.newton_tolerance=$left \
        --columns 't,float.angle,float.angle_rate,ja1.angle,jd1.angle' decks/satellite-instrument.yaml >"$work/left.$left.csv"
done
"$FMDSUB" diff -q --rel 5.0e-8 "$work/left.0.csv" "$work/left.1.0e-12.csv" >"$work/out" 2>"$work/err"
expect "order 4: Newton's method leaves little" "0 wrote" "$? $(wrote "$work/left.0.csv")" "$work/out" "$work/err"

# A small fast arm among large slow ones, which it does not shake: to 1e-4 a seventh of the work of the cheapest other scheme, at the most.
timeout 120 "$FMDSUB" study --repeats 0 --budget 10 --schemes subcycle,dop853,dopri5 --steps 1.6666666666666667e-5 --ratios 300 tests/bench/small-fast.yaml >"$work/rows" 2>"$work/err"
awk -F, '$16 == "ok" && $5 <= 1.1e-4 { if ($19 == 4 && (!two || $9 < two)) two = $9; else if ($1 != "subcycle" && (!one || $9 < one)) one = $9 }
    END { print two, one; exit !(two > 0 && one >= 7 * two) }' "$work/rows" >"$work/line"
expect "order 4 at 1e-4 beside what it does not shake: a seventh of the work" 0 $? "$work/line" "$work/err"
