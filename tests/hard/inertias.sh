# inertias.sh -- which tensors a body can have: thin rods in all octants just can, with a product of the other sign or larger
# none can; a plate can, a plate with a trace more in its normal can not.
. tests/tools/lib.sh
while IFS=: read -r status what tensor; do
    "$FMDSUB" check --no-trial --set "bodies.top.inertia=[$tensor]" decks/heavy-top.yaml >"$work/out" 2>"$work/err"
    expect "inertia of $what" "$status $((status == 0)) $((status != 0))" "$? $(grep -c '^mass:' "$work/out") $(grep -c 'E-inertia' "$work/err")" "$work/err"
done <<'LIST'
0:a rod along (1, 2, 2):8/9, 5/9, 5/9, -2/9, -2/9, -4/9
0:a rod along (-1, 2, 2):8/9, 5/9, 5/9, 2/9, 2/9, -4/9
0:a rod along (1, -2, 2):8/9, 5/9, 5/9, 2/9, -2/9, 4/9
0:a rod along (1, 2, -2):8/9, 5/9, 5/9, -2/9, 2/9, 4/9
3:a rod, xy of the other sign:8/9, 5/9, 5/9, 2/9, -2/9, -4/9
3:a rod, xz of the other sign:8/9, 5/9, 5/9, -2/9, 2/9, -4/9
3:a rod, yz of the other sign:8/9, 5/9, 5/9, -2/9, -2/9, 4/9
3:a rod, all of the other sign:8/9, 5/9, 5/9, 2/9, 2/9, 4/9
3:a rod, xy larger:8/9, 5/9, 5/9, -2.001/9, -2/9, -4/9
3:a rod, xz larger:8/9, 5/9, 5/9, -2/9, -2.001/9, -4/9
3:a rod, yz larger:8/9, 5/9, 5/9, -2/9, -2/9, -4.001/9
3:a rod, yz smaller:8/9, 5/9, 5/9, -2/9, -2/9, -3.999/9
0:a rod along x:0, 1, 1
3:a rod along x, but yy:0, 1, 1.001
0:a plate across x:3, 1, 2
3:a plate across x, and more:3.001, 1, 2
3:a plate across y, and more:1, 3.001, 2
3:a plate across z, and more:1, 2, 3.001
0:a plate across z, askew:1, 2, 3, 0.5, 0, 0
3:a plate across z, askew too far:1, 2, 3, 1.42, 0, 0
0:a cloud of eight:6, 5, 4, -1, 0.5, 0.25
3:less than nothing:-1, 1, 1
LIST
