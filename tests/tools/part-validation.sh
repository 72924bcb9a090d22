# part-validation.sh -- published figures of other programs (tests/validation/README): every one is met, and ours do not depend
# on the scheme.
. tests/tools/lib.sh
need_program validation

sh tests/validation/table.sh >"$work/table" 2>"$work/err"
sh tests/validation/table.sh -s integrate.scheme=rk4 -s integrate.step=2.5e-4 >"$work/rk4" 2>>"$work/err"
for deck in tests/validation/*.yaml; do
    name=${deck##*/}
    name=${name%.yaml}
    grep "^$name " "$work/table" >"$work/figures"
    grep 'beyond$' "$work/figures" >"$work/beyond"
    expect "$name: $(grep -c '^#=' "$deck") figures" "$(grep -c '^#=' "$deck") 0" \
        "$(wc -l <"$work/figures") $(wc -l <"$work/beyond")" "$work/beyond" "$work/err"

    # Columns 5 and 7: ours and the limit.
    grep "^$name " "$work/rk4" | paste -d' ' "$work/figures" - | awk '
        { n++; move = ($5 - $(NF / 2 + 5)) / $7; if (move < 0) move = -move; if ($5 == "-" || !(move <= 1 / 3)) { bad = 1; print } }
        END { exit bad || !n }' >"$work/moved"
    expect "$name by rk4: the same to a third of the limits" 0 $? "$work/moved" "$work/err"
done
