# tolerance.sh -- is a tolerance met?  Errors of positions and rates at the end, over the column's range, in tolerances.
#
#     BUILD=build LONGEST=60 S=SCHEME sh tests/tools/tolerance.sh [DECK ...]     default: all of the lists below
#
# The limit is 10 times max(1, the run in periods of the fastest motion that is excited), at most 100: periods by the turns of the
# deck's columns in the reference (dop853 or radau9 to 1e-12), of hundredths of a range and more.  A run that takes more than
# LONGEST CPU seconds is shown as such and not judged.
# Shares of the tolerance, h/(t + 10 h), add up as the logarithm of the number of steps does: over ten orbits (orbit-3) newmark is
# 97 tolerances off at 1e-5 in 58000 steps, 104 at 1e-6 and 110 at 1e-7, in 550000, which are not in the list.
. tests/tools/lib.sh
LONGEST=${LONGEST:-60}

# deck, file, reference, settings
cat >"$work/decks" <<'LIST'
pendulum          decks/pendulum.yaml           dop853
bar-slider        decks/bar-slider.yaml         dop853
stiff-leaf-chain  decks/stiff-leaf-chain.yaml   radau9
heavy-top         decks/heavy-top.yaml          dop853  parameters.spin=2000
four-bar          decks/four-bar.yaml           dop853
andrews           decks/andrews.yaml            dop853
flexible-crank    decks/flexible-crank.yaml     radau9
spin-up           decks/spin-up.yaml            radau9
turbine-blade     decks/turbine-blade.yaml      radau9
driven-telescope  decks/driven-telescope.yaml   radau9
airscrew          decks/airscrew/airscrew.yaml  radau9
orbit-3           tests/tolerance/orbit.yaml    dop853  parameters.e=0.3
orbit-6           tests/tolerance/orbit.yaml    dop853
orbit-8           tests/tolerance/orbit.yaml    dop853  parameters.e=0.8
four-bar-10       decks/four-bar.yaml           dop853  integrate.until=10
LIST
cat >"$work/schemes" <<'LIST'
dopri5            1e-3 1e-4 1e-5 1e-6 1e-7 1e-8
dop853            1e-3 1e-5 1e-8
radau5            1e-3 1e-4 1e-5 1e-6 1e-7 1e-8
radau9            1e-3 1e-4 1e-5 1e-6 1e-7 1e-8
newmark           1e-2 1e-3 1e-4 1e-5
midpoint          1e-2 1e-3 1e-4 1e-5
generalized-alpha 1e-2 1e-3 1e-4 1e-5
subcycle          1e-2 1e-3 1e-4 1e-5
bdf               1e-3 1e-4 1e-5 1e-6 1e-7 1e-8
LIST
has_scheme bdf || sed -i '/^bdf/d' "$work/schemes"
[ -z "${S:-}" ] || sed -i "/^$S /!d" "$work/schemes"

# Positions and rates are columns that are no forces, stresses or energies.
motion='^(t|h|sweeps)$|^energy|\.(f[xyz]|m[xyz]|force|moment|torque|power|elongation|axial|bending.*|shear.*|(von_)?mises|elastic|kinetic)$'

run() { # SCHEME TOLERANCE EVERY FILE: $settings, $deck
    (ulimit -t "$LONGEST"; exec "$FMDSUB" run -q --every "$3" --set integrate.scheme="$1" --set integrate.tolerance="$2" $sets "$deck") >"$4" 2>"$work/err"
}

