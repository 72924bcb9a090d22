# excited.sh -- stiff motion that is excited and that the step does not resolve, in scenes of many kinds under every scheme of fixed steps:
# where a column is wrong by more than 3 percent of its range the run ends with 1, or its end line says that the error is not known,
# grows, or is of that size.  The reference: an explicit scheme whose steps the stiff part makes.
. tests/tools/lib.sh
cd "$work" || exit 1
cat >chain.yaml <<'DECK'
fmdsub: 1
gravity: [0, -9.81]
parameters: {k: 1.0e+6, e: 0.001}
bodies:
  a: {mass: 1, inertia: 1/12, at: [0.5, 0]}
  b: {mass: 1, inertia: 1/12, at: [1.5, 0]}
  c: {mass: 0.5, inertia: 0.02, at: [2.2, 0]}
constraints:
  p: {revolute: [ground, a], at: [0, 0]}
  s: {prismatic: [a, b], at: [1, 0], axis: [1, 0]}
  q: {revolute: [b, c], at: [2, 0]}
forces: {k: {spring: s, stiffness: k}}
initial: {s.displacement: e}
partition: {fast: [s]}
integrate: {scheme: midpoint, step: 1.0e-2, until: 3}
output: {every: 0.1, columns: [p.angle, q.angle]}
DECK
cat >bush.yaml <<'DECK'
fmdsub: 1
gravity: [0, 0, -9.81]
parameters: {k: 1.0e+6, e: 0.001}
bodies:
  a: {mass: 1, inertia: [0.02, 0.1, 0.1], at: [0.5, 0, 0]}
  b: {mass: 1, inertia: [0.02, 0.1, 0.12], at: [1.5, 0, 0]}
constraints:
  p: {revolute: [ground, a], at: [0, 0, 0], axis: [0, 1, 0]}
  f: {free: [a, b], at: [1, 0, 0]}
forces: {k: {bushing: [a, b], at: [1, 0, 0], stiffness: [k, k, k], rotation: [k/10, 0.5, k/10]}}
initial: {f.x: e, p.angle_rate: 1}
partition: {fast: [f]}
integrate: {scheme: midpoint, step: 1.0e-2, until: 3}
output: {every: 0.1, columns: [p.angle, b.x, b.z]}
DECK
cat >beam.yaml <<'DECK'
fmdsub: 1
gravity: [0, -9.81]
parameters: {e: 0.001}
bodies:
  hub: {mass: 1, inertia: 0.05, at: [0, 0]}
  arm: {beam: {from: [0, 0], to: [1, 0], elements: 6}, section: {rectangle: [0.02, 0.02]}, material: steel, modes: 3}
  bob: {mass: 0.5, inertia: 0.01, at: [1.2, 0]}
constraints:
  p: {revolute: [ground, hub], at: [0, 0]}
  w: {fixed: [hub, arm], at: [0, 0]}
  q: {revolute: [arm, bob], at: [1, 0]}
initial: {arm.mode1: e}
partition: {fast: [arm]}
integrate: {scheme: midpoint, step: 1.0e-2, until: 3}
output: {every: 0.1, columns: [p.angle, q.angle]}
DECK
cat >motor.yaml <<'DECK'
fmdsub: 1
gravity: [0, -9.81]
parameters: {k: 1.0e+6, e: 0.001}
bodies:
  rotor: {mass: 5000, inertia: 2000, at: [5, 0]}
  a: {mass: 1, inertia: 1/12, at: [0.5, 0]}
  b: {mass: 1, inertia: 1/12, at: [1.5, 0]}
constraints:
  shaft: {revolute: [ground, rotor], at: [5, 0]}
  p: {revolute: [ground, a], at: [0, 0]}
  s: {prismatic: [a, b], at: [1, 0], axis: [1, 0]}
forces:
  k: {spring: s, stiffness: k}
  m: {torque: shaft, value: 2.0e+5}
  d: {damper: shaft, damping: 2000}
