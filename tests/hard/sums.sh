# sums.sh -- all columns of every deck in the first hundredth of a second, by their sums: those that no golden record has, too.
. tests/tools/lib.sh
. tests/tools/sums.sh
for deck in decks/*.yaml tests/decks/*.yaml tests/hard/units/*.yaml tests/trust/*.yaml tests/effects/*.yaml tests/pictures/*.yaml; do
    case $deck in */crank-[ct]*) continue ;; esac
    say "$(echo "${deck%.yaml}" | tr / -)" "$FMDSUB" run -q --until 0.01 --every-steps 10 -c '*' "$deck"
done
sums_judge tests/said/columns.txt "" .01
