# adaptive.sh -- dopri5 chooses better coordinates between its own steps, however far apart the records are.
. tests/tools/lib.sh
cat >"$work/rod.yaml" <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies:
  body: {mass: 1, inertia: 0.01, at: [1, 0], points: {hook: [-0.1, 0]}}
constraints:
  rod: {distance: [[0, 0], body.hook]}
integrate: {scheme: dopri5, tolerance: 1.0e-9, until: 2}
output: {columns: [body.x, body.y]}
END
for every in 2 0.005; do
    timeout 20 "$FMDSUB" run -q --every $every "$work/rod.yaml" 2>"$work/err" | tail -n 1 >"$work/$every"
done
expect "dopri5: a body on a rod, seen seldom or often" fine "$(paste -d , "$work/2" "$work/0.005" | awk -F , '
    NF == 6 && $1 == 2 && ($2 - $5) ^ 2 + ($3 - $6) ^ 2 < 1e-14 { print "fine" }')" "$work/2" "$work/0.005" "$work/err"
