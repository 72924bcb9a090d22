# part-order.sh -- every integrator shows its order on the shipped decks and on those of tests/decks.
#
# tests/decks/order.txt, one case a line:
#
#     deck scheme ratio order h until halvings least columns...
#
# Options may stand behind the scheme: generalized-alpha,rho_infinity=0.8.
# The deck runs to `until` with minor steps h, h/2, h/4, ... (at most `halvings` times) until the error is
# `least` or less, which it must become; TIGHT=1 goes on to a hundredth of it, for open mechanisms.  The error of the named
# columns is taken against tests/refdata where the deck has a reference, else against dopri5 at tolerance
# 1e-13.  The slope over the last three halvings must lie within 0.1 of the order (0.2 from order 3 on).
# Newton iterates to 1e-13.  For dopri5, dop853, radau5, radau9 and bdf h is the tolerance and divided by 10; only `least` counts.
. tests/tools/lib.sh
need_program order

deck_of() { if [ -f "decks/$1.yaml" ]; then echo "decks/$1.yaml"; else echo "tests/decks/$1.yaml"; fi; }

error_of() { # RUN DECK UNTIL COLUMNS
    if [ -f "tests/refdata/$2.csv" ]; then
        map=
        [ -f "tests/refdata/$2.map" ] && map="--map tests/refdata/$2.map"
        "$COMPARE" --reference $map --until "$3" --columns "$4" "tests/refdata/$2.csv" "$1"
    else
        [ -f "$work/$2.tight" ] || "$FMDSUB" run -q --set integrate.scheme=dopri5 --set integrate.tolerance=1.0e-13 \
            --until "$3" "$(deck_of "$2")" >"$work/$2.tight" || return 1
        "$COMPARE" --reference --until "$3" --columns "$4" "$work/$2.tight" "$1"
    fi
}

# One case: the table of step and error in $work/table.
run_case() { # DECK SCHEME RATIO H UNTIL HALVINGS LEAST COLUMNS
    : >"$work/table"
    options=$(echo "$2" | tr , '\n' | sed '1s/.*/--set integrate.scheme=&/; 2,$s/^/--set integrate./')
    i=0
    while [ "$i" -le "$6" ]; do
        case $2 in
        dopri5 | dop853 | radau5 | radau9 | bdf) h=$(awk -v h="$4" -v i="$i" 'BEGIN { printf "%.17e", h / 10 ^ i }') set_step="--set integrate.tolerance=$h" ;;
        rk4) h=$(awk -v h="$4" -v i="$i" 'BEGIN { printf "%.17e", h / 2 ^ i }') set_step="--set integrate.step=$h" ;;
        *) h=$(awk -v h="$4" -v i="$i" 'BEGIN { printf "%.17e", h / 2 ^ i }')
            set_step="--set integrate.step=$h --set integrate.newton_tolerance=1.0e-13" ;;
        esac
        "$FMDSUB" run -q $options --set integrate.ratio="$3" $set_step --until "$5" \
            "$(deck_of "$1")" >"$work/run.csv" 2>"$work/err" || return 1
        e=$(error_of "$work/run.csv" "$1" "$5" "$8" 2>"$work/err") || return 1
        echo "$h $e" >>"$work/table"
        awk -v e="$e" -v least="$7" -v i="$i" 'BEGIN { exit !(e + 0 <= least + 0 && i >= 3) }' && break
        i=$((i + 1))
    done
}

judge() { # ORDER LEAST SCHEME
    awk -v order="$1" -v least="$2" -v scheme="$3" '
        { h[NR] = $1; e[NR] = $2 + 0; if ($2 !~ /^[0-9.e+-]+$/) bad = "an error is not a number" }
        END {
            band = order > 2 ? .2 : .1
            if (scheme !~ /^(dop|radau|bdf)/) {
                slope = log(e[NR - 3] / e[NR]) / log(h[NR - 3] / h[NR])
                said = sprintf("slope %.3f, ", slope)
                if (!(slope > order - band && slope < order + band)) bad = "order"
            }
            said = said sprintf("error %.2e", e[NR])
            if (!(e[NR] <= least)) bad = bad " error above " least
            print said (bad ? "  <- " bad : "")
            exit bad != ""
        }' "$work/table" >"$work/said"
}

cases() { if [ "${TIGHT:-}" = 1 ]; then sed '/^# closed loops/,$d' tests/decks/order.txt; else cat tests/decks/order.txt; fi; }
cases | grep -v '^#' | while read -r deck scheme ratio order h until halvings least columns; do
    [ -n "$deck" ] || continue
    name="$deck $scheme n=$ratio"
    [ "$scheme" != bdf ] || has_scheme bdf || { skip "$name" "this build has not found CVODE (Debian: libsundials-dev)"; continue; }
    if [ "${TIGHT:-}" = 1 ]; then
        case $scheme in dop* | radau* | bdf) continue ;; esac
        least=$(awk -v x="$least" 'BEGIN { print x / 100 }') halvings=$((halvings + 4))
    fi
    if ! run_case "$deck" "$scheme" "$ratio" "$h" "$until" "$halvings" "$least" "$columns"; then
        not_ok "$name" "a run failed" "$work/err" "$work/table"
    elif judge "$order" "$least" "$scheme"; then
        ok "$name ($(cat "$work/said"))"
    else
        not_ok "$name" "order $order wanted: $(cat "$work/said")" "$work/table"
    fi
done
