# terminal.sh -- what is said on a terminal: tables that are drawn, colours, progress.
. tests/tools/lib.sh
command -v script >/dev/null || { skip terminal "script is not installed"; exit 0; }
script -qec true /dev/null </dev/null >/dev/null 2>&1 || { skip terminal "there are no pseudo-terminals here (/dev/pts)"; exit 0; }
unset NO_COLOR
on_terminal() { TERM=xterm script -qec "$*" /dev/null </dev/null 2>&1 | tr -d '\r'; }

# A pendulum about the vertical: w = sqrt(g/L), rk4 is stable up to w h = 2 sqrt(2), the others always; steps are tried a
# tenth of a decade or closer together.
on_terminal "$FMDSUB" stability --set initial.pin.angle=pi/2 --schemes rk4,newmark,midpoint decks/pendulum.yaml >"$work/drawn"
awk 'BEGIN { limit = 2 * sqrt(2) / sqrt(9.81) }
    $1 == "rk4" && $2 == 1 { good += $8 > limit && $8 < 1.26 * limit && $9 == "up" && $7 == "pin.angle" && $5 == 0 }
    ($1 == "newmark" || $1 == "midpoint") && $2 == 1 { good += $8 == "none" && $3 > .999999 && $3 < 1.000001 }
    END { exit good != 3 }' "$work/drawn" && ok "stability, drawn: 2 sqrt(2) of rk4" || not_ok "stability, drawn: 2 sqrt(2) of rk4" "got:" "$work/drawn"
"$FMDSUB" stability --set initial.pin.angle=pi/2 --schemes rk4 decks/pendulum.yaml >"$work/table" 2>"$work/err"
awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
    { z = $at["step"] * sqrt(9.81); a = 1 - z^2 / 2 + z^4 / 24; b = z - z^3 / 6; r = sqrt(a * a + b * b); d = $at["radius"] / r - 1; n++
      if (d > 1e-5 || d < -1e-5) bad++ }
    END { exit n < 30 || bad > 0 }' "$work/table" && ok "rk4 grows as its polynomial says" || not_ok "rk4 grows as its polynomial says" "got:" "$work/table"

# The table of a study: as drawn and as CSV the same schemes, settings and errors.
for form in drawn csv; do
    study="$FMDSUB study -q --schemes rk4 --steps 0.02,0.01 --repeats 1 --until 0.2 decks/pendulum.yaml"
    case $form in drawn) on_terminal "$study" ;; csv) $study ;; esac >"$work/$form" 2>"$work/err"
done
awk 'FNR == NR { split($0, w, ","); if (FNR == 1) for (i in w) at[w[i]] = i; else error[w[at["step"]] + 0] = w[at["error"]]; next }
    $1 == "rk4" && $3 + 0 in error { n++; d = $5 / error[$3 + 0]; if (d > 1.06 || d < .94) bad++ }
    END { exit n != 2 || bad > 0 }' "$work/csv" "$work/drawn" && ok "study, drawn: the errors" || not_ok "study, drawn: the errors" "got:" "$work/drawn" "$work/csv"

# Colours on a terminal, not under NO_COLOR, and not elsewhere.
esc=$(printf '\033')
how_said() { if grep -q "$esc\[.*error.*: unknown key" "$work/out"; then echo coloured; elif grep -q ' error: unknown key' "$work/out"; then echo plain; else echo silent; fi; }
for how in "" "NO_COLOR=1" "TERM=dumb"; do
    TERM=xterm script -qec "env $how $FMDSUB check --set bodies.ball.mas=1 decks/pendulum.yaml" /dev/null </dev/null >"$work/out" 2>&1
    got=$(how_said)
    [ -z "$how" ] && want=coloured || want=plain
    expect "on a terminal${how:+, $how}" $want $got "$work/out"
done
for how in "always coloured" "never plain"; do
    "$FMDSUB" check --color ${how% *} --set bodies.ball.mas=1 decks/pendulum.yaml >"$work/out" 2>&1
    expect "--color ${how% *}" "${how#* }" "$(how_said)" "$work/out"
done

# Steps that grow, in the order that they are named in: one alone, from one to another, and up from one on; steps that are too
# coarse to tell have no numbers.
up() { on_terminal "$FMDSUB" stability --set initial.pin.angle=pi/2 --schemes "$1" --steps "$2" decks/pendulum.yaml >"$work/drawn"; }
for steps in '1,0.1,2,3:1, 2 up' '1,2,0.1:1...2' '0.1,0.2:none'; do
    up rk4 "${steps%%:*}"
    expect "stability, drawn: unstable of ${steps%%:*}" 1 "$(grep -c "^rk4 .*  ${steps#*:}\$" "$work/drawn")" "$work/drawn"
done
on_terminal "$FMDSUB" stability --schemes rk4 --steps 1e6 decks/pendulum.yaml >"$work/drawn"
expect "stability, drawn: too coarse to tell" "1 1 0" \
    "$(grep -c '^rk4 *1 *- *- *- *- *- *none$' "$work/drawn") $(grep -c 'the motion itself grows here, ' "$work/drawn") $(grep -c 'least damped' "$work/drawn")" "$work/drawn"

# Progress of a study on a terminal: what is at work, wiped away before lines that stay.
TERM=xterm script -qec "$FMDSUB study --repeats 1 --until 0.1 --schemes rk4 --steps 0.01,0.005 decks/pendulum.yaml" /dev/null </dev/null >"$work/out" 2>&1
for word in 'reference: 0 runs' 'errors: 2 runs' 'times: 2 runs'; do
    expect "progress of a study: $word" 1 "$(grep -c "$esc\[K$word.*$esc\[K" "$work/out" | awk '{ print ($1 > 0) }')" "$work/out"
done
