# restart.sh -- a run and its continuation from --final-state are one run, byte for byte, under every deck and scheme.
#
# Every shipped deck over a quarter of MAJORS major steps under all schemes but its own (tests/faults/restart.sh).
. tests/tools/lib.sh
. tests/tools/restarted.sh

decks=0
for deck in *.yaml; do
    name=${deck%.yaml}
    wanted "$name" || continue
    set -- $(plan $deck)
    [ $# = 3 ] || continue
    H=$(awk "BEGIN { printf \"%.12g\", $1 * $2 }") own=$3 bad=
    for scheme in midpoint newmark generalized-alpha hht subcycle "subcycle, order: 4" miao daniel rk4; do
        set -- -s integrate.scheme=${scheme%,*}
        [ "$scheme" = "${scheme%,*}" ] || set -- "$@" -s integrate.order=4
        [ $own = 1 ] && set -- -s "integrate={scheme: $scheme, step: $H, until: 1}"
        every="--every-steps 1"
        why=$(one_run $deck $((MAJORS / 4)) "$@")
        case $why in skipped*) ;; ?*) bad="$bad; $scheme: $why" ;; esac
    done
    every="--every $H"
    for scheme in dopri5 dop853 radau5 radau9; do
        tolerance=1.0e-6
        [ $scheme = dopri5 ] && tolerance=9.0e-7 # from 1e-6 on its steps run over records, and the end of a run is a cut
        why=$(one_run $deck 4 -s "integrate={scheme: $scheme, tolerance: $tolerance, until: 1}")
        case $why in skipped*) ;; ?*) bad="$bad; $scheme: $why" ;; esac
    done
    [ -z "$bad" ] && ok "restart under all schemes: $name" && decks=$((decks + 1)) || not_ok "restart under all schemes: $name" "$bad"
done
[ "$D" ] || { [ $decks -ge 70 ] && ok "restart under all schemes: all decks" || not_ok "restart under all schemes: all decks" "only $decks"; }
