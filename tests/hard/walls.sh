# walls.sh -- forces that begin inside a step that is chosen by its error, and conditions that are true for a while.
. tests/tools/lib.sh

# A mass of 1 kg runs at 2 m/s onto a wall at x = 1; exact: x(1 s) = 0.3168032, v(1 s) = -1.4584952 (k = 1e4, d = 20).
cat >"$work/wall.yaml" <<'END'
fmdsub: 1
bodies: {m: {mass: 1, inertia: 0, at: [0, 0]}}
constraints: {s: {prismatic: [ground, m], axis: [1, 0]}}
forces:
  wall: {force: s, value: "if(s.displacement > 1, -1.0e4*(s.displacement - 1) - 20*s.displacement_rate, 0)"}
initial: {s.displacement_rate: 2}
integrate: {until: 1}
output: {every: 0.1, columns: [s.displacement, s.displacement_rate]}
END

# A ball on a floor that takes energy, three bounces.
cat >"$work/ball.yaml" <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies: {ball: {mass: 0.3, inertia: 0.001, at: [0, 1]}}
constraints: {v: {prismatic: [ground, ball], axis: [0, 1]}}
forces:
  floor: {force: v.displacement, value: "if(v.displacement < -0.9, -2.0e4*(v.displacement+0.9)*(1-0.1*v.displacement_rate), 0)"}
integrate: {until: 2.2}
output: {every: 0.1, columns: [v.displacement, v.displacement_rate]}
END

# A heavy slide that carries a light one, and which of them runs onto a wall.
two() {
    cat <<END
fmdsub: 1
bodies:
  a: {mass: 5, inertia: 0, at: [0, 0]}
  b: {mass: 0.1, inertia: 0, at: [1, 0]}
constraints:
  s: {prismatic: [ground, a], axis: [1, 0]}
  q: {prismatic: [a, b], axis: [1, 0]}
forces:
  k: {spring: s, stiffness: 20}
  kq: {spring: q, stiffness: 1000, damping: 0.01}
  wall: {$1}
initial: {s.displacement_rate: $2, q.displacement_rate: 3}
partition: {fast: [q]}
integrate: {until: 1}
output: {every: 0.1, columns: [s.displacement, s.displacement_rate]}
END
}
two 'force: s, value: "if(s.displacement < -0.05, -1.0e5*(s.displacement + 0.05) - 20*s.displacement_rate, 0)"' -1 >"$work/slow.yaml"
two 'force: q, value: "if(q.displacement > 0.02, -1.0e4*(q.displacement - 0.02) - 5*q.displacement_rate, 0)"' 0 >"$work/fast.yaml"

# held NAME TOLERANCE MOST: both columns, at all records, within MOST tolerances of their sizes of those of the reference
held() {
    paste -d, "$work/ref" "$work/out" | awk -F, -v tol="$2" -v most="$3" '
        NR > 1 {
            n++
            for (i = 2; i <= 3; i++) {
                d = $(i + 3) - $i; if (d < 0) d = -d; if (!(d <= off[i])) off[i] = d
                s = $i < 0 ? -$i : $i; if (s > size[i]) size[i] = s
            }
        }
        END {
            for (i = 2; i <= 3; i++)
                if (n < 10 || !(off[i] <= most * tol * size[i])) { printf "column %d: %g of %g, %d records\n", i, off[i], size[i], n; bad = 1 }
            exit bad
        }' >"$work/words" && ok "$1" || not_ok "$1" "$(cat "$work/words")" "$work/err"
}
for scene in wall ball slow fast; do
    "$FMDSUB" run -q -s integrate.scheme=dopri5 -s integrate.tolerance=1e-11 "$work/$scene.yaml" >"$work/ref" 2>"$work/err"
    for scheme in midpoint newmark subcycle; do
        for tolerance in 1e-2 1e-3 1e-4 1e-5; do
            "$FMDSUB" run -q -s integrate.scheme=$scheme -s integrate.tolerance=$tolerance "$work/$scene.yaml" >"$work/out" 2>"$work/err"
            held "walls: $scene, $scheme at $tolerance" $tolerance 30
        done
    done
done

# A condition that is true between two records ends the run at a step of the scheme's own.
cat >"$work/swing.yaml" <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies: {a: {mass: 1, inertia: 0.1, at: [0.5, 0]}}
constraints: {p: {revolute: [ground, a], at: [0, 0]}}
integrate: {tolerance: 1.0e-6, until: {when: "p.angle < -0.7", latest: 5}}
output: {every: 2, columns: [p.angle]}
END
for scheme in newmark midpoint subcycle rk4 dopri5 dop853 radau5 radau9; do
    "$FMDSUB" run -q -s integrate.scheme=$scheme "$work/swing.yaml" >"$work/out" 2>"$work/err"
    expect "when, $scheme: the first step behind 0.3187 s" 1 \
        "$(tail -n 1 "$work/out" | awk -F, '$1 > 0.3187 && $1 < 0.5 && $2 < -0.7 { print 1 }')" "$work/out"
done
