# modes.sh -- what `fmdsub modes` prints: numbered from 1, slowest first, frequency and angular frequency of one motion, shares
# of the fast coordinates.
. tests/tools/lib.sh
for deck in stiff-leaf-chain chain heavy-top; do
    "$FMDSUB" modes decks/$deck.yaml >"$work/modes" 2>"$work/err"
    awk -F, '
        function size(a) { return a < 0 ? -a : a }
        function off(a, b) { return size(a - b) }
        NR == 1 { last = -1e99; fine = $0 == "mode,frequency,omega,damping,fast,coordinates"; next }
        $1 != NR - 1 || off($3, 6.283185307179586 * $2) > 1e-12 * size($3) || $3 < last || $5 < 0 || $5 > 1 + 1e-12 { fine = 0; print }
        { last = $3 }
        END { exit !(fine && NR > 1) }' "$work/modes" >"$work/wrong"
    expect "modes: $deck" 0 $? "$work/wrong" "$work/err"
done

# Links of a chain that move against each other take and give many times the energy of a mode; their shares stay shares.
"$FMDSUB" modes decks/chain.yaml >"$work/out" 2>"$work/err"
most=$(grep -o '[0-9]*%' "$work/out" | tr -d % | sort -n | tail -n 1)
[ "${most:-999}" -le 100 ] && ok "modes: shares of a chain" || not_ok "modes: shares of a chain" "up to ${most:-?} %" "$work/out"
