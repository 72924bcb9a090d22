# restart.sh -- a run and its continuation from --final-state are one run, byte for byte, under every deck.
#
# What an integrator carries from step to step is in the state (base/recall.h): a thing that is forgotten there shows
# here.  Every shipped deck under its own scheme over MAJORS major steps; under all others: tests/long/restart.sh.
. tests/tools/lib.sh
. tests/tools/restarted.sh

decks=0
for deck in *.yaml; do
    name=${deck%.yaml}
    wanted "$name" || continue
    set -- $(plan $deck)
    [ $# = 3 ] || continue
    H=$(awk "BEGIN { printf \"%.12g\", $1 * $2 }")
    every="--every-steps 1"
    [ $3 = 1 ] && every="--every $H"
    why=$(one_run $deck $MAJORS)
    [ -z "$why" ] && ok "restart: $name" && decks=$((decks + 1)) || not_ok "restart: $name" "$why"
done
[ "$D" ] || { [ $decks -ge 70 ] && ok "restart: all decks" || not_ok "restart: all decks" "only $decks"; }

# Schemes that take turns: each keeps what it carries under a name of its own.  When one is looked at hangs on what is left of the run,
# so that half a run and the other half may take other turns: their ends are within a thousandth of the largest column then.
if wanted turns; then
    for run in "double-pendulum 0.25 16" "four-bar 0.1 10" "governor 0.15 16" "flexible-pendulum 0.05 8"; do
        set -- $run
        H=$2 every="--every $2"
        why=$(one_run $1.yaml $3 -s 'integrate={scheme: auto, tolerance: 1.0e-4, until: 1}')
        case $why in
        *differ*)
            { tail -n 1 whole; tail -n 1 both; } | awk -F, '{ for (i = 1; i <= NF; i++) if (NR == 1) { x[i] = $i; if ($i * $i > most) most = $i * $i } else if (($i - x[i]) ^ 2 > 1e-6 * most) bad = 1; n = NF } END { exit bad || NR != 2 || n < 4 }' && why=
            ;;
        esac
        [ -z "$why" ] && ok "restart: turns, $1" || not_ok "restart: turns, $1" "$why"
    done
fi

# A run of few steps does not follow its errors along the motion, and one that goes on from it does not begin to; nor must the
# first one be as short as the rest.
if wanted few; then
    for half in 400 700; do
        "$FMDSUB" run -q --until 1 --every 0.1 gear-train.yaml >whole 2>err
        "$FMDSUB" run -q --until 0.$half --every 0.1 --final-state half.json gear-train.yaml >first 2>>err
        "$FMDSUB" run -q --until 1 --every 0.1 -s 'initial={from: half.json, time: keep}' gear-train.yaml >rest 2>>err
        expect "restart: $half steps before" "0 the same wrote" "$? $({ cat first; sed 1,2d rest; } | cmp - whole && echo the same) $(wrote whole)" err
    done
fi

# The balance is off by a little, so that the guard looks for what the step does not resolve: no step may feel that.
if wanted looks; then
    cat >looks.yaml <<'END'
fmdsub: 1
bodies:
  a: {mass: 1, inertia: 0.1, at: [0.5, 0]}
  b: {mass: 1, inertia: 0.1, at: [1.5, 0]}
constraints:
  A: {revolute: [ground, a], at: [0, 0]}
  B: {revolute: [a, b], at: [1, 0]}
forces: {spring: {spring: B, stiffness: 1000, cubic: 10000}}
initial: {B.angle: 0.2, A.angle_rate: 2}
integrate: {scheme: newmark, step: 2.0e-3, until: 1}
END
    for scheme in newmark generalized-alpha hht miao; do
        H=2.0e-3 every="--every-steps 1"
        why=$(one_run looks.yaml 400 -s integrate.scheme=$scheme)
        [ -z "$why" ] && ok "restart: looks, $scheme" || not_ok "restart: looks, $scheme" "$why"
    done
fi

# Which joints have coordinates, and in which order, comes from what `initial:` names, too: the state tells it.
if wanted tree; then
    cat >four.yaml <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies:
  a: {mass: 1, inertia: 0.1, at: [0, 0.5]}
  b: {mass: 1, inertia: 0.1, at: [1, 1.2]}
  c: {mass: 1, inertia: 0.1, at: [2, 0.7]}
  loose: {mass: 1, inertia: 0.1, at: [5, 0]}
