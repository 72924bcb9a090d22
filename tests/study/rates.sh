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

# What Newton's method leaves in the stages of order 4 is below what the steps leave, 1e-7.
for left in 0 1.0e-12; do
    "$FMDSUB" run -q --set integrate.order=4 --set integrate.ratio=25 --set integrate.newton_tolerance=$left \
        --columns 't,float.angle,float.angle_rate,ja1.angle,jd1.angle' decks/satellite-instrument.yaml >"$work/left.$left.csv"
done
"$FMDSUB" diff -q --rel 5.0e-8 "$work/left.0.csv" "$work/left.1.0e-12.csv" >"$work/out" 2>"$work/err"
expect "order 4: Newton's method leaves little" "0 wrote" "$? $(wrote "$work/left.0.csv")" "$work/out" "$work/err"
