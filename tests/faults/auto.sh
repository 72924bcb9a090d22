# auto.sh -- scheme: auto and partition: auto: what is taken, that it is told, and that it is that run.
. tests/tools/lib.sh

# open DECK: without its partition, scheme and steps.
open() {
    sed -e '/^partition:/d' -e "s/^integrate: {.*until: \([0-9.e+-]*\)}/integrate: {tolerance: 1.0e-3, until: \1}/" "$1"
}
taken() { # of the plan on stderr
    sed -n 's/^auto: \(.*\) takes the least.*$/\1/p; s/^auto: \(.*\), foretold.*too short.*$/\1, short/p' "$1" | head -n 1
}

open decks/satellite-instrument.yaml >"$work/open.yaml"
timeout 60 "$FMDSUB" run "$work/open.yaml" >"$work/first" 2>"$work/err"
ended "auto: a satellite and its instrument" 0 $? "$work/first" "$work/err"
expect "auto: finds what its deck calls fast, for steps of order 4" "subcycle of order 4, 2 of 105 freedoms fast (slide gimbal)" \
    "$(taken "$work/err" | sed 's/ h = .* h,/,/')" "$work/err"
timeout 60 "$FMDSUB" run -q "$work/open.yaml" >"$work/second" 2>"$work/err"
same "auto: the same bytes again" "$work/first" "$work/second"
timeout 60 "$FMDSUB" run -q -f ndjson "$work/open.yaml" 2>"$work/err" | head -n 1 >"$work/head"
expect "auto: the head of the records says so" 1 "$(grep -c '"auto":"subcycle of order 4 h = .*, 2 of 105' "$work/head")" "$work/head"
steps=$(sed -n 's/.*"step":\([0-9.e-]*\),"ratio":\([0-9]*\),.*/step: \1, ratio: \2/p' "$work/head")
sed -e "s/^integrate: {tolerance: [0-9.e-]*/integrate: {scheme: subcycle, order: 4, $steps/" "$work/open.yaml" >"$work/named.yaml"
echo 'partition: {fast: [slide, gimbal]}' >>"$work/named.yaml"
timeout 60 "$FMDSUB" run -q "$work/named.yaml" >"$work/second" 2>"$work/err"
same "auto: the same bytes as by name" "$work/first" "$work/second"
timeout 60 "$FMDSUB" check "$work/open.yaml" >"$work/words" 2>"$work/err"
expect "auto: check says so" 1 "$(grep -c '^auto: subcycle of order 4 h = ' "$work/words")" "$work/words"

# Trials are a small part of the run, by the counts in the same line.
sed -n 's/^auto: .*foretold \([0-9.e+]*\) evaluations.*trial runs of \([0-9.e+]*\)$/\1 \2/p' "$work/words" >"$work/counts"
expect "auto: trials are a small part" fine "$(awk '$2 < .1 * $1 { print "fine" }' "$work/counts")" "$work/words"

# A very short run is by dopri5, byte for byte, and without trials; what the look has taken is told.
sed -e 's/^integrate: .*/integrate: {until: 0.1}/' decks/four-bar.yaml >"$work/open.yaml"
"$FMDSUB" run "$work/open.yaml" >"$work/first" 2>"$work/err"
expect "auto: a short run" "dopri5 to tolerance 0.0001, short" "$(taken "$work/err")" "$work/err"
expect "auto: a short run, its look" fine "$(awk '/^auto: .*, after a look of / { n = $0; sub(/.* look of /, "", n); print((n + 0 > 10 && n + 0 <= 120) ? "fine" : n) }' "$work/err")" "$work/err"
"$FMDSUB" run -q --set 'integrate={scheme: dopri5, tolerance: 1.0e-4, until: 0.1}' decks/four-bar.yaml >"$work/second" 2>"$work/err"
same "auto: the same bytes as by dopri5" "$work/first" "$work/second"

# With a step alone: that is the minor step, and a ratio is the largest one.
for cap in '' 10; do
    timeout 60 "$FMDSUB" run -o "$work/first" --set integrate.scheme=auto --set partition=auto ${cap:+--set integrate.ratio=$cap} \
        decks/satellite-instrument.yaml 2>"$work/err"
    case $cap in
    '') expect "auto: a step" "subcycle h = 0.0002 s, H = 100 h, 2 of 105 freedoms fast (slide gimbal)" "$(taken "$work/err")" "$work/err" ;;
    *) expect "auto: a step and a ratio" "subcycle h = 0.0002 s, H = 10 h, 2 of 105 freedoms fast (slide gimbal)" "$(taken "$work/err")" "$work/err" ;;
    esac
