# stability.sh -- fmdsub stability: what it says grows, grows in a run by that much; the paper's scheme grows where its
# readers found it to, and subcycle nowhere; the linearised system is that of the deck.
. tests/tools/lib.sh
cd "$work" || exit 1

# A rider of half the cart's mass on it: coupled by mass.  M = [.5 .5; .5 1.5], K = diag(200, 1).
cat >pair.yaml <<'DECK'
fmdsub: 1
bodies:
  cart: {mass: 1, inertia: 1, at: [0, 0]}
  rider: {mass: 0.5, inertia: 1, at: [0, 0]}
constraints:
  rail: {prismatic: [ground, cart], axis: [1, 0], at: [0, 0]}
  slot: {prismatic: [cart, rider], axis: [1, 0], at: [0, 0]}
forces:
  soft: {spring: rail.displacement, stiffness: 1}
  stiff: {spring: slot.displacement, stiffness: 200}
partition: {fast: [slot]}
initial: {rail.displacement: 0.1, slot.displacement: 0.01}
integrate: {scheme: miao, step: 0.02, ratio: 10, until: 40}
output: {every: {steps: 1}, columns: [rail.displacement, slot.displacement]}
DECK

# x0 x2 - x1^2 of three records goes with radius^2 a step.
agrees() { # NAME DECK ARGUMENT...
    name=$1 deck=$2
    shift 2
    said=$("$FMDSUB" stability -q -f csv --schemes "$1" --steps "$2" --ratios "$3" "$deck" | awk -F, 'NR == 2 { print $4 }')
    "$FMDSUB" run -q --set integrate.scheme="$1" --set integrate.step="$2" --set integrate.ratio="$3" "$deck" 2>err |
        awk -F, -v said="$said" 'NR > 1 { x[NR] = $3 }
            END { a = x[NR-3] * x[NR-1] - x[NR-2]^2; b = x[NR-2] * x[NR] - x[NR-1]^2; r = sqrt(b / a)
                  printf "%.12g %.12g %.2g\n", said, r, r - said; exit !(said > 1 && r - said < 1e-6 && said - r < 1e-6) }' >out &&
        ok "stability agrees with a run: $name" || not_ok "stability agrees with a run: $name" "radius said, of the run" out err
}
agrees "miao 10:1" pair.yaml miao 0.02 10
agrees "miao 5:1" pair.yaml miao 0.02 5
sed 's/until: 40/until: 4/' pair.yaml >short.yaml
sed 's/until: 40/until: 16/' pair.yaml >middle.yaml
agrees "miao 20:1" middle.yaml miao 0.004 20
agrees "rk4 beyond its limit" short.yaml rk4 0.2 1

# Two rates are looked at by 2, 5, 10 and 20, and at the deck's own ratio, each once.
for own in '1 2 5 10 20' '2 2 5 10 20' '7 2 5 7 10 20' '10 2 5 10 20' '30 2 5 10 20 30'; do
    "$FMDSUB" stability -q -f csv -s integrate.ratio="${own%% *}" pair.yaml >out 2>err
    expect "stability: ratios where the deck has ${own%% *}" "${own#* }" \
        "$(awk -F, '$1 == "subcycle" { print $2 }' out | sort -nu | tr '\n' ' ' | sed 's/ $//')" out err
done

