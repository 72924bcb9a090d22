# part-airscrew.sh -- the numbers of decks/airscrew/README are those that the program gives, and near to what others find:
# closed forms, CalculiX on the whole mesh, a fine single-rate run.
. tests/tools/lib.sh
need_program airscrew
decks=decks/airscrew
readme=$decks/README

# What stands behind LABEL at the start of a line of the README.
row() { awk -v label="$1" 'index($0, label) == 1 { print substr($0, length(label) + 1); exit }' "$readme"; }

# printed NAME WORDS VALUES [SHARE]: each value rounds to the word printed; with SHARE it is that near to it.
printed() {
    echo "$2" | awk -v values="$3" -v share="${4:-0}" '
        {
            n = split(values, v, " ")
            if (NF != n || n == 0) { printf "%d printed, %d found: %s", NF, n, values; exit 1 }
            for (i = 1; i <= n; i++) {
                places = $i ~ /\./ ? length($i) - index($i, ".") : 0
                if (v[i] !~ /^[-+]?[0-9]/) { printf "%s is printed, %s found", $i, v[i]; exit 1 }
                off = v[i] - $i; if (off < 0) off = -off
                size = $i < 0 ? -$i : $i
                if (off > 0.505 * 10^-places && off > share * size) { printf "%s is printed, %s found", $i, v[i]; exit 1 }
            }
        }' >"$work/line"
    if [ $? = 0 ]; then ok "$1"; else not_ok "$1" "$(cat "$work/line")"; fi
}

# within NAME VALUES WANTED SHARE
within() {
    echo "$2" | awk -v wanted="$3" -v share="$4" '
        {
            n = split(wanted, w, " ")
            if (NF != n || n == 0) { printf "%d values for %d", NF, n; exit 1 }
            for (i = 1; i <= n; i++) {
                off = $i / w[i] - 1; if (off < 0) off = -off
                if (!(off <= share)) { printf "%s, expected %s to %g", $i, w[i], share; exit 1 }
            }
        }' >"$work/line"
    if [ $? = 0 ]; then ok "$1"; else not_ok "$1" "$(cat "$work/line")"; fi
}

# pick FILE EXPRESSION: of a table of records, with `least`, `most`, `last`, `first` of NAME after time FROM and a scale.
pick() { # FILE WHAT NAME SCALE [FROM]
    awk -F, -v what="$2" -v name="$3" -v scale="$4" -v from="${5:-0}" '
        NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) k = i; next }
        !k { exit }
        $1 < from - 1e-9 { next }
        {
            x = $k * scale
            if (!seen++) first = least = most = x
            if (x < least) least = x
            if (x > most) most = x
        }
        END {
            if (!k) exit
            printf "%.9g ", what == "first" ? first : what == "least" ? least : what == "most" ? most : x
        }' "$1"
}

# ---- run-up ----

columns='shaft.angle,shaft.angle_rate,blade1.front.xx,blade1.back.xx,blade1.tip.dy,blade1.tip.dz,energy.elastic'
for deck in airscrew airscrew-driven; do
    "$FMDSUB" run -q --every 1.0e-3 --columns "$columns,*.force" $decks/$deck.yaml >"$work/$deck.csv" 2>"$work/err" ||
        not_ok "$deck" "does not run" "$work/err"
done
both() { # WHAT NAME SCALE [FROM]
    for deck in airscrew airscrew-driven; do pick "$work/$deck.csv" "$@"; done
}
printed "run-up: angle" "$(row 'angle at 0.15 s [rad]')" "$(both last shaft.angle 1)"
printed "run-up: speed" "$(row 'speed at 0.15 s [rad/s]')" "$(both last shaft.angle_rate 1)"
printed "run-up: torque" "$(row 'largest torque [N m]')" \
    "$(pick "$work/airscrew.csv" most motor.force 1; pick "$work/airscrew-driven.csv" most spin.force 1)"
printed "run-up: tip forward" "$(row 'tip forward (z), largest [mm]')" "$(both most blade1.tip.dz 1000)"
printed "run-up: tip behind" "$(row 'tip behind (y), largest [mm]')" "$(both most blade1.tip.dy -1000)"
printed "run-up: front" "$(row 'front of the root, lowest xx [MPa]')" "$(both least blade1.front.xx 1e-6)"
printed "run-up: back" "$(row 'back of the root, largest xx [MPa]')" "$(both most blade1.back.xx 1e-6)"
printed "after: lowest" "$(row 'front after 0.1 s, lowest xx [MPa]')" "$(both least blade1.front.xx 1e-6 0.1)"
printed "after: largest" "$(row 'front after 0.1 s, largest xx [MPa]')" "$(both most blade1.front.xx 1e-6 0.1)"

# ---- schemes ----

scheme() { # SCHEME RATIO STEP
    "$FMDSUB" run -q --every 1.0e-3 --columns "$columns" -s integrate.scheme="$1" -s integrate.ratio="$2" \
        -s integrate.step="$3" --stats="$work/stats" $decks/airscrew.yaml >"$work/run.csv" 2>"$work/err"
}
scheme newmark 1 2.0e-6
mv "$work/run.csv" "$work/fine.csv"

