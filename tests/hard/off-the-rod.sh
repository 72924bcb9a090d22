# off-the-rod.sh -- the slider that turns with its rod has no place to rest beyond Omega = sqrt(k/m) = 14.14 rad/s, which
# it comes near and never reaches, and leaves the rod at a displacement of 1 m: that is told, and the run goes on.
. tests/tools/lib.sh

"$FMDSUB" run -f ndjson --until 3 --set integrate.scheme=rk4 --columns guide.displacement,hub.angle_rate \
    decks/bar-slider.yaml >"$work/out" 2>"$work/err"
ended "off the rod: status" 0 $? "$work/out" "$work/err"
expect "off the rod: told once, when" "warning: t = 2.13 s: guide.displacement is outside its range -1 ... 1: 1.00061" \
    "$(grep 'outside its range' "$work/err")" "$work/err"
expect "off the rod: one event" 1 "$(grep -c '"kind":"range"' "$work/out")" "$work/out"
"$FMDSUB" run -q --until 20 --every 20 --set integrate.scheme=rk4 --columns guide.displacement,hub.angle_rate \
    decks/bar-slider.yaml >"$work/out" 2>"$work/err"
awk -F, 'END { exit !($2 > 10 && $3 > 13 && $3 < sqrt(200)) }' "$work/out" && ok "off the rod: the speed stays below sqrt(k/m)" ||
    not_ok "off the rod: the speed stays below sqrt(k/m)" "last record:" "$work/out"