# Every scheme, on an oscillator, a beam, a loop and in space: what a step leaves of what moves longest, beside the ratio of
# the last records, of a real root with `one`.
leaves() { # DECK COLUMN one|pair SCHEME STEP RATIO MAJORS [SETTING...]
    deck=$1 column=$2 root=$3 scheme=$4 step=$5 ratio=$6 majors=$7
    shift 7
    said=$("$FMDSUB" stability -q -f csv "$@" -s integrate.scheme=$scheme --schemes $scheme --steps $step --ratios $ratio $deck.yaml 2>err | awk -F, 'NR == 2 { print $4 }')
    "$FMDSUB" run -q "$@" -s integrate.scheme=$scheme -s integrate.step=$step -s integrate.ratio=$ratio \
        --until "$(awk "BEGIN { printf \"%.12g\", $step * $ratio * $majors }")" $deck.yaml 2>>err |
        awk -F, -v said="$said" -v c=$column -v root=$root 'NR > 1 { x[NR] = $c }
            END { a = x[NR-3] * x[NR-1] - x[NR-2]^2; b = x[NR-2] * x[NR] - x[NR-1]^2; r = root == "one" ? x[NR] / x[NR-1] : sqrt(b / a); if (r < 0) r = -r
                  printf "%.12g %.12g %.2g\n", said, r, r - said; exit !(NR > 5 && said > 0 && r - said < 1e-6 && said - r < 1e-6) }' >out &&
        ok "stability, $deck: $scheme $step $ratio:1 $*" || not_ok "stability, $deck: $scheme $step $ratio:1 $*" "radius said, of the run" out err
}
cat >osc.yaml <<'DECK'
fmdsub: 1
bodies: {a: {mass: 2, inertia: 1, at: [0, 0]}}
constraints: {j: {prismatic: [ground, a], axis: [1, 0], at: [0, 0]}}
forces: {s: {spring: j.displacement, stiffness: 200}}
partition: {fast: [j]}
initial: {j.displacement: 0.1}
integrate: {scheme: midpoint, step: 0.3, until: 12}
output: {every: {steps: 1}, columns: [j.displacement]}
DECK
cat >beam.yaml <<'DECK'
fmdsub: 1
bodies:
  arm:
    beam: {from: [0, 0], to: [1, 0], elements: 8}
    section: {rectangle: [0.02, 0.01]}
    material: steel
    modes: 2
    damping: {beta: 1.0e-4}
constraints: {root: {fixed: [ground, arm], at: [0, 0]}}
initial: {arm.mode1: 1.0e-7, arm.mode2: 1.0e-7}
integrate: {scheme: midpoint, step: 1.0e-3, until: 0.3}
output: {every: {steps: 1}, columns: [arm.mode1, arm.mode2]}
DECK
cat >loop.yaml <<'DECK'
fmdsub: 1
bodies:
  a: {mass: 1, inertia: 0.1, at: [0, 0.5]}
  b: {mass: 1, inertia: 0.2, at: [1, 1]}
  c: {mass: 1, inertia: 0.1, at: [2, 0.75]}
constraints:
  A: {revolute: [ground, a], at: [0, 0]}
  B: {revolute: [a, b], at: [0, 1]}
  C: {revolute: [b, c], at: [2, 1.4]}
  D: {revolute: [ground, c], at: [2, 0]}
forces: {s: {spring: A.angle, stiffness: 500}, d: {damper: A.angle, damping: 1}}
initial: {A.angle_rate: 1.0e-7}
integrate: {scheme: midpoint, step: 1.0e-2, until: 1}
output: {every: {steps: 1}, columns: [A.angle]}
DECK
cat >space.yaml <<'DECK'
fmdsub: 1
space: 3d
bodies: {a: {mass: 1, inertia: [0.1, 0.2, 0.25], at: [1, 0, 0]}, b: {mass: 0.5, inertia: [0.1, 0.1, 0.15], at: [2, 0.3, 0.2]}}
constraints: {A: {revolute: [ground, a], at: [0, 0, 0], axis: [0, 1, 1]}, B: {revolute: [a, b], at: [1.5, 0, 0], axis: [1, 0, 1]}}
forces: {s: {spring: A.angle, stiffness: 100}, t: {spring: B.angle, stiffness: 500}, d: {damper: B.angle, damping: 5}, e: {damper: A.angle, damping: 0.02}}
partition: {fast: [B]}
initial: {A.angle_rate: 1.0e-7, B.angle_rate: 1.0e-7}
integrate: {scheme: midpoint, step: 1.0e-2, until: 1}
output: {every: {steps: 1}, columns: [B.angle]}
DECK
# A loop with a beam in it, whose modes are fast; the crank's swing outlasts them.
cat >flexloop.yaml <<'DECK'
fmdsub: 1
bodies:
  a: {mass: 1, inertia: 0.1, at: [0, 0.5]}
  arm:
    beam: {from: [0, 1], to: [2, 1.4], elements: 6}
    section: {rectangle: [0.02, 0.01]}
    material: steel
    modes: 1
    damping: {beta: 3.0e-3}
  c: {mass: 1, inertia: 0.1, at: [2, 0.75]}