# Largest differences of columns from the fine run, in parts of the largest value [1e-6].
errors() {
    paste -d, "$work/fine.csv" "$work/run.csv" | awk -F, '
        NR == 1 { n = NF / 2; next }
        {
            for (i = 1; i <= n; i++) {
                size = $i < 0 ? -$i : $i
                off = $i - $(i + n); if (off < 0) off = -off
                if (size > most[i]) most[i] = size
                if (off > worst[i]) worst[i] = off
            }
        }
        END { printf "%.4g %.4g %.4g %.4g", e(2), e(3), e(4), e(7) }
        function e(i) { return 1e6 * worst[i] / most[i] }'
}
while read -r name ratio step micro limit; do
    scheme "$name" "$ratio" "$step"
    said=$(awk -v s="$name" -v n="$ratio" -v h="$micro" '$1 == s && $2 == n && $3 == h' "$readme")
    found=$(errors)
    printed "$name n=$ratio h=$micro us: errors" "$(echo "$said" | awk '{ print $4, $5, $6, $7 }')" "$found" 0.5
    within "$name n=$ratio h=$micro us: evaluations" \
        "$(awk '$1 == "slow_evaluations" || $1 == "fast_evaluations" { printf "%s ", $2 }' "$work/stats")" \
        "$(echo "$said" | awk '{ print $8, $9 }')" 0.1
    echo "$found" | awk -v limit="$limit" '{ exit !($1 < limit && $2 < limit && $3 < limit && $4 < limit) }' &&
        awk '$1 == "energy_share" { exit !($2 < 1e-6) }' "$work/stats"
    expect "$name n=$ratio h=$micro us: angle, speed, stress to ${limit}e-6, energy to 1e-6" 0 $? "$work/stats"
done <<'E2'
newmark 1 2.0e-5 20 2
midpoint 1 2.0e-5 20 2
subcycle 5 2.0e-5 20 10
subcycle 10 2.0e-5 20 50
newmark 1 1.0e-4 100 30
E2
for ratio in 5 10; do
    scheme miao $ratio 2.0e-5
    rc=$?
    [ $rc = 1 ] || [ $rc = 5 ] # broken balance, or stopped
    expect "miao n=$ratio is unstable" 0 $? "$work/err"
done

# ---- at speed ----

"$FMDSUB" run -q --columns 'b*.front.*,blade.tip.dx,bar.tip.dx,root?.fx' $decks/airscrew-steady.yaml >"$work/steady.csv" 2>"$work/err"
steady() { pick "$work/steady.csv" first "$@"; }
pull="$(steady root1.fx -925.925926e-6) $(steady root2.fx 925.925926e-6)" # [N] over 1080 mm2 in MPa
said="$(row 'front of the root, xx [MPa]')"
printed "at speed: front" "$(echo "$said" | awk '{ print $3 }')" "$(steady blade.front.xx 1e-6)"
within "at speed: front against CalculiX, linear and not" "$(echo "$said" | awk '{ print $1, $2 }')" \
    "$(steady blade.front.xx 1e-6) $(steady blade.front.xx 1e-6)" 2e-3
within "at speed: tensor against CalculiX, linear" \
    "$(for k in xx yy zz xy xz yz; do steady blade.front.$k 1e-6; done)" "90.593 22.896 24.853 12.267 -9.452 6.174" 4e-3
printed "at speed: von Mises" "$(row 'its von Mises stress [MPa]' | awk '{ print $3 }')" "$(steady blade.front.von_mises 1e-6)"
within "at speed: von Mises against CalculiX" "$(row 'its von Mises stress [MPa]' | awk '{ print $1, $2 }')" \
    "$(steady blade.front.von_mises 1e-6) $(steady blade.front.von_mises 1e-6)" 3e-3
printed "at speed: pull" "$(row 'pull over the section [MPa]' | awk '{ print $2, $3 }')" "$pull"
printed "at speed: axial stress" "$(row 'axial stress of the beam [MPa]')" "$(steady bar.front.axial 1e-6)"
printed "at speed: tip" "$(row 'tip, outwards [mm]' | awk '{ print $2, $3 }')" "$(steady blade.tip.dx 1000) $(steady bar.tip.dx 1000)"

frequencies() { # RPM BODY
    "$FMDSUB" modes -s parameters.rpm="$1" $decks/airscrew-steady.yaml 2>"$work/err" |
        awk -F, -v body="$2" 'index($6, body ".") == 1 && n++ < 6 { printf "%s ", $2 }'
}
for body in blade bar; do
    for rpm in 0 8000; do frequencies $rpm $body >"$work/$body-$rpm"; done