constraints:
  A: {revolute: [ground, a], at: [0, 0]}
  B: {revolute: [a, b], at: [0, 1]}
  C: {revolute: [b, c], at: [2, 1.4]}
  D: {revolute: [c, ground], at: [2, 0]}
initial: {C.angle_rate: 1}
integrate: {scheme: midpoint, step: 1.0e-3, until: 0.4}
END
    "$FMDSUB" run -q --every 0.1 --columns 'a.*,c.*,loose.*' four.yaml >whole 2>err
    "$FMDSUB" run -q --until 0.2 --final-state half.json four.yaml >first 2>>err
    "$FMDSUB" run -q --every 0.1 --columns 'a.*,c.*,loose.*' -s 'initial={from: half.json, time: keep}' four.yaml >rest 2>>err
    [ -s rest ] && [ "$(tail -n 1 whole)" = "$(tail -n 1 rest)" ] && ok "restart: the tree that 'initial' asked for" ||
        not_ok "restart: the tree that 'initial' asked for" "another end" err
fi

# What the start displaces is the only length of a slide by itself: the state tells it, and the tolerance means the same.
if wanted length; then
    for scheme in radau5 radau9 dop853 dopri5; do
        H=0.01 every="--every 0.01"
        why=$(one_run slide-damped.yaml 4 -s "integrate={scheme: $scheme, tolerance: 1.0e-7, until: 1}")
        [ -z "$why" ] && ok "restart: length, $scheme" || not_ok "restart: length, $scheme" "$why"
    done
fi

# What sub-cycling keeps of limbs without fast coordinates is older than the step that was the last one.
if wanted limbs; then
    cat >limbs.yaml <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies:
  a$i: {repeat: {i: [1, 6]}, mass: 1, inertia: 1/12, at: [i - 0.5, 0]}
  b$i: {repeat: {i: [1, 6]}, mass: 1, inertia: 1/12, at: [20, 0.5 - i]}
  c$i: {repeat: {i: [1, 2]}, mass: 1, inertia: 1/12, at: [40, 0.5 - i]}
constraints:
  A1:  {revolute: [ground, a1], at: [0, 0]}
  A$i: {repeat: {i: [2, 6]}, revolute: [a$(i-1), a$i], at: [i - 1, 0]}
  B1:  {revolute: [ground, b1], at: [20, 0]}
  B$i: {repeat: {i: [2, 6]}, revolute: [b$(i-1), b$i], at: [20, 1 - i]}
  C1:  {revolute: [ground, c1], at: [40, 0]}
  C2:  {revolute: [c1, c2], at: [40, -1]}
forces: {S: {spring: C2, stiffness: 2.0e+4}, T: {spring: B2, stiffness: SLOW}}
initial: {B1.angle: 0.3, C1.angle: 0.5, C2.angle: 0.02}
partition: {fast: [C2]}
integrate: {scheme: subcycle, step: 2.0e-4, ratio: 10, until: 1}
END
    for spring in 0 100; do
        sed "s/SLOW/$spring/" limbs.yaml >sprung.yaml
        for majors in 13 40 67; do
            H=2.0e-3 every="--every-steps 1"
            why=$(one_run sprung.yaml $majors)
            [ -z "$why" ] && ok "restart: limbs, $spring, $majors" || not_ok "restart: limbs, $spring, $majors" "$why"
        done
    done
fi

# Columns may be others: an angle of a joint that closes a loop is counted from where the state is if nobody asked before.
if wanted columns; then
    "$FMDSUB" run -q -s constraints.pin4.loop=true --until 1 --every 0.5 --columns 'pin1.angle,pin4.angle' bricard.yaml >whole 2>err
    "$FMDSUB" run -q -s constraints.pin4.loop=true --until 0.5 --columns pin1.angle --final-state half.json bricard.yaml >first 2>>err
    "$FMDSUB" run -q -s constraints.pin4.loop=true --until 1 --every 0.5 --columns 'pin1.angle,pin4.angle' -s 'initial={from: half.json, time: keep}' bricard.yaml >rest 2>>err
    expect "restart: an angle of a loop that was not asked for before" "1,$(sed -n '4s/^1,//p' whole)" "$(sed -n 3p rest)" err
