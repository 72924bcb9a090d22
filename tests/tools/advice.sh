# advice.sh -- the advice of `fmdsub check` followed: what it promises beside what is found.
#
#     BUILD=build MOST=3e6 LONGEST=150 sh tests/tools/advice.sh [DECK ...]     default: all shipped decks
#
# Each setting is run by `fmdsub study`, against its references at 1e-11; the found error is that of the deck's columns
# over their ranges.  A line each: deck, promised error, scheme, step or tolerance, found error, found over promised.
# Runs that would take more than MOST evaluations are left out, and decks whose study takes more than LONGEST CPU seconds. "chaos" stands where the references part; the errors then are up to there.
# The last line counts what is above 5; exit 1 if anything is.
BUILD=${BUILD:-build} MOST=${MOST:-3e6} LONGEST=${LONGEST:-150}
work=$(mktemp -d "${TMPDIR:-/tmp}/advice.XXXXXX")
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM
[ $# -gt 0 ] || set -- decks/*.yaml

# "error scheme step ratio tolerance" of every entry.
entries() {
    awk -v most="$MOST" '{ gsub(/[",]/, ""); gsub(/null/, "-") }
         $1 == "advice:" { on = 1 }
         on && $1 ~ /^error:/ { e = $2 } on && $1 == "scheme:" { s = $2 } on && $1 == "suggested_step:" { h = $2 }
         on && $1 == "suggested_ratio:" { r = $2 } on && $1 == "tolerance:" { t = $2 }
         on && $1 == "evaluations:" && $2 <= most + 0 { print e, s, h, r, t }
         /]/ { on = 0 }'
}

# Rows of a study of these entries, and what it says, behind those before.
followed() { # ENTRIES DECK
    schemes=$(cut -d' ' -f2 "$1" | awk '!seen[$0]++' | paste -sd, -)
    steps=$(awk '$3 != "-" { print $3 }' "$1" | awk '!seen[$0]++' | paste -sd, -)
    ratio=$(awk '$3 != "-" { print $4; exit }' "$1")
    tolerances=$(awk '$5 != "-" { print $5 }' "$1" | awk '!seen[$0]++' | paste -sd, -)
    (ulimit -t "$LONGEST"; exec "$BUILD/fmdsub" study --repeats 1 --budget none --schemes "$schemes" ${steps:+--steps $steps} ${tolerances:+--tolerances $tolerances} \
        ${ratio:+--ratios $ratio} "$2") >>"$work/table" 2>>"$work/parted"
}

printf '%-22s %-6s %-18s %-12s %-9s %s\n' deck error scheme setting found 'found/promised'
for deck in "$@"; do
    name=$(basename "$deck" .yaml)
    "$BUILD/fmdsub" check -f json "$deck" >"$work/check" 2>"$work/err" || { echo "$name: check fails"; cat "$work/err"; continue; }
    entries <"$work/check" >"$work/entries"
    all=$work/entries rc=0
    : >"$work/table"
    : >"$work/parted"
    awk '$3 != "-"' "$all" >"$work/steps"
    awk '$5 != "-"' "$all" >"$work/tolerances"
    # A scheme by both steps and tolerances has a study for each, for a study of steps leaves the tolerances of theirs out.
    [ -n "$(awk 'NR == FNR { one[$2] = 1; next } $2 in one' "$work/steps" "$work/tolerances")" ] || cat "$all" >"$work/steps"
    for part in "$work/steps" "$work/tolerances"; do
        [ -s "$part" ] || continue
        followed "$part" "$deck" || rc=1
        cmp -s "$part" "$all" && break
    done
    awk -v deck="$name" -v rc=$rc '
        FILENAME == ARGV[1] { if (/part after/) chaos = 1; next }
        FILENAME == ARGV[2] { split($0, c, ","); found[c[1], c[2] == "" ? "step" : "tolerance", c[2] == "" ? c[3] + 0 : c[2] + 0] = c[5]; next }
        { setting = $3 == "-" ? $5 : $3
          key = $3 == "-" ? "tolerance" : "step"
          run = ($2, key, setting + 0) in found
          e = run ? found[$2, key, setting + 0] : 0
          note = rc || !run ? "no reference" : chaos ? "chaos" : ""
          printf "%-22s %-6s %-18s %-12s %-9.2g %.2g %s\n", deck, $1, $2 ($4 > 1 ? " " $4 ":1" : ""), setting, e, e / $1, note; n++ }
        END { if (!n) printf "%-22s no advice\n", deck }' "$work/parted" "$work/table" "$work/entries"
done | tee "$work/all"
awk '/no reference|chaos|no advice/ { other++; next }
     $NF + 0 > 0 { n++; if ($NF > 5) bad++; if ($NF > most) most = $NF; if (!least || $NF < least) least = $NF }
     $NF == 0 { n++ }
     END { printf "%d settings, found over promised from %.2g to %.2g, %d above 5; %d of chaos or without a reference\n", n, least, most, bad, other; exit bad > 0 || n == 0 }' "$work/all"