constraints:
  A: {revolute: [ground, a], at: [0, 0]}
  B: {revolute: [a, arm], at: [0, 1]}
  C: {revolute: [arm, c], at: [2, 1.4]}
  D: {revolute: [ground, c], at: [2, 0]}
forces: {s: {spring: A.angle, stiffness: 500}, d: {damper: A.angle, damping: 0.2}}
partition: {fast: [arm]}
initial: {A.angle_rate: 1.0e-7}
integrate: {scheme: midpoint, step: 1.0e-2, until: 1}
output: {every: {steps: 1}, columns: [A.angle]}
DECK
for scheme in midpoint newmark generalized-alpha hht subcycle; do
    leaves osc 2 pair $scheme 0.3 1 40
    leaves osc 2 pair $scheme 0.3 1 13 -s integrate.rho_infinity=0.7
done
leaves osc 2 pair newmark 0.3 1 40 -s integrate.gamma=0.7 -s integrate.beta=0.4
leaves osc 2 pair rk4 0.3 1 10
leaves osc 2 pair miao 0.3 1 10
leaves osc 2 one daniel 0.3 1 10
leaves osc 2 one neal-belytschko 0.3 1 10
for scheme in midpoint newmark hht rk4; do # generalized-alpha undamped has a root -1 of its own, which no run shows
    leaves beam 2 pair $scheme 2.0e-3 1 100
    leaves loop 2 pair $scheme 0.1 1 40
    leaves space 2 pair $scheme 0.01 1 250
done
leaves space 2 pair generalized-alpha 0.01 1 250 -s integrate.rho_infinity=0.6
for scheme in subcycle miao daniel neal-belytschko; do
    leaves beam 2 pair $scheme 2.0e-4 5 130
    leaves loop 2 pair $scheme 0.02 5 30
    leaves space 2 pair $scheme 2.0e-3 5 260
done
leaves beam 3 pair rk4 9.2e-3 1 10
for scheme in midpoint newmark hht; do leaves flexloop 2 pair $scheme 0.02 1 400; done
for scheme in subcycle miao; do leaves flexloop 2 pair $scheme 4.0e-3 5 400; done
leaves flexloop 2 pair subcycle 2.0e-3 10 400
leaves flexloop 2 pair subcycle 4.0e-3 5 400 -s integrate.rho_infinity=0.5

"$FMDSUB" stability pair.yaml >out 2>err
rc=$?
expect "stability: schemes that grow" "0 4" "$rc $(awk -F, '/unstable/ { n[$1]++ } END { for (i in n) c++; print c }' out)" out
expect "stability: subcycle, midpoint and newmark at no step" "yes 0" "$(grep -q '^subcycle.*stable' out && echo yes) $(grep -c -e '^subcycle.*unstable' -e '^midpoint.*unstable' -e '^newmark.*unstable' out)" out
expect "stability: a sentence" 1 "$(grep -c '^miao 10:1 grows at .* of the fast and .* of the slow coordinates, where .slot.displacement. moves most' err)" err
"$FMDSUB" stability -q -f json --schemes midpoint --steps 0.1 pair.yaml >out 2>err
expect "stability: M, K and the columns' rows" "0 1 1 2" "$? $(grep -c '"M":\[\[0.5,0.5\],\[0.5,1.5\]\]' out) $(grep -c '"K":\[\[\(200\|199.999999\)' out) $(grep -o '"name":"[a-z]*.displacement","unit":"m"' out | wc -l)" out err

