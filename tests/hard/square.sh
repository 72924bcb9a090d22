# square.sh -- more freedoms than the square root of the largest int: their matrices are too large, and nothing less.
. tests/tools/lib.sh

cat >"$work/square.yaml" <<'EOF'
fmdsub: 1
bodies:
  b$i: {repeat: {i: [1, 10934]}, mass: 1, inertia: [1, 1, 1], at: [i, 0, 0]}
constraints:
  j$i: {repeat: {i: [1, 10934]}, free: [ground, b$i]}
forces:
  s: {spring: [b1, b2], stiffness: 1}
partition: {fast: [j1]}
integrate: {scheme: midpoint, step: 1.0e-3, until: 2.0e-3}
output: {columns: [j1.x]}
EOF
for scheme in midpoint miao subcycle; do
    (ulimit -v 8000000 && "$FMDSUB" run -q --set integrate.scheme=$scheme --set integrate.ratio=2 "$work/square.yaml" \
        >"$work/out" 2>"$work/err")
    expect "65604 freedoms, $scheme: status" 7 $? "$work/err"
done
