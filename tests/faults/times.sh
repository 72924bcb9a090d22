# times.sh -- times are the decimals that the deck means: i/1000 and not i times the double next to a thousandth.
. tests/tools/lib.sh
cd "$work" || exit 1
instants() { # NAME STEPS-A-SECOND MAJOR-STEPS SETTINGS...
    name=$1 per=$2 every=$3
    shift 3
    "$FMDSUB" run -q --until 2 --every-steps 1 --columns pin.angle "$@" "$ROOT/decks/pendulum.yaml" 2>err |
        awk -F, -v per=$per -v every=$every 'NR > 1 { want = sprintf("%.15g", (NR - 2) * every / per); if ($1 "" != want "") { print $1 ", not " want; bad = 1 } }
            END { exit bad || NR != 2 + 2 * per / every }' >out && ok "$name" || not_ok "$name" "times:" out
}
instants "steps of a thousandth" 1000 1 -s integrate.step=1.0e-3
instants "steps of a thousandth, every tenth" 1000 10 -s integrate.step=1.0e-3 -s integrate.ratio=10
instants "steps of 0.4 ms" 2500 1 -s integrate.step=4.0e-4
instants "a step that is computed" 1000 1 -s integrate.step=0.1/100
instants "steps of their own" 1000 1 -s 'integrate={scheme: dopri5, tolerance: 1.0e-3, until: 2}' -s output.every=1.0e-3
