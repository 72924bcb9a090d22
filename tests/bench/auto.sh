# auto.sh -- the work of scheme: auto against the cheapest setting of one rate that is as accurate, on every shipped deck, in
# counted evaluations: `sh tests/bench/auto.sh [TOLERANCE [DECK...]]`.  BUDGET (default 8): CPU seconds of a study.  The last two
# columns: the same over the cheapest of one rate by that very tolerance, which is what a deck asks for -- that a looser one
# happens to be as accurate nobody knows beforehand.
. tests/tools/lib.sh
tolerance=${1:-1.0e-4}
[ $# -gt 0 ] && shift
[ $# -gt 0 ] || set -- decks/*.yaml tests/bench/*.yaml
printf '%-22s %-9s %10s %9s   %-9s %8s %9s  %6s   %-9s %6s  %s\n' deck takes error work as_good at work over asked over trials
for deck in "$@"; do
    set_auto="--set integrate.scheme=auto --set integrate.tolerance=$tolerance --set partition=auto"
    name=$(basename "$deck" .yaml)
    # shellcheck disable=SC2086 # several words
    timeout 60 "$FMDSUB" check $set_auto "$deck" >"$work/words" 2>&1
    took=$(sed -n 's/^auto: a relay .*/auto/p; s/^auto: \([a-z0-9]*\).*$/\1/p' "$work/words" | head -n 1)
    trials=$(sed -n 's/^auto: .*\(trial runs\|after a look\) of \([0-9.e+]*\)$/\2/p' "$work/words")
    # shellcheck disable=SC2086
    timeout 300 "$FMDSUB" study --repeats 0 --budget "${BUDGET:-8}" --tolerances "1e-2,1e-3,$tolerance,1e-5,1e-6" $set_auto "$deck" \
        >"$work/rows" 2>"$work/err" || { printf '%-22s %-9s %s\n' "$name" "${took:-refused}" "no reference"; continue; }
    awk -F , -v name="$name" -v took="$took" -v tolerance="$tolerance" -v trials="${trials:--}" '
        NR == 1 || $16 != "ok" || $5 == "" { next }
        $1 == took && $2 + 0 == tolerance + 0 && !seen { seen = 1; error = $5; work = $9; next }
        $1 != "subcycle" && $2 + 0 == tolerance + 0 && (!asked || $9 < least) { asked = $1; least = $9 }
        $1 != "subcycle" { n++; scheme[n] = $1; at[n] = $2; e[n] = $5; w[n] = $9 }
        END {
            if (!seen) { printf "%-22s %-9s %s\n", name, took, "not within the budget"; exit }
            best = work
            for (i = 1; i <= n; i++) if (e[i] <= error && (!pick || w[i] < w[pick])) pick = i
            if (work <= least) asked = took
            if (!asked || work < least) least = work
            printf "%-22s %-9s %10.2g %9d   %-9s %8s %9s  %6s   %-9s %6.2f  %s\n", name, took, error, work,
                pick ? scheme[pick] : "none", pick ? at[pick] + 0 : "-", pick ? w[pick] : "-", pick ? sprintf("%.2f", work / w[pick]) : "-",
                asked, work / least, trials
        }' "$work/rows"
done | tee "$work/table"
awk '$NF != "trials" && NF > 9 { n++; fine += $8 == "-" || $8 <= 1.05; met += $10 <= 1.05 }
    END { printf "%d decks, on %d at most 1.05 of the cheapest of one rate that is as accurate, on %d of the cheapest by that tolerance\n", n, fine, met }' "$work/table"
