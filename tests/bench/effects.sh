# effects.sh -- what effects cost that a scene does not call for, in instructions by callgrind: the same number every time.
#
# Each limit that is passed fails.  A count is the difference of two runs over the steps between them.  With UPDATE=1 the counts
# become the reference in tests/bench/effects/counts, against which a scene may grow by one in a hundred.
. tests/tools/lib.sh
command -v valgrind >/dev/null || { skip effects "valgrind is not installed"; exit 0; }
scenes=tests/bench/effects
FROM=120 TO=520 # steps between which a step is counted
counts=$scenes/counts

collected() { # FUNCTIONS COMMAND...: instructions; each function with its own into the file
    to=$1
    shift
    valgrind --tool=callgrind --compress-strings=no --compress-pos=no --callgrind-out-file="$work/cg" "$@" >/dev/null 2>"$work/err"
    awk '/^fn=/ { fn = substr($0, 4); next } /^calls=/ { getline; next } /^[0-9]/ { own[fn] += $2 }
        END { for (fn in own) print fn, own[fn] }' "$work/cg" | sort >"$to"
    awk '/Collected/ { print $NF }' "$work/err"
}

of_run() { # FUNCTIONS DECK UNTIL [ARGUMENT...]
    fns=$1 deck=$2 until=$3
    shift 3
    collected "$fns" "$FMDSUB" run -q --every-steps 100000000 --until "$until" "$@" "$deck"
}

step() { # NAME DECK H [ARGUMENT...]: of a step, into $work/NAME
    name=$1 deck=$2 h=$3
    shift 3
    a=$(of_run "$work/fn" "$deck" "$(awk -v h="$h" -v n="$FROM" 'BEGIN { printf "%.12g", n * h }')" "$@")
    b=$(of_run "$work/$name.fn" "$deck" "$(awk -v h="$h" -v n="$TO" 'BEGIN { printf "%.12g", n * h }')" "$@")
    awk -v a="$a" -v b="$b" -v n=$((TO - FROM)) 'BEGIN { printf "%.0f\n", (b - a) / n }' >"$work/$name"
    awk 'NR == FNR { was[$1] = $2; next } $2 > was[$1] { sub(/\.(constprop|isra|part|lto_priv).*/, "", $1); print $1 }' "$work/fn" "$work/$name.fn" |
        sort -u >"$work/$name.stepped"
    printf '%-28s %8s\n' "$name" "$(cat "$work/$name")"
}

at_most() { # WHAT VALUE LIMIT
    if awk -v x="$2" -v most="$3" 'BEGIN { exit !(x > 0 && x <= most) }'; then ok "$1: $2, at most $3"
    else not_ok "$1" "$2 is more than $3"; fi
}

# wanted WHAT VALUE WANTED LIMIT: a goal that is not met yet, and may not get further off.
wanted() {
    if awk -v x="$2" -v most="$3" 'BEGIN { exit !(x > most) }' && awk -v x="$2" -v most="$4" 'BEGIN { exit !(x <= most) }'; then
        known "$1" "$2, wanted $3"
    else at_most "$1" "$2" "$3"; fi
}

ratio() { awk -v a="$(cat "$work/$1")" -v b="$(cat "$work/$2")" 'BEGIN { printf "%.4f", a / b }'; }

for twin in pend chain fourbar; do
    step $twin-plane $scenes/$twin-plane.yaml 1.0e-3 --columns "t,$(sed -n 's/.*columns: \[\([a-z0-9.]*\).*/\1/p' $scenes/$twin-plane.yaml)"
    step $twin-space $scenes/$twin-space.yaml 1.0e-3 --columns "t,$(sed -n 's/.*columns: \[\([a-z0-9.]*\).*/\1/p' $scenes/$twin-space.yaml)"
    at_most "$twin: space that is planar, of the plane" "$(ratio $twin-space $twin-plane)" 1.02
done
step pend-ledger $scenes/pend-plane.yaml 1.0e-3 --columns t,pin.angle --set effects.ledger=true
at_most "energies, of a pendulum's step" \
    "$(awk -v a="$(cat "$work/pend-plane")" -v b="$(cat "$work/pend-ledger")" 'BEGIN { printf "%.4f", (b - a) / 7 / a }')" .03
