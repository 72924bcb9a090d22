# segments.sh -- columns of a point mean the same for a beam in one piece and cut into segments: they are of the whole.
. tests/tools/lib.sh

# A cantilever of P L^3 / 3 E I = 0.02 m and P L^2 / 2 E I = 0.03 rad, L = 1.  Its own foreshortening is one frame's to
# (v/L)^2 of the deflection.
cat >"$work/plane.yaml" <<'END'
fmdsub: 1
parameters: {P: 0.02*3*2.0e11*0.02*0.002^3/12}
bodies:
  beam:
    beam: {from: [0, 0], to: [1, 0], elements: 24}
    section: {rectangle: [0.02, 0.002]}
    material: {E: 2.0e11, nu: 0.3, density: 7850}
    points: {start: {station: 0, static: true}, tip: {station: 1, static: true}}
constraints: {c: {fixed: [ground, beam], at: [0, 0]}}
forces: {m: {force: beam.tip, value: [0, P]}}
initial: static
integrate: {scheme: midpoint, step: 1.0e-3, until: 0.01}
output: {every: 0.01, columns: [beam.tip.dx, beam.tip.dy, beam.tip.rz, c.fy, c.mz]}
END
cat >"$work/space.yaml" <<'END'
fmdsub: 1
parameters: {P: 0.02*3*2.0e11*0.02*0.02^3/12}
bodies:
  beam:
    beam: {from: [1, 2, 3], to: [1, 2, 4], up: [0, 1, 0], elements: 24}
    section: {rectangle: [0.02, 0.02]}
    material: {E: 2.0e11, nu: 0.3, density: 7850}
    points: {start: {station: 0, static: true}, tip: {station: 1, static: true}}
constraints: {c: {fixed: [ground, beam], at: [1, 2, 3]}}
forces: {m: {force: beam.tip, value: [P, 0, 0]}}
initial: static
integrate: {scheme: midpoint, step: 1.0e-3, until: 0.01}
output: {every: 0.01, columns: [beam.tip.dx, beam.tip.dy, beam.tip.dz, beam.tip.rx, beam.tip.ry, beam.tip.rz]}
END
# bent NAME DECK LARGEST [--set...]: in one piece, 2, 4 and 8 segments, to a thousandth of the largest column.
bent() {
    name=$1 deck=$2 large=$3; shift 3
    for n in 1 2 4 8; do
        "$FMDSUB" run -q --set "bodies.beam.segments=$n" "$@" "$deck" 2>>"$work/err" | tail -n 1
        echo
    done >"$work/rows"
    awk -F, -v large="$large" 'NF < 3 { next } ++rows == 1 { n = NF; for (i = 2; i <= n; i++) { one[i] = $i; if ($i^2 > top) top = $i^2 }; next }
        { for (i = 2; i <= n; i++) { d = $i - one[i]; d = d < 0 ? -d : d; if (d > worst) worst = d } }
        END { top = sqrt(top); printf "%d runs, at most %.2g apart, largest %.4g", rows, worst, top
              exit !(rows == 4 && worst < 1e-3 * large && top > .99 * large && top < 1.01 * large) }' "$work/rows" >"$work/line"
    if [ $? = 0 ]; then ok "$name: $(cat "$work/line")"
    else not_ok "$name" "$(cat "$work/line")" "$work/rows" "$work/err"; fi
}
: >"$work/err"
bent "bent in the plane" "$work/plane.yaml" .16
bent "bent in space" "$work/space.yaml" .03
bent "bent, held at the other end" "$work/plane.yaml" .03 --set 'constraints.c={fixed: [ground, beam], at: [1, 0]}' \
    --set forces.m.force=beam.start --columns beam.start.dx,beam.start.dy,beam.start.rz,beam.tip.dy

# A moment rolls it up to more than half a turn, th = M L / E I: dx = L (sin(th)/th - 1), dy = L (1 - cos(th))/th, rz = th.
"$FMDSUB" run -q --until 0.01 --set bodies.blade.segments=24 --set bodies.blade.beam.elements=48 --set 'bodies.blade.points.tip={station: 1, static: true}' \
    --set forces.turn.value='1.25*pi*E*I/L' --columns blade.tip.dx,blade.tip.dy,blade.tip.rz decks/roll-up.yaml 2>"$work/err" |
    tail -n 1 >"$work/out"
awk -F, '{ th = 1.25 * 3.14159265358979; x = $2 - sin(th) / th + 1; y = $3 - (1 - cos(th)) / th; z = $4 - th
    printf "off by %.2g m, %.2g m, %.2g rad", x, y, z; seen = x * x + y * y + z * z < 1e-4 }
    END { exit !seen }' "$work/out" >"$work/line"
if [ $? = 0 ]; then ok "rolled up by 225 degrees: $(cat "$work/line")"
else not_ok "rolled up by 225 degrees" "$(cat "$work/line")" "$work/out" "$work/err"; fi