done

# One rate at that step has no ratio to tell.
"$FMDSUB" run -o "$work/first" --set integrate.scheme=newmark --set partition=auto decks/four-bar.yaml 2>"$work/err"
expect "auto: a step, one rate" "newmark h = 0.001 s, short" "$(taken "$work/err")" "$work/err"

# A scheme by name keeps it: only the partition is open.
timeout 60 "$FMDSUB" run -o "$work/first" --set partition=auto decks/satellite-instrument.yaml 2>"$work/err"
expect "partition: auto, under a scheme by name" "subcycle h = 0.0002 s, H = 100 h, 2 of 105 freedoms fast (slide gimbal)" \
    "$(taken "$work/err")" "$work/err"

# What a scheme by name does not take beside `partition: auto` is refused as without.
for scheme in dopri5 dop853 radau5 radau9; do
    for verb in run check; do
        "$FMDSUB" $verb --set integrate.scheme=$scheme --set partition=auto decks/governor.yaml >"$work/first" 2>"$work/err"
        expect "partition: auto, $verb, $scheme by a step" "3 E-missing-key" "$? $(grep -o 'E-missing-key' "$work/err")" "$work/err"
    done
done

# Nor does what stands for `scheme: auto` take all keys.
"$FMDSUB" check --set integrate.scheme=auto --set integrate.order=4 --set integrate.rho_infinity=0 decks/slider-crank.yaml >"$work/first" 2>"$work/err"
expect "auto: order 4 that damps" "3 E-order" "$? $(grep -o 'E-order' "$work/err")" "$work/err"

# Rigid contacts leave no choice.
"$FMDSUB" run -o "$work/first" --until 0.1 --set integrate.scheme=auto decks/bounce-and-roll.yaml 2>"$work/err"
expect "auto: rigid contacts" "auto: midpoint, which takes rigid contacts" "$(grep '^auto' "$work/err")" "$work/err"

# What is asked for besides is refused as ever.
"$FMDSUB" run -q --set integrate.scheme=automatic decks/four-bar.yaml >"$work/first" 2>"$work/err"
expect "auto: no other word" "3 E-unknown-scheme" "$? $(grep -o 'E-unknown-scheme' "$work/err")" "$work/err"

# Stiff parts at rest keep an explicit scheme's steps short for nothing; and what is tried is little beside what is taken.
# work DECK ARGUMENT...: evaluations of a run, and what the plan line says was tried.
work() {
    timeout 60 "$FMDSUB" run --stats="$work/stats" --set integrate.tolerance=1.0e-4 "$@" >"$work/first" 2>"$work/err"
    awk '$1 == "slow_evaluations" { print $2 }' "$work/stats"
}
most() { # whose steps are nearly all of a relay's
    sed -n 's/^auto: \([0-9]*\) steps* by dopri5, \([0-9]*\) steps* by dop853, \([0-9]*\) steps* by radau9.*/\1 dopri5 \2 dop853 \3 radau9/p' "$work/err" |
        awk '{ for (i = 1; i < NF; i += 2) if ($i > 0.9 * ($1 + $3 + $5)) print $(i + 1) }'
}
for deck in spin-up-segments spin-up rotor; do
    got=$(work --set integrate.scheme=auto --set integrate.tolerance=3.0e-5 "decks/$deck.yaml")
    tried=$(sed -n 's/^auto: .*trial runs of \([0-9.e+]*\)$/\1/p' "$work/err")
    expect "auto: $deck, stiff" "radau9" "$(most)" "$work/err"
    expect "auto: $deck, work" fine "$(awk -v all="$got" -v tried="${tried:-0}" 'BEGIN { print((all > 700 && tried < .25 * all) ? "fine" : all " " tried) }')" "$work/err"
done

