# part-study.sh -- statements about accuracy and cost, shown by `fmdsub study` itself.
. tests/tools/lib.sh
need_program study

# The chain with stiff leaf joints, plucked: the fast coordinates of `subcycle` at n = 5, 10, 20 are as near to
# the reference as those of the single rate at the small step, within 1.5 times; slow ones and `miao` beside it.
"$FMDSUB" study -q --schemes midpoint,subcycle,miao --ratios 5,10,20 --steps 1.0e-4 --repeats 1 \
    decks/stiff-leaf-chain.yaml >"$work/chain.csv" 2>"$work/err"
for n in 5 10 20; do
    awk -F, -v n=$n '
        $1 == "midpoint" { fast = $4; slow = $5 }
        $1 == "subcycle" && $2 == n { f = $4; s = $5; state = $12 }
        $1 == "miao" && $2 == n { mf = $4; ms = $5; mstate = $12 }
        END {
            printf "fast error %.3g against %.3g (%.2f), slow %.3g against %.3g; miao fast %.3g, slow %.3g (%s)\n",
                f, fast, f / fast, s, slow, mf, ms, mstate
            exit !(fast > 0 && f <= 1.5 * fast && state == "ok")
        }' "$work/chain.csv" >"$work/line"
    if [ $? = 0 ]; then ok "stiff-leaf-chain n=$n: $(cat "$work/line")"; else
        not_ok "stiff-leaf-chain n=$n" "$(cat "$work/line")" "$work/err"; fi
done

# Two references, by different schemes, agree on every shipped deck that is studied.
for deck in bar-slider double-pendulum stiff-leaf-chain heavy-top; do
    "$FMDSUB" study --schemes newmark --steps 1.0e-3 --repeats 1 --set integrate.ratio=1 --until 0.5 decks/$deck.yaml \
        >"$work/table" 2>"$work/err"
    awk '/^reference:/ { for (i = 1; i <= NF; i++) if ($i == "by") d = $(i + 1) } END { exit !(d + 0 < 1e-6 && d != "") }' "$work/err"
    if [ $? = 0 ]; then ok "$deck: references agree"; else not_ok "$deck: references agree" "no, or not told" "$work/err"; fi
done
