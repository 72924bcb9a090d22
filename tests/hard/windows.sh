# windows.sh -- IFToMM A02, N four-bar windows that fall flat ten times in ten seconds: the branch, the place, the energy.
#
# The posts stay parallel: phi'' = -3 g (3 N + 1)/(2 (4 N + 1)) sin(phi) from the lowest position, start phi = pi,
# phi' = -1; energies to beat are those of Exudyn, 0.114 J at h = 0.01, 1.14e-3 at 1e-3, 1.8e-5 at 1.25e-4.
. tests/tools/lib.sh

place() { # N: x and y of the first post's top at 10 s
    awk -v N="$1" 'BEGIN {
        k = 3 * 9.81 * (3 * N + 1) / (2 * (4 * N + 1)); p = atan2(0, -1); w = -1; n = 100000; h = 10 / n
        for (i = 0; i < n; i++) {
            a1 = -k * sin(p); p2 = p + h / 2 * w; w2 = w + h / 2 * a1
            a2 = -k * sin(p2); p3 = p + h / 2 * w2; w3 = w + h / 2 * a2
            a3 = -k * sin(p3); p4 = p + h * w3; w4 = w + h * a3; a4 = -k * sin(p4)
            p += h / 6 * (w + 2 * w2 + 2 * w3 + w4); w += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
        }
        printf "%.12g %.12g\n", sin(p), -cos(p)
    }'
}

for N in 1 2 10 40; do
    "$FMDSUB" run -q --set parameters.N=$N --columns "post1.top.x,post1.top.y,beam$N.angle,energy.residual" \
        --every 0.1 decks/windows.yaml >"$work/out" 2>"$work/err"
    ended "$N windows: status" 0 $? "$work/out" "$work/err"
    place $N >"$work/place"
    awk -F, 'function size(x) { return x < 0 ? -x : x }
        NR == FNR { split($0, want, " "); next }
        FNR > 1 { if (size($4) > level) level = size($4); if (size($5) > energy) energy = size($5) }
        END {
            off = size($2 - want[1]) + size($3 - want[2])
            printf "off by %.2g, beams level to %.1g, energy to %.2g J", off, level, energy
            exit !(off < 1e-4 && level < 1e-6 && FNR == 102)
        }' "$work/place" "$work/out" >"$work/line"
    if [ $? = 0 ]; then ok "$N windows at 1e-3: $(cat "$work/line")"; else not_ok "$N windows" "$(cat "$work/line")" "$work/err"; fi
done

for case in "0.01 0.114" "1.0e-3 1.14e-3" "1.25e-4 1.8e-5"; do
    set -- $case
    "$FMDSUB" run -q --set integrate.step=$1 --every 0.05 --columns post1.top.x,post1.top.y,energy.residual decks/windows.yaml \
        >"$work/out" 2>"$work/err"
    awk -F, -v most="$2" -v h="$1" 'function size(x) { return x < 0 ? -x : x }
        NR > 1 && size($4) > energy { energy = size($4) }
        END {
            off = size($2 - 0.3284581115) + size($3 - 0.9445185382)
            printf "energy to %.2g J, off by %.2g", energy, off
            exit !(NR > 2 && energy <= most && (h != 1.25e-4 || off < 1e-5))
        }' "$work/out" >"$work/line"
    if [ $? = 0 ]; then ok "2 windows at $1: $(cat "$work/line")"; else not_ok "2 windows at $1" "$(cat "$work/line"), allowed $2 J" "$work/err"; fi
done