at_most "a pendulum's step" "$(cat "$work/pend-plane")" 2600
step satellite decks/floating-satellite.yaml 2.0e-3 --columns t,float.omega_x
at_most "a satellite's step without momenta" "$(cat "$work/satellite")" 50924
step heavy-top decks/heavy-top.yaml 1.0e-4 --columns t
step crank-plane $scenes/crank-plane.yaml 2.0e-5 --columns t
step crank-space $scenes/crank-space.yaml 2.0e-5 --columns t
step crank-twin $scenes/crank-plane.yaml 2.0e-5 --columns t --set parameters.n=2 # the same modes in the plane
at_most "crank: space that is planar, of the plane" "$(ratio crank-space crank-twin)" 1.02

# What is off executes no instruction in a step: functions by the objects that define them and no other does.
defined() { nm "$@" 2>/dev/null | awk '$2 ~ /^[tT]$/ { sub(/\.(constprop|isra|part|lto_priv).*/, "", $3); print $3 }' | sort -u; }
of_objects() { # FILE OBJECT...: functions that these define alone
    to=$1
    shift
    defined "$@" >"$work/these"
    ls "$BUILD"/obj/*/*.o >"$work/objects"
    printf '%s\n' "$@" | grep -vxF -f - "$work/objects" | xargs nm 2>/dev/null |
        awk '$2 ~ /^[tT]$/ { sub(/\.(constprop|isra|part|lto_priv).*/, "", $3); print $3 }' | sort -u | comm -13 - "$work/these" >"$to"
}
none_of() { # SCENE FUNCTIONS WHAT
    comm -12 "$work/$1.stepped" "$work/$2" >"$work/executed"
    expect "$1: a step executes no $3" 0 "$(wc -l <"$work/executed")" "$work/executed"
}
some_of() { # SCENE FUNCTIONS WHAT: the audit sees what there is
    comm -12 "$work/$1.stepped" "$work/$2" >"$work/executed"
    expect "$1: a step does execute $3" yes "$([ -s "$work/executed" ] && echo yes)" "$work/$1.stepped"
}
of_objects "$work/flexible" "$BUILD"/obj/flex/*.o "$BUILD"/obj/tree/planar_flex*.o "$BUILD"/obj/tree/spatial_flex*.o
of_objects "$work/spatial" "$BUILD"/obj/tree/spatial*.o
of_objects "$work/floating" "$BUILD"/obj/open/floating.o
step momenta decks/floating-satellite.yaml 2.0e-3 --columns t,momentum.x
for scene in pend-plane chain-plane fourbar-plane pend-space chain-space fourbar-space heavy-top; do
    none_of $scene flexible "flexible kernel"
done
for scene in crank-plane crank-space satellite; do some_of $scene flexible "flexible kernels"; done
for scene in pend-space chain-space fourbar-space crank-space; do none_of $scene spatial "spatial recursion"; done
some_of heavy-top spatial "the spatial recursion"
none_of satellite floating "momentum of what floats"
some_of momenta floating "momentum of what floats"

# A record of t alone with loops.
a=$(of_run "$work/fn" $scenes/fourbar-plane.yaml .4 --columns t)
b=$(collected "$work/fn" "$FMDSUB" run -q --every-steps 1 --until .4 --columns t $scenes/fourbar-plane.yaml)
at_most "a record of t with loops" "$(awk -v a="$a" -v b="$b" 'BEGIN { printf "%.0f", (b - a) / 399 }')" 700

# The chain by newmark against the bare loop.
FROM=500 TO=2500 step chain-newmark decks/chain.yaml 1.0e-3 --columns pin1.angle --set parameters.N=8 \
    --set integrate.scheme=newmark --set integrate.step=1.0e-3
a=$(collected "$work/fn" "$BUILD/bench/bare_chain" 8 1e-3 500)
b=$(collected "$work/fn" "$BUILD/bench/bare_chain" 8 1e-3 2500)
awk -v a="$a" -v b="$b" 'BEGIN { printf "%.0f\n", (b - a) / 2000 }' >"$work/bare"
at_most "chain of 8 by newmark, of the bare loop" "$(ratio chain-newmark bare)" 1.45

# None may grow by a hundredth.
for name in pend-plane chain-plane fourbar-plane heavy-top satellite crank-plane crank-space chain-newmark; do
    echo "$name $(cat "$work/$name")"
done >"$work/now"
[ "${UPDATE:-}" = 1 ] && cp "$work/now" $counts
while read -r name was; do
    at_most "$name, of its reference" "$(awk -v a="$(cat "$work/$name")" -v b="$was" 'BEGIN { printf "%.4f", a / b }')" 1.01
done <$counts