fi

# What a drive too quick for the major step makes fast is chosen over the whole of the clock, not over what is left of it.
if wanted quick; then
    cat >quick.yaml <<'END'
fmdsub: 1
bodies:
  arm: {mass: 1, inertia: 1, at: [1, 0]}
  tip: {mass: 1, inertia: 0.01, at: [2, 0]}
constraints: {hub: {revolute: [ground, arm], at: [0, 0]}, leaf: {revolute: [arm, tip], at: [2, 0]}}
forces: {spring: {spring: leaf, stiffness: 100}}
drives: {turn: {drive: hub, value: 2*sin(3*t) + 0.1*sin(300*t)*exp(-(t/0.02)^2)}}
partition: {fast: [leaf]}
integrate: {scheme: subcycle, step: 1.0e-3, ratio: 10, until: 1}
END
    H=0.01 every="--every-steps 1"
    why=$(one_run quick.yaml 20)
    [ -z "$why" ] && ok "restart: quick at first" || not_ok "restart: quick at first" "$why"
    # Where even that depends on how long a run is, what is carried from step to step is not taken, and that is told.
    "$FMDSUB" run --until 0.1 --final-state half.json -s 'drives.turn.value=2*sin(3*t) + 0.1*sin(300*t)*exp(-((t - 0.2)/0.02)^2)' quick.yaml >first 2>err
    "$FMDSUB" run --until 0.2 -s 'initial={from: half.json, time: keep}' -s 'drives.turn.value=2*sin(3*t) + 0.1*sin(300*t)*exp(-((t - 0.2)/0.02)^2)' quick.yaml >rest 2>err
    expect "restart: quick later" "scheme, step or partition are others" "$(sed -n 's/.*rates alone (\(.*\)): not to the last bit one run/\1/p' err)" err
fi

# Beside contacts subcycle has a stepper of one rate inside: before it has fallen, while it bounces, and where it slides.
if wanted bounces; then
    cat >bounces.yaml <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies:
  a: {mass: 1, inertia: 0.1, at: [0, 0.05]}
  b: {mass: 1, inertia: 0.1, at: [5, 0]}
constraints:
  f: {free: [ground, a], at: [0, 0.05]}
  t: {revolute: [ground, b], at: [5, 0]}
surfaces: {floor: {plane: ground, at: [0, 0], normal: [0, 1]}, foot: {point: a}}
contacts: {c: {between: [foot, floor], restitution: 0.5, friction: 0.2}}
forces: {k: {spring: t, stiffness: 1.0e+4}, p: {spring: [[-0.5, 0.05], a], stiffness: 50}}
initial: {t.angle: 0.01, f.x_rate: 1}
partition: {fast: [t]}
integrate: {scheme: subcycle, step: 1.0e-3, ratio: 10, until: 0.4}
END
    H=0.01 every="--every-steps 1"
    for majors in 10 24 40 60; do
        why=$(one_run bounces.yaml $majors)
        [ -z "$why" ] && ok "restart: bounces, at $((majors / 2)) major steps" || not_ok "restart: bounces, at $((majors / 2)) major steps" "$why"
    done
fi

# A guard that takes steps in parts where a stop jumps remembers what it looks for.
if wanted guard; then
    cat >guard.yaml <<'END'
fmdsub: 1
gravity: [0, -9.81]
bodies:
  a: {mass: 1, inertia: 1/12, at: [0.5, 0]}
  b: {mass: 0.1, inertia: 1.0e-3, at: [1.15, 0]}
constraints:
  p: {revolute: [ground, a], at: [0, 0]}
  q: {revolute: [a, b], at: [1, 0]}
forces:
  k: {spring: q, stiffness: 3000, cubic: 1.0e+6}
  w: {unilateral: q, from: 0.05, stiffness: 1.0e+5, damping: 1}
initial: {q.angle: 0.3, p.angle_rate: 3}
integrate: {scheme: midpoint, step: 1.0e-2, guard: act, until: 1}
END
    H=0.01 every="--every-steps 1"
    for majors in 4 20 60; do
        why=$(one_run guard.yaml $majors)
        [ -z "$why" ] && ok "restart: guard, at $((majors / 2)) steps" || not_ok "restart: guard, at $((majors / 2)) steps" "$why"
    done
fi