# Values of columns and their slopes, by coordinates slot, rail and by their rates: the rider is at the sum of both, 200 * 0.01 and
# 1 * 0.1 N are what the springs pull with.
"$FMDSUB" stability -q -f json --schemes midpoint --steps 0.1 -s 'output.columns=[rider.x, energy.elastic, rail.displacement_rate]' pair.yaml 2>err |
    sed 's/.*"columns"://; s/"rows".*//' | tr '{' '\n' | sed -n '/^"name":"[re]/ { s/"[a-z_]*"://g; s/[]"}[]/ /g; s/,/ /g; p; }' >out
expect "stability: columns and their slopes" "rider.x ok energy.elastic ok rail.displacement_rate ok" "$(echo $(awk '
    BEGIN { split("0.11 1 1 0 0", want1); split("0.015 2 0.1 0 0", want2); split("0 0 0 0 1", want3) }
    { good = NF == 7
      for (k = 1; k <= 5; k++) { d = $(k + 2) - (NR == 1 ? want1[k] : NR == 2 ? want2[k] : want3[k]); if (d > 1e-6 || d < -1e-6) good = 0 }
      print $1, good ? "ok" : "off" }' out))" out err

# Where it moves they are those of the motion: a pendulum of 1 m and 1 kg on its way, vx = -w y, vy = w x, T = w^2/2.
"$FMDSUB" stability -q -f json --at 0.3 --schemes newmark --steps 0.01 -s 'output.columns=[pin.angle, pin.angle_rate, ball.x, ball.vx, energy.kinetic]' \
    "$ROOT/decks/pendulum.yaml" 2>err | sed 's/.*"columns"://; s/"rows".*//' | tr '{' '\n' | sed -n '/^"name":"[bpe]/ { s/"[a-z_]*"://g; s/[]"}[]/ /g; s/,/ /g; p; }' >out
"$FMDSUB" run -q --until 0.3 --every 0.3 -s 'output.columns=[ball.x, ball.vx, ball.y, ball.vy, energy.kinetic]' "$ROOT/decks/pendulum.yaml" 2>>err | tail -n 1 | tr , ' ' >last
expect "stability: columns of what moves" "ball.x ok ball.vx ok energy.kinetic ok" "$(echo $(awk '
    function near(a, b) { return a - b < 1e-6 && b - a < 1e-6 }
    NR == FNR { x = $2; vx = $3; y = $4; vy = $5; T = $6; next }
    $1 == "pin.angle_rate" { w = $3 }
    $1 == "ball.x" { print $1, near($3, x) && near($4, -y) && near($5, 0) ? "ok" : "off: " $0 }
    $1 == "ball.vx" { print $1, near($3, vx) && near($4, -vy) && near($5, -y) ? "ok" : "off: " $0 }
    $1 == "energy.kinetic" { print $1, near($3, T) && near($4, 0) && near($5, 2 * T / w) ? "ok" : "off: " $0 }' last out))" out last err

# Its rows are those of the table, number by number; where nothing can be known there is null.
"$FMDSUB" stability -q -f csv --steps 0.01,0.1 pair.yaml >table 2>err
"$FMDSUB" stability -q -f json --steps 0.01,0.1 pair.yaml >out 2>>err
sed 's/.*"rows"://' out | tr '{' '\n' | sed -n '/^"scheme"/ { s/"[a-z]*"://g; s/[]"}[]//g; s/null//g; s/,*$//; p; }' >rows
{ head -n 1 table; cat rows; } >whole
same "stability: rows of the object and of the table" table whole
expect "stability: which coordinates, at which time" '{"t":0,"coordinates":[{"name":"slot.displacement","fast":true},{"name":"rail.displacement","fast":false}]' \
    "$(sed 's/,"M".*//' out)" out