initial: {s.displacement: e, shaft.angle_rate: 50}
partition: {fast: [s]}
integrate: {scheme: midpoint, step: 1.0e-2, until: 3}
output: {every: 0.1, columns: [p.angle, b.x]}
DECK
cat >twist.yaml <<'DECK'
fmdsub: 1
gravity: [0, -9.81]
parameters: {k: 1.0e+6, e: 0.001}
bodies:
  a: {mass: 2, inertia: 0.3, at: [0.5, 0]}
  b: {mass: 1, inertia: 1/12, at: [1.5, 0]}
  c: {mass: 1, inertia: 1/12, at: [2.5, 0]}
constraints:
  p: {revolute: [ground, a], at: [0, 0]}
  s: {revolute: [a, b], at: [1, 0]}
  q: {revolute: [b, c], at: [2, 0]}
forces: {k: {spring: s, stiffness: k}}
initial: {s.angle: e}
partition: {fast: [s]}
integrate: {scheme: midpoint, step: 1.0e-2, until: 3}
output: {every: 0.1, columns: [p.angle, q.angle]}
DECK

# Shaken by a load that turns round within a step.
sed 's/^initial: .*/initial: {p.angle: -1.5, q.angle: 0.2}/; s/^forces: .*/forces: {k: {spring: s, stiffness: k}, f: {force: s, value: "k*e*0.3*sin(700*t)"}}/' chain.yaml >shaken.yaml

excited() { # DECK SCHEME STEP RATIO RHO SETTING...
    deck=$1 how="$2 $3 $4:1 rho $5"
    set_by="--set integrate.scheme=$2 --set integrate.step=$3 --set integrate.ratio=$4 --set integrate.rho_infinity=$5"
    shift 5
    "$FMDSUB" run "$@" $set_by $deck.yaml >out 2>err
    rc=$?
    off=$(awk -F, 'FNR == 1 { next } NR == FNR { t = sprintf("%.3f", $1); for (i = 2; i <= NF; i++) { r[t, i] = $i; if (FNR == 2 || $i < low[i]) low[i] = $i; if (FNR == 2 || $i > high[i]) high[i] = $i } next }
        { t = sprintf("%.3f", $1); if ((t, 2) in r) n++; for (i = 2; i <= NF; i++) { d = ($i - r[t, i]) / (high[i] - low[i]); if (d < 0) d = -d; if (d > most) most = d } } END { print (n > 1 ? most : 99) }' want out)
    said=$(sed -n 's/^estimated error: .*grow all the way.*/grows/p; s/^estimated error: \(not known\).*/\1/p; s/^estimated error: \([0-9.e-]*\) .*/\1/p' err)
    if [ $rc = 1 ] || [ $rc = 5 ] || awk -v off="$off" -v said="$said" 'BEGIN { exit !(off <= 0.03 || said == "not known" || said == "grows" || said * 5 >= off) }'; then ok "excited: $deck, $how, $*"
    else not_ok "excited: $deck, $how, $*" "wrong by $off of a range, exit $rc, said: $said" err; fi
}

for deck in chain bush beam motor twist shaken; do
    for at in 1.0e+5:0.01 1.0e+7:0.001; do
        set -- --set parameters.e=${at#*:}
        [ $deck = beam ] || set -- "$@" --set parameters.k=${at%:*}
        "$FMDSUB" run -q "$@" --set integrate='{scheme: dop853, tolerance: 1.0e-8, until: 3}' $deck.yaml >want 2>err
        for scheme in midpoint newmark generalized-alpha hht; do
            rho=1
            [ $scheme = hht ] && rho=0.9
            excited $deck $scheme 1.0e-2 1 $rho "$@"
            excited $deck $scheme 1.0e-2 1 0.7 "$@"
        done
        excited $deck subcycle 2.5e-3 4 1 "$@"
        excited $deck subcycle 2.5e-3 4 0.5 "$@"
    done
done