done
printed "frequencies: solid at rest" "$(row 'blade.json at rest')" "$(cat "$work/blade-0")"
printed "frequencies: solid at speed" "$(row 'blade.json at 8000 rpm')" "$(cat "$work/blade-8000")"
printed "frequencies: beam at rest" "$(row 'beam at rest')" "$(cat "$work/bar-0")"
printed "frequencies: beam at speed" "$(row 'beam at 8000 rpm')" "$(cat "$work/bar-8000")"
within "frequencies: solid against CalculiX at rest" "$(cat "$work/blade-0")" "$(row 'CalculiX at rest')" 3e-3
within "frequencies: solid against CalculiX at speed" "$(cat "$work/blade-8000")" "$(row 'CalculiX at 8000 rpm')" 4e-3
within "frequencies: solid against CalculiX with Coriolis forces" "$(cat "$work/blade-8000")" \
    "$(row 'CalculiX, with Coriolis forces')" 3e-3
bending() { awk '{ print $1, $2, $3, $4, $6 }'; }
within "frequencies: bending of the beam against the solid at rest" "$(bending <"$work/bar-0")" "$(bending <"$work/blade-0")" 5e-3
within "frequencies: bending of the beam against the solid at speed" "$(bending <"$work/bar-8000")" \
    "$(bending <"$work/blade-8000")" 0.012

# ---- straight blades ----

# The formula for the pull over the area at the root, of all blades [MPa].
formula() { # RPM
    awk -v rpm="$1" 'BEGIN {
        pi = atan2(0, -1); W = rpm * pi / 30; R = 0.45
        for (i = 1; i <= 2; i++) for (j = 1; j <= 4; j++) {
            r0 = 0.05 * i; L = R - r0; tau = 0.25 * (j - 1)
            force = (R^2 - r0^2) / 2 * (1 + tau * r0 / L) - tau * (R^3 - r0^3) / (3 * L)
            printf "%.10g ", 2780 * W * W * force / 1e6
        }
    }'
}
straight() { # RPM
    "$FMDSUB" run -q -s parameters.W="2*pi*$1/60" tests/decks/airscrew-pull.yaml >"$work/pull.csv" 2>"$work/err"
}
each() { # BEFORE AFTER SCALE
    for i in 1 2; do for j in 1 2 3 4; do pick "$work/pull.csv" first "$1$i$j$2" "$3"; done; done
}
straight 800
within "straight blades at 800 rpm: pull" "$(each root .fx -925.925926e-6)" "$(formula 800)" 2e-5
extensions=$(awk 'BEGIN { # int sigma/E dr by Simpson
    W = 80 * atan2(0, -1) / 3; R = 0.45; n = 1000
    for (i = 1; i <= 2; i++) for (j = 1; j <= 4; j++) {
        r0 = 0.05 * i; L = R - r0; tau = 0.25 * (j - 1); sum = 0
        for (k = 0; k <= n; k++) {
            r = r0 + L * k / n
            force = (R^2 - r^2) / 2 * (1 + tau * r0 / L) - tau * (R^3 - r^3) / (3 * L)
            sum += (k == 0 || k == n ? 1 : k % 2 ? 4 : 2) * force / (1 - tau * (r - r0) / L)
        }
        printf "%.10g ", 2780 * W * W / 7e10 * sum * L / (3 * n)
    }
}')
within "straight blades at 800 rpm: extension" "$(each blade .tip.dx 1)" "$extensions" 4e-5
straight 8000
within "straight blades at 8000 rpm: pull" "$(each root .fx -925.925926e-6)" "$(formula 8000)" 2e-3
# to second order y'' = -k^2 y of y = r + u, k = W sqrt(rho/E), y(r0) = r0, y'(R) = 1: sigma = E (y'(r0) - 1)
second=$(awk 'BEGIN {
    E = 7e10; k = 8000 * atan2(0, -1) / 30 * sqrt(2780 / E)
    for (i = 1; i <= 2; i++) {
        r = 0.05 * i; a = k * (0.45 - r)
        printf "%.10g ", E * (k * (1 + r * k * sin(a)) / (k * cos(a)) - 1) / 1e6
    }
}')
within "straight blades at 8000 rpm: pull to second order" "$(each root .fx -925.925926e-6 | awk '{ print $1, $5 }')" "$second" 2e-6
within "straight blades: axial stress against the pull" "$(each blade .root.axial 1e-6)" "$(each root .fx -925.925926e-6)" 4e-3
words() { awk -v k="$1" '/^0\.(05|10) / { printf "%s ", $k }' "$readme"; }
printed "straight blades: formula" "$(words 3)" "$(formula 8000)"
printed "straight blades: pull" "$(words 4)" "$(each root .fx -925.925926e-6)"
printed "straight blades: more by" "$(words 5)" \
    "$(echo "$(each root .fx -925.925926e-6)|$(formula 8000)" | awk -F'|' '{ n = split($1, a, " "); split($2, b, " "); for (i = 1; i <= n; i++) printf "%.4f ", 100 * (a[i] / b[i] - 1) }')"
printed "straight blades: axial stress" "$(words 7)" "$(each blade .root.axial 1e-6)"
