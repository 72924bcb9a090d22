# nearby.sh -- of 100 points of a body the two that are near a floor are paid for: instructions of a step by callgrind, the same
# number every time, against those of a body that has these two only.
. tests/tools/lib.sh
command -v valgrind >/dev/null || { skip nearby "valgrind is not installed"; exit 0; }

# deck POINTS LAW START: two below, all others on an arc above.
deck() {
    awk -v n="$1" -v law="$2" -v start="$3" 'BEGIN {
        print "fmdsub: 1\ngravity: [0, -9.81]"
        printf "bodies: {b: {mass: 1, inertia: 0.3, at: [0, 0.5], points: {p0: [-0.5, -0.5], p1: [0.5, -0.5]"
        for (i = 2; i < n; i++) printf ", p%d: [%.6f, %.6f]", i, .5 * cos(3.14159265 * (i - 1) / (n - 1)), .5 * sin(3.14159265 * (i - 1) / (n - 1))
        printf "}}}\nconstraints: {f: {planar: [ground, b], at: [0, 0.5]}}\nsurfaces: {floor: {plane: ground, at: [0, 0], normal: [0, 1]}, feet: {points: [b.p0"
        for (i = 1; i < n; i++) printf ", b.p%d", i
        printf "]}}\ncontacts: {c: {between: [feet, floor]%s}}\ninitial: {%s}\n", law, start
        print "integrate: {scheme: midpoint, step: 1.0e-3, until: 1}\noutput: {every: 1, columns: [b.x]}"
    }'
}

collected() { # POINTS UNTIL LAW START
    deck "$1" "$3" "$4" >"$work/deck.yaml"
    valgrind --tool=callgrind --callgrind-out-file=/dev/null "$FMDSUB" run -q --until "$2" "$work/deck.yaml" 2>&1 >/dev/null |
        awk '/Collected/ { print $NF }'
}

# at_most NAME LIMIT LAW START
at_most() {
    few=$(($(collected 2 0.5 "$3" "$4") - $(collected 2 0.1 "$3" "$4")))
    many=$(($(collected 100 0.5 "$3" "$4") - $(collected 100 0.1 "$3" "$4")))
    expect "100 points, 2 near, $1: at most $2 of what the 2 cost" yes \
        "$(awk -v few=$few -v many=$many -v most="$2" 'BEGIN { x = many / few; print (few > 0 && x > .5 && x <= most) ? "yes" : x }')"
}

at_most "they glide" 1.1 "" "f.x_rate: 3"
at_most "they slide" 1.1 ", friction: 0.3" "f.x_rate: 20"
at_most "they bounce" 1.1 ", friction: 0.3, restitution: 0.5" "f.y: 0.2, f.angle: 0.1, f.x_rate: 1"
