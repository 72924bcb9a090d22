# invariance.sh -- the same mechanism in another order, under other names, shifted, turned, in other units.
. tests/tools/lib.sh

# The joints that close loops and the independent coordinates are the deck's in every variant.
sed 's/wrist: *{/wrist: {loop: true, /' decks/telescope.yaml >"$work/base.yaml"
run() { "$FMDSUB" run -q --set integrate.newton_tolerance=1.0e-13 "$1" >"$2" 2>"$work/err"; }

# Columns 4 and 6 are lengths and energies, all else angles: |a - b factor| <= tol max|a|
compare() { # NAME RUN SCALE TOL
    awk -F, -v scale="$3" -v tol="$4" '
        function size(x) { return x < 0 ? -x : x }
        FNR == 1 { next }
        NR == FNR { for (i = 1; i <= 5; i++) { a[FNR, i] = $i; if (size($i) > most[i]) most[i] = size($i) } rows = FNR; next }
        { for (i = 1; i <= 5; i++) { d = size(a[FNR, i] - $i / (i == 4 ? scale : 1)) / most[i]; if (d > worst) worst = d } last = FNR }
        END { printf "%.2g", worst; exit !(last == rows && last == 52 && worst <= tol) }' "$work/base.csv" "$2" >"$work/worst"
    if [ $? = 0 ]; then ok "$1: differs by $(cat "$work/worst")"
    else not_ok "$1" "differs by $(cat "$work/worst"), allowed $4" "$work/err"; fi
}

variant() { # NAME SCALE TOL -v ...
    name=$1 scale=$2 tol=$3
    shift 3
    awk -f tests/hard/variant.awk "$@" "$work/base.yaml" >"$work/variant.yaml"
    run "$work/variant.yaml" "$work/variant.csv"
    compare "$name" "$work/variant.csv" "$scale" "$tol"
}

run "$work/base.yaml" "$work/base.csv"
variant "another order" 1 1e-10 -v reversed=1
variant "other names" 1 1e-10 -v renamed=1
variant "turned by 0.7" 1 1e-10 -v turn=0.7
variant "shifted by 1000 m" 1 1e-9 -v x=1000 -v y=-300
variant "shifted by 1e6 m" 1 1e-6 -v x=1000000 -v y=-300000
variant "in millimetres" 1000 1e-10 -v scale=1000
variant "all of it" 1000 1e-9 -v reversed=1 -v renamed=1 -v turn=-2.1 -v x=50 -v y=70 -v scale=1000

# What a spring between the ground and a body misses of its energy is given to both the same way wherever the scene stands.
cat >"$work/apart.yaml" <<'END'
fmdsub: 1
parameters: {X: 0}
gravity: [0, 0, -9.81]
bodies:
  hub: {mass: 2, inertia: [0.1, 0.08, 0.13], at: [X, 0.2, 0], points: {p: [0.1, -0.2, 0.3]}}
  arm: {mass: 5, inertia: [0.6, 0.5, 0.7], at: [X + 0.4, 0.3, 0.1]}
constraints:
  float: {free: [ground, hub], at: [X, 0, 0]}
  loose: {free: [hub, arm], at: [X + 0.2, 0.2, 0]}
forces:
  inner: {bushing: [hub, arm], at: [X + 0.2, 0.1, 0], axis: [0.3, -0.5, 0.4], stiffness: [800, 800, 1600], rotation: [80, 80, 0]}
  outer: {bushing: [ground, hub], at: [X, 0.3, 0.2], axis: [0, 0.6, -0.3], stiffness: [180, 180, 110], rotation: [18, 18, 0]}
initial: {float.omega: {value: [0.5, -1.5, 1], frame: body}, loose.omega: {value: [1.1, 1.9, -1], frame: body}}
integrate: {scheme: midpoint, step: 5.0e-3, until: 0.5, newton_tolerance: 1.0e-12}
output: {every: 0.05, columns: [hub.vx, hub.vy, hub.vz, arm.vx, arm.vy, arm.vz, energy.kinetic]}
END
for scheme in midpoint subcycle; do
    for X in 0 7 500; do "$FMDSUB" run -q --set integrate.scheme=$scheme --set parameters.X=$X "$work/apart.yaml" 2>"$work/err" | tail -n 1 >"$work/at$X"; done
    near "a scene 7 m from the origin, $scheme" "$(cat "$work/at0")" "$(cat "$work/at7")" 1e-9
    near "a scene 500 m from the origin, $scheme" "$(cat "$work/at0")" "$(cat "$work/at500")" 1e-7
done
