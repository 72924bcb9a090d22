# scales.sh -- a tolerance is a share: the same mechanism in micrometres is as accurate as in metres; what dopri5 makes of
# a force that sets in.
. tests/tools/lib.sh

# Lengths times l, times times sqrt(l): forces stay.
cat >"$work/springs.yaml" <<'END'
fmdsub: 1
parameters: {l: 1}
bodies:
  one: {mass: 2, at: [0, 0]}
  two: {mass: 1, at: [l, 0]}
constraints:
  rail: {prismatic: [ground, one], axis: [1, 0]}
  slot: {prismatic: [one, two], axis: [1, 0]}
forces:
  soft:  {spring: rail, stiffness: 30/l}
  stiff: {spring: slot, stiffness: 300/l}
  pull:  {spring: [[0, l], two], stiffness: 30/l}
initial: {rail.displacement: 0.3*l}
integrate: {scheme: dopri5, tolerance: 1.0e-6, until: 3*sqrt(l)}
output: {every: 0.1*sqrt(l), columns: [rail.displacement, slot.displacement]}
END
cat >"$work/telescope.yaml" <<'END'
fmdsub: 1
parameters: {l: 1}
gravity: [0, -9.81]
bodies:
  rod: {mass: 2, inertia: 0.1*l^2, at: [l, 0]}
  bob: {mass: 1, inertia: 0.02*l^2, at: [1.5*l, 0]}
constraints:
  hub:   {revolute: [ground, rod], at: [0, 0]}
  guide: {prismatic: [rod, bob], at: [l, 0], axis: [1, 0]}
forces:
  spring: {spring: guide, stiffness: 300/l}
integrate: {scheme: dopri5, tolerance: 1.0e-6, until: 3*sqrt(l)}
output: {every: 0.1*sqrt(l), columns: [hub.angle, guide.displacement]}
END
# The bar of a loop along a micrometre, free in the plane.
cat >"$work/loop.yaml" <<'END'
fmdsub: 1
parameters: {l: 1}
gravity: [0, -9.81]
bodies:
  one: {mass: 1, inertia: 0.1*l^2, at: [0, 0]}
  two: {mass: 1, inertia: 0.1*l^2, at: [l, l]}
constraints:
  flat:  {prismatic: [ground, one], axis: [1, 0]}
  slope: {prismatic: [ground, two], axis: [0, 1]}
  bar:   {distance: [one, two], length: sqrt(2)*l}
forces:
  soft: {spring: flat, stiffness: 30/l}
integrate: {scheme: dopri5, tolerance: 1.0e-6, until: 0.7*sqrt(l)}
output: {every: 0.1*sqrt(l), columns: ["flat.*", "*displacement"]}
END
# No arm and no start tells a length, but where a stop begins or a spring rests.
cat >"$work/stop.yaml" <<'END'
fmdsub: 1
parameters: {l: 1}
bodies:
  proof: {mass: 1, at: [0, 0]}
constraints:
  rail: {prismatic: [ground, proof], axis: [1, 0]}
forces:
  back: {force: rail, value: "-20*rail.displacement/l"}
  push: {force: rail, value: "5*cos(3*t/sqrt(l))"}
  stop: {unilateral: rail, from: 0.2*l, stiffness: 200/l}
integrate: {scheme: dopri5, tolerance: 1.0e-6, until: 3*sqrt(l)}
output: {every: 0.1*sqrt(l), columns: [rail.displacement]}
END
sed -e '/stop:/d' -e 's|back: .*|back: {spring: rail, stiffness: 20/l, rest: 0.2*l}|' "$work/stop.yaml" >"$work/rest.yaml"
for deck in springs telescope loop stop rest; do
    for l in 1 1.0e-6 1.0e+2; do
        for tolerance in 1.0e-6 1.0e-9 1.0e-13; do
            "$FMDSUB" run -q --set parameters.l=$l --set integrate.tolerance=$tolerance --stats="$work/stats.$tolerance" \
                "$work/$deck.yaml" >"$work/at.$tolerance" 2>"$work/err" || cp "$work/err" "$work/failed"
        done
        for tolerance in 1.0e-6 1.0e-9; do
            awk -F, -v l=$l '
                NR == 1 { for (i = 2; i <= NF; i++) per[i] = $i ~ /displacement$/ ? l : $i ~ /angle$/ ? 1 : 0 }
                FNR == 1 { next }
                NR == FNR { for (i = 2; i <= NF; i++) x[FNR, i] = $i; next }
                { for (i = 2; i <= NF; i++) if (per[i]) { d = ($i - x[FNR, i]) / per[i]; d = d < 0 ? -d : d; if (d > worst) worst = d } rows++ }
                END { printf "%.2g\n", (rows > 7 ? worst : 1) }' "$work/at.1.0e-13" "$work/at.$tolerance" >"$work/error.$l.$tolerance"
            awk '/minor_steps/ { print $2 }' "$work/stats.$tolerance" >"$work/steps.$l.$tolerance"
        done
    done
    case $deck in stop | rest) near=0.1 ;; *) near=0.3 ;; esac
    for tolerance in 1.0e-6 1.0e-9; do
        for l in 1.0e-6 1.0e+2; do
            set -- $(cat "$work/error.1.$tolerance" "$work/error.$l.$tolerance" "$work/steps.1.$tolerance" "$work/steps.$l.$tolerance")
            case $(awk -v a="$1" -v b="$2" -v m="$3" -v n="$4" -v t=$tolerance -v near=$near \
                'BEGIN { print (b < 3*a + 1e-12 && b < 30*t && n > (1 - near)*m && n < (1 + near)*m) }') in
            1) ok "$deck, l = $l, tolerance $tolerance: error $2 of l in $4 steps, with l = 1 $1 in $3" ;;
            *) not_ok "$deck, l = $l, tolerance $tolerance" "error $2 of l in $4 steps, with l = 1 $1 in $3" "$work/err" ;;
            esac
        done
    done
done

# From rest, a force sets in that no step can resolve: 105/100 F at t = 3.
cat >"$work/kick.yaml" <<'END'
fmdsub: 1
parameters: {F: 100}
bodies:
  one: {mass: 2, at: [0, 0]}
constraints:
  rail: {prismatic: [ground, one], axis: [1, 0]}
forces:
  push: {force: rail, value: "if(t < 0.9, 0, F)"}
integrate: {scheme: dopri5, tolerance: 1.0e-12, until: 3}
output: {every: 3}
END
for F in 1.0e-3 100 1.0e+6; do
    for tolerance in 1.0e-6 1.0e-9 1.0e-12 1.0e-14; do
        "$FMDSUB" run -q --set parameters.F=$F --set integrate.tolerance=$tolerance "$work/kick.yaml" >"$work/out" 2>"$work/err"
        awk -F, -v F=$F -v t=$tolerance 'END { d = $3/(1.05*F) - 1; exit !(NR == 3 && (d < 0 ? -d : d) < 1e-3*sqrt(t/1e-6) + 1e-13) }' "$work/out" &&
            ok "$F N sets in, tolerance $tolerance" || not_ok "$F N sets in, tolerance $tolerance" "last record:" "$work/out" "$work/err"
    done
done
