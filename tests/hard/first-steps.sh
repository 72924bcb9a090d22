# first-steps.sh -- vibrations far quicker than the step that a deck begins with, stirred up in the first steps; and how fast a
# mechanism moves whose drives alone move fast.
. tests/tools/lib.sh

below() { # NAME MOST NUMBER
    awk -v most="$2" -v x="$3" 'BEGIN { exit !(x ~ /^[0-9.]+(e[-+]?[0-9]+)?$/ && x + 0 > 0 && x + 0 <= most + 0) }' && ok "$1" ||
        not_ok "$1" "'$3' is not a number up to $2"
}
crank() { # SCHEME TOLERANCE FILE: the flexible crank, which starts undeformed; its first step is 1e-5 s, 6 of the highest mode
    "$FMDSUB" run -q --every 0.0005 --set integrate.until=0.005 --set integrate.scheme="$1" --set integrate.tolerance="$2" \
        --stats="$work/stats" decks/flexible-crank.yaml >"$3" 2>"$work/err"
    rc=$?
}
off() { # REFERENCE RUN: slider.vx at the end, over its range
    awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "slider.vx") c = i; next }
        FNR == 1 { next }
        NR == FNR { x = $c; if (FNR == 2 || x < low) low = x; if (FNR == 2 || x > high) high = x; next }
        { y = $c }
        END { d = y - x; if (d < 0) d = -d; print (high > low ? d / (high - low) : "no range") }' "$1" "$2"
}
minors() { awk '$1 == "minor_steps" { print $2 }' "$work/stats"; }

crank radau9 1e-12 "$work/ref"
for scheme in newmark midpoint hht generalized-alpha; do
    crank $scheme 1e-3 "$work/coarse"
    ended "$scheme 1e-3" 0 $rc "$work/coarse" "$work/err"
    below "$scheme 1e-3: drives count for how fast it moves" 7000 "$(minors)"
    crank $scheme 1e-4 "$work/fine"
    ended "$scheme 1e-4" 0 $rc "$work/fine" "$work/err"
    below "$scheme 1e-4: half a tolerance" 0.5e-4 "$(off "$work/ref" "$work/fine")"
    below "$scheme: a tenth of the tolerance, less than a quarter of the error" 0.25 \
        "$(awk -v a="$(off "$work/ref" "$work/fine")" -v b="$(off "$work/ref" "$work/coarse")" 'BEGIN { print a / b }')"
done

# Spun up on a driven shaft: modes of 1000 rad/s are not stirred up to what is seen, nor resolved.
for scheme in newmark midpoint; do
    "$FMDSUB" run -q --every 2 --set integrate.scheme=$scheme --set integrate.tolerance=1e-3 --stats="$work/stats" decks/spin-up.yaml >"$work/out" 2>"$work/err"
    ended "spin-up by $scheme" 0 $? "$work/out" "$work/err"
    below "spin-up by $scheme: steps" 3000 "$(minors)"
done
