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