"$FMDSUB" stability -q -f csv --schemes midpoint,subcycle --ratios 1,5 --steps 0.01 pair.yaml >out 2>err
expect "stability: midpoint, which is subcycle at ratio 1, once" "midpoint,1 subcycle,5" "$(sed 1d out | cut -d , -f 1,2 | tr '\n' ' ' | sed 's/ $//')" out err

# The motion's own growth is no fault of a scheme's.
"$FMDSUB" stability --schemes midpoint,newmark,subcycle --at 0.01 --steps 0.001,0.01,1 "$ROOT/decks/heavy-top.yaml" >out 2>err
expect "stability: a motion that grows itself" "0 0 8 1" "$? $(grep -c unstable out) $(grep -c coarse out) $(grep -c '^the motion itself grows here' err)" out err

# Decks of all kinds: loops, flexible bodies, drives; nothing that keeps energy grows.
for deck in four-bar andrews flexible-crank flexible-robot heavy-top rotor suspension; do
    "$FMDSUB" stability -q -f csv --at 0.01 --schemes midpoint,newmark,subcycle "$ROOT/decks/$deck.yaml" >out 2>err
    rc=$?
    expect "stability $deck" "0 yes 0 0" "$rc $([ "$(grep -c ',stable$' out)" -gt 9 ] && echo yes) $(grep -c unstable out) $(grep -c 'no step' out)" err out
done

"$FMDSUB" stability --schemes dopri5 pair.yaml >out 2>err
expect "stability: a scheme that chooses its steps" "2 1" "$? $(grep -c 'chooses its own steps' err)" err
"$FMDSUB" stability -f ndjson pair.yaml >out 2>err
expect "stability: no ndjson" 2 $? err
"$FMDSUB" stability --plot s.svg --script -q pair.yaml >out 2>err
expect "stability --script" "0 21" "$? $(grep -c '^.line[0-9]* <<' out)" err

# Of more coordinates fewer steps are tried, of too many none; what grows is named by the frequency of what is fast.
for links in '12 62' '16 26' '41 14'; do
    "$FMDSUB" stability -q --schemes rk4 -s parameters.N=${links% *} "$ROOT/decks/chain.yaml" >out 2>err
    expect "stability of ${links% *} links: status, steps" "0 ${links#* }" "$? $(awk -F, 'NR > 1 { print $3 }' out | sort -u | wc -l)" err
done
refuse 7 "stability of more than 100 freedoms: this deck has 101" stability -s parameters.N=101 "$ROOT/decks/chain.yaml"
"$FMDSUB" stability --schemes rk4 --steps 0.5 "$ROOT/decks/bar-slider.yaml" >out 2>err
expect "what is fast grows: words" 1 "$(grep -c "^rk4 grows at 1 of 1 steps, .*, omega h = 7.1 of the fast coordinates, where 'guide.displacement' moves most at" err)" err

# Steps that are all too long: the motion grows too far in each to tell anything of a scheme.  One that is not tells.
cat >upright.yaml <<'DECK'
fmdsub: 1
gravity: [0, -9.81]
bodies: {rod: {mass: 1, inertia: 0.1, at: [0, 1]}}
constraints: {p: {revolute: [ground, rod], at: [0, 0]}}
integrate: {scheme: midpoint, step: 0.01, until: 1}
DECK
"$FMDSUB" stability --schemes midpoint,rk4 --steps 1,2,4 upright.yaml >out 2>err
expect "too long steps: nothing is resolved, no stability is told" "1 0" \
    "$(cat out err | grep -c 'nothing is resolved by any step that was tried: midpoint, rk4; take shorter ones') $(cat out err | grep -c 'no growth')" out err
"$FMDSUB" stability --schemes midpoint,rk4 --steps 0.001,2,4 upright.yaml >out 2>err
expect "one that is not: told" "0 1" "$(cat out err | grep -c 'nothing is resolved') $(cat out err | grep -c 'no growth at any step that was tried: midpoint, rk4')" out err
