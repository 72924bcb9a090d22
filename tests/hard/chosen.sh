# chosen.sh -- modes: auto on bodies that are moved in all kinds of ways: what it keeps is what it kept when that was looked at,
# and shows what all modes show, to a hundredth of the range (the tolerance is a thousandth of what is left out in each case).
# WRITE=1 writes what is kept now.
. tests/tools/lib.sh
while read -r name most; do
    sed 's/MODES/auto/' tests/chosen/$name.yaml >"$work/$name.yaml"
    "$FMDSUB" check --no-trial "$work/$name.yaml" 2>"$work/err" | sed -n '/^bodies/,/^mass/p' >"$work/$name.kept"
    [ -z "${WRITE:-}" ] || cp "$work/$name.kept" tests/chosen/
    awk -v apart=1e-9 -f tests/tools/alike.awk tests/chosen/$name.kept "$work/$name.kept" >"$work/differs" && [ -s "$work/$name.kept" ] &&
        ok "modes: auto, $name: as it was" || not_ok "modes: auto, $name: as it was" "differs" "$work/differs" "$work/err"
    # The object has the same modes.
    sed -n 's/^  *\([0-9][0-9.e+-]* Hz .*\)/\1/p' "$work/$name.kept" | sed 's/  */ /g' >"$work/words"
    "$FMDSUB" check --no-trial -f json "$work/$name.yaml" 2>"$work/err" | tr -d '\t' | awk '
        /^"hertz":/ { hertz = substr($0, 9) + 0; share = ""; next }
        /^"(kind|of|by)":/ { split($0, word, "\""); of[word[2]] = word[4] }
        /^"kept":/ { kept = /true/ }
        /^"share":/ { share = substr($0, 9) + 0 }
        /^}/ && hertz {
            printf "%.4g Hz %s %s, ", hertz, of["kind"], kept ? "kept" : "left out"
            print share == "" ? "nothing asks for it" : sprintf("share %.2g of %s by %s", share, of["of"], of["by"])
            hertz = 0
        }' >"$work/object"
    same "modes: auto, $name: words and object" "$work/words" "$work/object"
    "$FMDSUB" run -q "$work/$name.yaml" >"$work/few" 2>"$work/err"
    sed "s/MODES/$most/" tests/chosen/$name.yaml >"$work/all.yaml"
    "$FMDSUB" run -q "$work/all.yaml" >"$work/all" 2>>"$work/err"
    paste -d , "$work/few" "$work/all" | awk -F, '
        NR == 1 { n = NF / 2; next }
        { for (i = 2; i <= n; i++) {
            d = $i - $(i + n); if (d < 0) d = -d
            if (d > most[i]) most[i] = d
            if (NR == 2 || $(i + n) > high[i]) high[i] = $(i + n)
            if (NR == 2 || $(i + n) < low[i]) low[i] = $(i + n) } }
        END { for (i = 2; i <= n; i++) { print i, most[i], high[i] - low[i]; if (!(most[i] <= 0.01 * (high[i] - low[i]))) bad = 1 } exit bad || NR < 15 || n < 2 }' >"$work/apart"
    expect "modes: auto, $name: as with all modes" 0 $? "$work/apart" "$work/err"
done <<'END'
tip 30
swing 27
crank 21
askew 40
rest 40
robot 15
float 40
ball 40
payload 40
rssr 30
sprung 40
hub 40
END
