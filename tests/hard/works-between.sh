# works-between.sh -- works at records that lie between the steps of a scheme that chooses them: a force of 10 N on 2 kg
# does 25 t^2.
. tests/tools/lib.sh

for scheme in dopri5 rk4 newmark hht midpoint radau5; do
    cat >"$work/deck.yaml" <<END
fmdsub: 1
bodies: {b: {mass: 2, at: [0, 0]}}
constraints: {s: {prismatic: [ground, b], at: [0, 0], axis: [1, 0]}}
forces: {f: {force: s, value: 10}}
integrate: {scheme: $scheme, tolerance: 1.0e-4, until: 2}
output: {every: 0.01, columns: [energy.external]}
END
    "$FMDSUB" run -q "$work/deck.yaml" >"$work/out" 2>"$work/err"
    ended "work by $scheme: status" 0 $? "$work/out" "$work/err"
    awk -F, 'NR > 1 { n++; d = $2 - 25 * $1 ^ 2; if (d ^ 2 > 1e-4) bad = 1 } END { exit bad || n != 201 }' "$work/out" &&
        ok "work by $scheme: 25 t^2 at all records" || not_ok "work by $scheme: 25 t^2 at all records" "off by 0.01 J of 100" "$work/out"
done
