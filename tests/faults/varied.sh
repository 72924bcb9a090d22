# varied.sh -- decks with one number, word or line of theirs changed, each in turn: a number is 0, negative, half as large again; a
# word lacks its last letter; a line is left out.  What check says of all of them is what it was, by sums.
. tests/tools/lib.sh
. tests/tools/sums.sh
mkdir "$work/v"
vary() { # DECK: its variants, as files in $work/v
    awk -v to="$work/v/" '
        function put(what,    file, k) {
            file = to sprintf("%04d", ++made) ".yaml"
            for (k = 1; k <= n; k++) if (k != at) print line[k] >file; else if (what != "\n") print what >file
            close(file)
        }
        /^ *#/ || /^title:/ { next }
        { line[++n] = $0 }
        END {
            for (at = 1; at <= n; at++) {
                if (at > 1) put("\n")
                rest = line[at]; head = ""
                while (match(rest, /[A-Za-z_]*[0-9]+[.]?[0-9]*(e[-+]?[0-9]+)?|[a-z_][a-z_][a-z_]+/)) {
                    word = substr(rest, RSTART, RLENGTH)
                    head = head substr(rest, 1, RSTART - 1)
                    rest = substr(rest, RSTART + RLENGTH)
                    if (word ~ /^[0-9]/) {
                        put(head "0" rest)
                        put(head "-" word rest)
                        put(head word * 1.5 rest)
                    } else if (word ~ /^[a-z_]+$/) put(head substr(word, 1, length(word) - 1) rest)
                    head = head word
                }
            }
        }' "$1"
}
for deck in tests/hard/units/touch.yaml tests/hard/units/drive.yaml tests/hard/units/spatial.yaml tests/hard/units/loop.yaml decks/gear-train.yaml \
    decks/spin-up-segments.yaml decks/bar-slider.yaml tests/decks/signals.yaml tests/pictures/things.yaml \
    tests/pictures/balls.yaml tests/pictures/space.yaml decks/suspension.yaml decks/bearing.yaml decks/cardan.yaml decks/governor.yaml \
    decks/quick-return.yaml decks/screw-actuator.yaml decks/driven-telescope.yaml decks/flexible-robot.yaml decks/rotor.yaml \
    tests/effects/flat-bent.yaml tests/effects/flat-wound.yaml tests/effects/flat-loops.yaml tests/decks/driven-coupling.yaml \
    tests/decks/audit-free-bushings.yaml; do
    rm -f "$work"/v/*
    vary "$deck"
    (
        cd "$work/v" || exit
        for variant in *; do
            "$FMDSUB" check --no-trial "$variant" 2>&1 </dev/null
            echo "status $?"
        done
    ) >"$work/texts/$(basename "$deck" .yaml)"
done
sums_judge tests/said/varied.txt