# A run that is not very short is a relay: its work is that of the best of its schemes by itself, or little more, whether
# that is order 5 (four-bar, quick-return), order 8 (governor, bricard), or the implicit one, where what is stiff is at rest
# (effect-stiffening), goes on (effect-modes) or dies away (excavator, screw-actuator).  Where forces bend by the state order 8 takes no
# part (suspension, buffer); a look at the implicit one is dear where touches end its steps (buffer).
for deck in decks/four-bar decks/quick-return decks/suspension decks/governor decks/bricard decks/driven-telescope decks/effect-stiffening \
    decks/effect-modes decks/screw-actuator decks/geared-pendulum decks/telescope tests/decks-by-users/excavator tests/trust/buffer; do
    case $deck in *suspension | *buffer) of='dopri5 and radau9' ;; *) of='dopri5, dop853 and radau9' ;; esac
    case $deck in *buffer) more=1.4 ;; *) more=1.25 ;; esac
    best=$(for scheme in dopri5 dop853 radau9; do work --set integrate.scheme=$scheme $deck.yaml; done | sort -g | head -n 1)
    got=$(work --set integrate.scheme=auto $deck.yaml)
    expect "auto: a relay, ${deck##*/}" "a relay of $of to tolerance 0.0001" "$(taken "$work/err" | sed 's/, short//')" "$work/err"
    expect "auto: as little work as by one of them, ${deck##*/}" fine "$(awk -v all="$got" -v best="$best" -v more=$more 'BEGIN { print((best > 100 && all <= more * best) ? "fine" : all " " best) }')" "$work/err"
done

# The implicit one, which begins, is back as soon as an explicit one that a start has favoured comes to its bound.
best=$(work --set integrate.scheme=radau9 tests/decks/order-four-damper.yaml)
got=$(work --set integrate.scheme=auto tests/decks/order-four-damper.yaml)
expect "auto: a start that is no measure" fine "$(awk -v all="$got" -v best="$best" 'BEGIN { print((best > 100 && all <= 2 * best) ? "fine" : all " " best) }')" "$work/err"

# The words say what has decided.
timeout 60 "$FMDSUB" run --set integrate.scheme=auto --set integrate.tolerance=1.0e-5 decks/light-hub.yaml \
    >/dev/null 2>"$work/err"
sed -n 's/^auto: .* \(takes the least work\|is taken\), foretold \([0-9.e+-]*\) evaluations, the next [^:;]* \([0-9.e+-]*\)\([:;]\).*/\1,\2,\3,\4/p' \
    "$work/err" >"$work/words"
expect "auto: what has decided" fine "$(awk -F , '{ least = $2 <= $3; print (least ? $1 == "takes the least work" && $4 == ";" : $1 == "is taken" && $4 == ":") ? "fine" : $0 }' "$work/words")" "$work/err"

# A step alone stands for the error that the midpoint rule makes with it: what is taken is no worse, from rest, too.
error() { # of records in A against those in B: the largest, of a column's range
    paste -d , "$1" "$2" | awk -F , 'NR == 1 { n = NF / 2; next }
        { for (i = 2; i <= n; i++) { d = $i - $(i + n); if (d < 0) d = -d; if (d > off[i]) off[i] = d
            if (NR == 2 || $(i + n) > high[i]) high[i] = $(i + n); if (NR == 2 || $(i + n) < low[i]) low[i] = $(i + n) } }
        END { for (i = 2; i < n; i++) if (high[i] > low[i] && off[i] / (high[i] - low[i]) > worst) worst = off[i] / (high[i] - low[i])
            print(NR > 15 ? worst : "no records") }'
}
"$FMDSUB" run -q -o "$work/exact" --set 'integrate={scheme: dop853, tolerance: 1.0e-10, until: 2}' decks/spring-pendulum.yaml 2>"$work/err"
"$FMDSUB" run -q -o "$work/first" --set 'integrate={scheme: auto, step: 2.0e-4, until: 2}' decks/spring-pendulum.yaml 2>>"$work/err"
"$FMDSUB" run -q -o "$work/second" --set 'integrate={scheme: midpoint, step: 2.0e-4, until: 2}' decks/spring-pendulum.yaml 2>>"$work/err"
auto=$(error "$work/first" "$work/exact") rule=$(error "$work/second" "$work/exact")
expect "auto: as good as the midpoint rule by that step" fine "$(awk -v a="$auto" -v b="$rule" 'BEGIN { print((a > 0 && b > 0 && a <= 1.05 * b) ? "fine" : a " " b) }')" "$work/err"