# Periods of the fastest column.
periods() {
    awk -F, -v force="$motion" '
        NR == 1 { for (i = 2; i <= NF; i++) use[i] = $i !~ force; n = NF; next }
        { rows++; for (i = 2; i <= n; i++) { x[rows, i] = $i; if (rows == 1 || $i < low[i]) low[i] = $i; if (rows == 1 || $i > high[i]) high[i] = $i } }
        END { for (i = 2; i <= n; i++) {
                  step = (high[i] - low[i]) / 100; if (!use[i] || !(step > 1e-12)) continue
                  turns = way = 0; at = x[1, i]
                  for (r = 2; r <= rows; r++) {
                      d = x[r, i] - at
                      if (way >= 0 ? d > 0 : d < 0) { at = x[r, i]; if (!way) way = 1 }
                      else if (d > step || d < -step) { if (way) turns++; way = d > 0 ? 1 : -1; at = x[r, i] } }
                  if (turns > most) most = turns }
              printf "%.3g", most / 2 }' "$1"
}

error() { # REFERENCE RUN: "error column"
    awk -F, -v force="$motion" '
        FNR == 1 { file++; if (file == 1) { for (i = 2; i <= NF; i++) { use[i] = $i !~ force; name[i] = $i }; n = NF }; next }
        file == 1 { for (i = 2; i <= n; i++) { if (FNR == 2 || $i < low[i]) low[i] = $i; if (FNR == 2 || $i > high[i]) high[i] = $i }; end = $0; next }
        { last = $0 }
        END { split(end, a, ","); split(last, b, ",")
              if (a[1] + 0 != b[1] + 0) { print "-", "-"; exit }
              for (i = 2; i <= n; i++) { if (!use[i]) continue
                  r = high[i] - low[i]; d = b[i] - a[i]; if (d < 0) d = -d
                  if (!(r > 1e-9)) continue
                  if (d / r >= worst) { worst = d / r; w = name[i] } }
              print worst, w }' "$1" "$2"
}

printf '%-17s %-18s %-6s %9s %7s %9s %8s  %s\n' deck scheme asked found times limit seconds "worst column"
while read -r name deck reference settings; do
    [ $# -eq 0 ] || case " $* " in *" $name "*) ;; *) continue ;; esac
    sets=
    for s in $settings; do sets="$sets --set $s"; done
    until=$("$FMDSUB" run -q -f ndjson --set integrate.scheme=dopri5 --set integrate.tolerance=1e-2 $sets "$deck" 2>/dev/null | awk 'match($0, /"until":[^,]*/) { print substr($0, RSTART + 8, RLENGTH - 8); exit }')
    every=$(awk -v t="$until" 'BEGIN { printf "%.12g", t / 4000 }')
    seldom=$(awk -v t="$until" 'BEGIN { printf "%.12g", t / 10 }')
    LONGEST=120 run $reference 1e-12 "$every" "$work/reference" || { echo "$name: the reference fails: $(tail -n 1 "$work/err")"; continue; }
    n=$(periods "$work/reference")
    while read -r scheme tolerances; do
        for tolerance in $tolerances; do
            start=$(date +%s.%N)
            if run $scheme $tolerance "$seldom" "$work/run"; then found=$(error "$work/reference" "$work/run")
            else found="- -"; fi
            awk -v deck="$name" -v scheme=$scheme -v tol=$tolerance -v found="$found" -v n="$n" -v t0="$start" -v t1="$(date +%s.%N)" -v why="$(tail -n 1 "$work/err" | cut -c1-70)" 'BEGIN {
                split(found, f, " "); limit = 10 * (n > 1 ? n : 1); if (limit > 100) limit = 100
                if (f[1] == "-") { printf "%-17s %-18s %-6s not run: %s\n", deck, scheme, tol, why == "" ? "takes too long" : why; exit }
                printf "%-17s %-18s %-6s %9.2g %7.2g %9.3g %8.2f  %s%s\n", deck, scheme, tol, f[1], f[1] / tol, limit, t1 - t0, f[2], (f[1] / tol > limit ? "  above" : "") }'
        done
    done <"$work/schemes"
done <"$work/decks" | tee "$work/table"
awk '/fails|not run/ { other++; next } { n++; if ($5 > most) most = $5 } /above$/ { bad++ }
     END { printf "%d runs, error in tolerances at most %.3g, %d above the limit; %d not run\n", n, most, bad, other; exit bad > 0 || n == 0 }' "$work/table"
