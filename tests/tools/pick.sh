# pick.sh -- does a run by `study --pick` cost what the best of the grid costs?
#
#     BUILD=build sh tests/tools/pick.sh [DECK ...]               default: the decks below
#
# For each error: the cheapest row of the study's table that meets it, by work; the setting that --pick prints, and what a run of
# the deck with it takes: the work of its row, times what the run sweeps more than that row did.  Fails above 1.2 of the best, and
# where fewer than five decks are judged.
. tests/tools/lib.sh
[ $# -gt 0 ] || set -- decks/pendulum.yaml decks/four-bar.yaml decks/stiff-leaf-chain.yaml decks/bar-slider.yaml decks/andrews.yaml decks/chain.yaml decks/spring-pendulum.yaml

value() { awk -v key="$1" '$1 == key ":" || $1 == key { print $2; exit }' "$2"; }

printf '%-18s %-6s %-34s %10s %10s %8s\n' deck error picked work best quotient
for deck in "$@"; do
    name=$(basename "$deck" .yaml)
    "$FMDSUB" study -q --repeats 0 -f csv "$deck" >"$work/grid.csv" 2>"$work/err" || { echo "$name: the study fails: $(tail -n 1 "$work/err")"; continue; }
    for error in 1e-2 1e-4 1e-6; do
        "$FMDSUB" study -q --repeats 0 --pick $error "$deck" >"$work/pick" 2>"$work/err" || { echo "$name $error: nothing is picked: $(tail -n 1 "$work/err")"; continue; }
        scheme=$(value scheme "$work/pick") tolerance=$(value tolerance "$work/pick") step=$(value step "$work/pick") ratio=$(value ratio "$work/pick")
        set_ratio=${ratio:+--set integrate.ratio=$ratio}
        "$FMDSUB" run -q --stats="$work/stats" --set integrate.scheme="$scheme" ${tolerance:+--set integrate.tolerance="$tolerance"} \
            ${step:+--set integrate.step="$step"} $set_ratio "$deck" >"$work/run" 2>"$work/err" || { echo "$name $error: its run fails: $(tail -n 1 "$work/err")"; continue; }
        awk -F, -v name="$name" -v error=$error -v scheme="$scheme" -v tolerance="$tolerance" -v step="$step" -v ratio="${ratio:-1}" \
            -v slow="$(value slow_evaluations "$work/stats")" -v fast="$(value fast_evaluations "$work/stats")" '
            function near(a, b) { return a == "" || b == "" ? a b == "" : (a - b) ^ 2 <= 1e-6 * b * b }
            NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
            $at["status"] != "ok" || $at["error"] == "" { next }
            $at["error"] + 0 <= error + 0 && (best == "" || $at["work"] + 0 < best) { best = $at["work"] + 0 }
            $at["scheme"] == scheme && (tolerance != "" ? near($at["tolerance"], tolerance) : near($at["step"], step) && $at["ratio"] == ratio) {
                row = $at["work"] + 0; more = (slow + fast) / ($at["slow"] + $at["fast"]) }
            END { if (row == "" || best == "") { printf "%-18s %-6s no row of %s\n", name, error, scheme; exit }
                  printf "%-18s %-6s %-34s %10.4g %10.4g %8.3f\n", name, error,
                      scheme (tolerance != "" ? " tolerance " tolerance : " step " step " ratio " ratio), row * more, best, row * more / best }' "$work/grid.csv"
    done
done | tee "$work/table"
awk '/fails|picked:|no row/ { other++; next } { n++; decks[$1] = 1; if ($NF > most) most = $NF; if ($NF > 1.2) bad++ }
     END { for (d in decks) judged++
           printf "%d picks on %d decks, at most %.3f times the best; %d above 1.2, %d not judged\n", n, judged, most, bad, other
           exit bad > 0 || judged < 5 }' "$work/table"