# Keys that mean nothing to what was taken.
for key in beta=0.3 gamma=0.6 order=4 ratio=5 symmetric=true; do
    "$FMDSUB" run -q --set integrate.scheme=auto --set integrate.tolerance=1.0e-4 --set integrate.$key --until 0.1 decks/four-bar.yaml >"$work/first" 2>"$work/err"
    expect "auto: ${key%=*} means nothing" 1 "$(grep -c "'${key%=*}' means nothing to scheme dopri5, which 'auto' has taken" "$work/err")" "$work/err"
done
"$FMDSUB" run -q --set integrate.scheme=auto --set integrate.tolerance=1.0e-4 decks/four-bar.yaml >"$work/first" 2>"$work/err"
expect "auto: a tolerance means something" "records 0" "$([ -s "$work/first" ] && echo records) $(wc -l <"$work/err" | tr -d ' ')" "$work/err"

# A scheme by name that is dear says so.
"$FMDSUB" check --set integrate.scheme=subcycle --set partition=auto --set integrate.tolerance=1.0e-4 decks/telescope.yaml >"$work/words" 2>"$work/err"
expect "auto: a scheme by name that is dear" 1 "$(grep -c "^auto: subcycle .*; dopri5 would take about [0-9.e+]*: 'scheme: auto' chooses among all" "$work/words")" "$work/words"

# Two rates of order 4, by steps that are tested against their halves: the error is below the tolerance.
timeout 60 "$FMDSUB" run -o "$work/first" --set integrate.scheme=auto --set integrate.tolerance=1.0e-4 tests/bench/small-fast.yaml 2>"$work/err"
expect "auto: order 4" 1 "$(grep -c '^auto: subcycle of order 4 h = .*4 of 164 freedoms fast' "$work/err")" "$work/err"
timeout 60 "$FMDSUB" run -q -o "$work/second" --set integrate.scheme=dop853 --set integrate.tolerance=1.0e-7 tests/bench/small-fast.yaml 2>"$work/err"
expect "auto: order 4, error" fine "$(paste -d , "$work/first" "$work/second" | awk -F , 'NR > 1 { n = NF / 2
    for (i = 2; i <= n; i++) { d = $i - $(i + n); if (d < 0) d = -d; if (d > worst) worst = d } rows++ }
    END { print((rows > 5 && worst < 1e-4) ? "fine" : rows " " worst) }')" "$work/err"

# A motor whose voltage is switched 500 times a second: no steps are chosen once that would go over that, and trials stay few.
cat >"$work/chopped.yaml" <<'END'
fmdsub: 1
bodies:
  rotor: {mass: 0.2, inertia: 2.0e-5, at: [0, 0]}
  load:  {mass: 3, inertia: 0.02, at: [0, 0]}
constraints:
  shaft: {revolute: [ground, rotor], at: [0, 0]}
  out:   {revolute: [ground, load], at: [0, 0]}
states:
  i: {rate: "(if(mod(t, 0.002) < 0.002*(0.3 + 0.2*sin(6*t)), 24, 0) - 0.5*i - 0.03*shaft.angle_rate)/0.001"}
forces:
  motor: {torque: shaft, value: 0.03*i}
  gear:  {torque: shaft, value: "-40*(shaft.angle/50 - out.angle)/50 - 0.02*(shaft.angle_rate/50 - out.angle_rate)/50"}
  gear2: {torque: out, value: "40*(shaft.angle/50 - out.angle) + 0.02*(shaft.angle_rate/50 - out.angle_rate)"}
  drag:  {damper: out, damping: 0.2}
integrate: {tolerance: 1.0e-3, until: 1}
output: {every: 0.01, columns: [shaft.angle_rate, out.angle, i]}
END
"$FMDSUB" run -o "$work/first" "$work/chopped.yaml" 2>"$work/err"
expect "auto: a switched motor" "1 few" "$(grep -c '^auto: a relay of ' "$work/err") $(
    sed -n 's/^auto: .*trial runs of \([0-9.e+]*\)$/\1/p' "$work/err" | awk '{ print($1 < 1e4 ? "few" : $1) }')" "$work/err"
"$FMDSUB" run -q -o "$work/second" --set 'integrate={scheme: dop853, tolerance: 1.0e-7, until: 1}' "$work/chopped.yaml" 2>"$work/err"
expect "auto: a switched motor, error" fine "$(error "$work/first" "$work/second" | awk '{ print($1 > 0 && $1 < 5e-3 ? "fine" : $1) }')" "$work/err"
