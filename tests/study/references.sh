# references.sh -- references of a study: two that agree, at instants in common; where they part.
. tests/tools/lib.sh

# Two references, by different schemes, agree on every shipped deck that is studied.
for deck in bar-slider double-pendulum stiff-leaf-chain heavy-top; do
    "$FMDSUB" study --schemes newmark --steps 1.0e-3 --repeats 1 --set integrate.ratio=1 --until 0.5 decks/$deck.yaml \
        >"$work/table" 2>"$work/err"
    awk '/^reference:/ { for (i = 1; i <= NF; i++) if ($i == "by") d = $(i + 1) } END { exit !(d + 0 < 1e-6 && d != "") }' "$work/err"
    if [ $? = 0 ]; then ok "$deck: references agree"; else not_ok "$deck: references agree" "no, or not told" "$work/err"; fi
done

# Records of a run and of the reference are compared at the instants that they have in common, whatever the deck says of
# records: nothing, every third step, or a time.  Errors fall with h^2 then, and agree.
errors_of() { # SETTINGS...
    "$FMDSUB" study -q --schemes midpoint --steps 2.0e-3,1.0e-3,5.0e-4 --repeats 1 --until 1.2 "$@" "$work/bare.yaml" 2>"$work/err" |
        awk -F, 'NR > 1 { printf "%s ", $5 }'
}
sed '/^output:/,$d' decks/double-pendulum.yaml >"$work/bare.yaml"
errors_of >"$work/none"
errors_of --set 'output.every={steps: 3}' >"$work/steps"
errors_of --set output.every=0.012 >"$work/time"
cat "$work/none" "$work/steps" "$work/time" | tr ' ' '\n' | awk '
    NF { e[++n] = $1 }
    END {
        for (i = 1; i <= 9; i += 3) if (!(e[i] / e[i + 1] > 3.6 && e[i] / e[i + 1] < 4.4 && e[i + 1] / e[i + 2] > 3.6 && e[i + 1] / e[i + 2] < 4.4)) bad = 1
        for (i = 4; i <= 9; i++) if (!(e[i] / e[(i - 1) % 3 + 1] > .9 && e[i] / e[(i - 1) % 3 + 1] < 1.1)) bad = 1
        printf "%d errors, the first %s %s %s\n", n, e[1], e[4], e[7]
        exit n != 9 || bad
    }' >"$work/line"
if [ $? = 0 ]; then ok "instants in common: $(cat "$work/line")"; else
    not_ok "instants in common" "$(cat "$work/line")" "$work/err" "$work/none" "$work/steps" "$work/time"; fi

# Chaos: the references part, errors are taken up to there, and it is told; far beyond, nothing is left to compare.
sed 's/^gravity:.*/gravity: [0, -981]/' decks/double-pendulum.yaml >"$work/wild.yaml"
chaos() { "$FMDSUB" study --schemes midpoint --steps 1.0e-4 --repeats 1 --set output.every=0.1 --until "$1" "$work/wild.yaml"; }
chaos 12 >"$work/out" 2>"$work/err"
rc=$?
expect "chaos: the horizon is told" "0 1" "$rc $(grep -c '^they part after t = ' "$work/err")" "$work/err"
awk -F, 'NR == 2 { e = $5 } END { exit !(e > 0 && e < 10) }' "$work/out"
expect "chaos: errors up to there" 0 $? "$work/out" "$work/err"

# What stands still: round-off is not chaos.
"$FMDSUB" study -q --repeats 0 --schemes midpoint,radau9 --set 'initial={static: true}' --until 0.04 decks/cantilever.yaml >"$work/rest.csv" 2>"$work/err"
expect "at rest: status, errors" "0 0" "$? $(awk -F, 'NR > 1 { n++; if (!($5 < 1e-6)) bad++ } END { print bad + !n }' "$work/rest.csv")" "$work/rest.csv" "$work/err"
expect "at rest: a tolerance that changes nothing has no row" 1 "$(grep -c '^radau9' "$work/rest.csv")" "$work/rest.csv"

# Nor is that of what friction holds and lets go: all of the run is compared.
"$FMDSUB" study --repeats 0 --tolerances 1e-3,1e-5 decks/effect-friction.yaml >"$work/rows" 2>"$work/err"
expect "let go by friction: status, compared to the end" "0 0 wrote" "$? $(grep -c '^they part\|^the budget takes' "$work/err") $(wrote "$work/rows")" "$work/err"
expect "let go by friction: errors" "0" \
    "$(awk -F, 'NR > 1 && $2 > 0 { n++; if (!($5 < $2 && $8 < 10 * $2)) bad++ } END { print bad + (n != 2) }' "$work/rows")" "$work/rows"
