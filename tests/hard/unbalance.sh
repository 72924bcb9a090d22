# unbalance.sh -- a drum with an unbalance, driven on a tub that hangs on springs from the ground: the tub's angle comes to rest
# again and again while what turns on it does not.  Errors fall by the scheme's order, and no step is rejected.
. tests/tools/lib.sh

cat >"$work/plane.yaml" <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies:
  ground: {points: {l: [-0.4, 1.0], r: [0.4, 1.0]}}
  tub: {mass: 30, inertia: 1.5, at: [0, 0.5], points: {l: [-0.2, 0.6], r: [0.2, 0.6]}}
  drum: {mass: 20, inertia: 1.0, at: [0, 0.5]}
  load: {mass: 2, inertia: 0.01, at: [0.2, 0.5]}
constraints:
  hangs: {free: [ground, tub], at: [0, 0.5]}
  axle: {revolute: [tub, drum], at: [0, 0.5]}
  glue: {fixed: [drum, load], at: [0.2, 0.5]}
forces:
  left: {spring: [ground.l, tub.l], stiffness: 8000, damping: 100}
  right: {spring: [ground.r, tub.r], stiffness: 8000, damping: 100}
drives:
  spin: {drive: axle.angle, value: 80*t}
integrate: {until: 1}
output: {every: 0.02, columns: [tub.x, tub.y, hangs.*, spin.force]}
END
cat >"$work/space.yaml" <<'END'
fmdsub: 1
gravity: [0, -9.81, 0]
bodies:
  ground: {points: {l: [-0.4, 1.0, 0.1], r: [0.4, 1.0, 0.1], b: [0, 1.0, -0.3]}}
  tub: {mass: 30, inertia: [2, 2.5, 1.5], at: [0, 0.5, 0], points: {l: [-0.2, 0.6, 0.1], r: [0.2, 0.6, 0.1], b: [0, 0.6, -0.2]}}
  drum: {mass: 20, inertia: [0.7, 0.7, 1.0], at: [0, 0.5, 0]}
  load: {mass: 2, inertia: [0.01, 0.01, 0.01], at: [0.2, 0.5, 0.05]}
constraints:
  hangs: {free: [ground, tub], at: [0, 0.5, 0]}
  axle: {revolute: [tub, drum], at: [0, 0.5, 0], axis: [0, 0, 1]}
  glue: {fixed: [drum, load], at: [0.2, 0.5, 0.05]}
forces:
  left: {spring: [ground.l, tub.l], stiffness: 8000, damping: 100}
  right: {spring: [ground.r, tub.r], stiffness: 8000, damping: 100}
  back: {spring: [ground.b, tub.b], stiffness: 8000, damping: 100}
  mount: {bushing: [ground, tub], at: [0, 0.9, 0], stiffness: [500, 500, 500], rotation: [50, 50, 50]}
drives:
  spin: {drive: axle.angle, value: 80*t}
integrate: {until: 1}
output: {every: 0.02, columns: [tub.x, tub.y, tub.z, spin.force]}
END
for deck in plane space; do
    for scheme in midpoint subcycle newmark; do
        case $scheme in
        subcycle) set -- --ratios 2 -s 'partition={fast: [hangs]}' ;;
        *) set -- ;;
        esac
        "$FMDSUB" study -q --repeats 0 --schemes $scheme --steps 1.0e-3,5.0e-4 "$@" "$work/$deck.yaml" >"$work/rows" 2>"$work/err"
        expect "$deck, $scheme: status, errors at 1 and 0.5 ms, their ratio" "0 0" \
            "$? $(awk -F, -v s=$scheme '$1 == s && $3 > 0 && $3 <= 1e-3 { e[++n] = $5 } END { print !(n == 2 && e[1] < 4e-3 && e[1] / e[2] > 3.5 && e[1] / e[2] < 4.5) }' "$work/rows")" \
            "$work/rows" "$work/err"
        "$FMDSUB" run -s integrate.scheme=$scheme -s integrate.step=5.0e-4 -q --stats="$work/stats" "$work/$deck.yaml" >"$work/out" 2>"$work/err"
        expect "$deck, $scheme: rejected" "0 rejected 0" "$? $(grep '^rejected' "$work/stats")" "$work/err" "$work/stats"
    done
done
