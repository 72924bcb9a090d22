# modes.sh -- `modes: auto` beside all modes of the mesh (at most 40), on shipped decks, at three tolerances of `effects`.
#
#     BUILD=build sh tests/tools/modes.sh [NAME ...]                  default: all lines of the list below
#
# A line has the modes kept in all bodies, and the largest change of a column over its largest value: of displacements,
# places, angles and bending stresses, which fails above twice the tolerance, and of the rest, which is shown.  The line `deck`
# has the deck's own modes.
. tests/tools/lib.sh

# name, deck, bodies, settings for both; columns that are not judged behind a ?: what is nothing but a second-order effect
cat >"$work/list" <<'LIST'
bent-arm          one,two       integrate.until=0.1
cantilever        arm
cardan            blade         ?blade.tip.rx
effect-modes      arm
effect-stiffening arm
flexible-crank    rod           integrate.until=0.04
flexible-pendulum upper,lower
flexible-robot    link1,link2
floating-satellite left,right   integrate.until=5
light-hub         arm
roll-up           blade         integrate.until=0.08
rotating-blade    blade
rotor             shaft
soft-pendulum     one,two       integrate.until=0.5
spin-up           arm           integrate.until=16
spin-up-segments  arm           integrate.until=10
spin-up-simo      arm           integrate.until=16
spin-up-slow      arm
turbine-blade     blade         integrate.until=5
whip              blade         integrate.until=0.2
LIST

wanted=${*:-$(awk '{ printf "%s ", $1 }' "$work/list")}

# change ALL OTHER SKIP: largest share of judged columns, which, largest of the others, which
change() {
    awk -F, -v skip="$3" '
        function judged(name) { return name != skip && name ~ /(\.d[xyz]|\.r[xyz]|\.[xyz]|angle[12]?|bending|deflection|mode[0-9]+)$/ }
        FNR == 1 { for (i = 1; i <= NF; i++) if (NR == FNR) at[$i] = i; else from[i] = at[$i]; n = NF; if (NR != FNR) for (i = 1; i <= NF; i++) name[i] = $i; next }
        NR == FNR { for (i = 1; i <= NF; i++) { all[FNR, i] = $i; if (($i < 0 ? -$i : $i) > most[i]) most[i] = $i < 0 ? -$i : $i }; next }
        { for (i = 1; i <= n; i++) if (from[i]) { d = $i - all[FNR, from[i]]; if (d < 0) d = -d; if (d > off[i]) off[i] = d } }
        END { for (i = 2; i <= n; i++) { if (!from[i] || !most[from[i]] || name[i] ~ /^(energy|momentum)/) continue
                  x = off[i] / most[from[i]]; k = judged(name[i]) ? 0 : 1
                  if (x >= worst[k]) { worst[k] = x; who[k] = name[i] } }
              printf "%.2g %s %.2g %s\n", worst[0], who[0] ? who[0] : "-", worst[1], who[1] ? who[1] : "-" }' "$1" "$2"
}

sets() { # VALUE
    for body in $(echo "$bodies" | tr , ' '); do printf -- '-s bodies.%s.modes=%s ' "$body" "$1"; done
}

chosen() { sed -n 's/.*modes: auto: \([0-9]*\) of \([0-9]*\) .*/\1 \2/p' "$1"; }

printf '%-18s %9s %7s %9s %-24s %9s %s\n' deck tolerance kept change of others of
while read -r name bodies rest; do
    case " $wanted " in *" $name "*) ;; *) continue ;; esac
    skip= more=
    for word in $rest; do case $word in \?*) skip=${word#?} ;; *) more="$more -s $word" ;; esac; done
    deck=decks/$name.yaml
    "$FMDSUB" check $more $(sets auto) "$deck" >"$work/check" 2>/dev/null
    # all: what is chosen from nothing left out
    "$FMDSUB" run -q $more $(sets auto) -s effects.tolerance=1e-14 "$deck" >"$work/all" 2>"$work/err"
    "$FMDSUB" run -q $more "$deck" >"$work/one" 2>/dev/null
    set -- $(change "$work/all" "$work/one" "$skip")
    printf '%-18s %9s %7s %9s %-24s %9s %s\n' "$name" deck - "$1" "$2" "$3" "$4"
    for tolerance in 1e-1 1e-2 1e-3; do
        "$FMDSUB" check $more $(sets auto) -s effects.tolerance=$tolerance "$deck" >"$work/check" 2>/dev/null
        kept=$(chosen "$work/check" | awk '{ a += $1; b += $2 } END { print a "/" b }')
        "$FMDSUB" run -q $more $(sets auto) -s effects.tolerance=$tolerance "$deck" >"$work/one" 2>"$work/err"
        set -- $(change "$work/all" "$work/one" "$skip")
        printf '%-18s %9s %7s %9s %-24s %9s %s\n' "$name" $tolerance "$kept" "$1" "$2" "$3" "$4"
        if awk -v x="$1" -v tol=$tolerance 'BEGIN { exit !(x <= 2 * tol) }'; then ok "$name at $tolerance"
        else not_ok "$name at $tolerance" "$1 of $2"; fi
    done
done <"$work/list"

# Where the tolerance is what the deck's own modes leave, no more modes than these.
no_more() { # DECK BODY TOLERANCE MODES
    "$FMDSUB" check -s bodies.$2.modes=auto -s effects.tolerance=$3 decks/$1.yaml >"$work/check" 2>/dev/null
    kept=$(chosen "$work/check" | awk '{ print $1 }')
    if [ "${kept:-99}" -le "$4" ]; then ok "$1 at $3: $kept modes, the deck has $4"
    else not_ok "$1 at $3" "$kept modes, the deck has $4"; fi
}
case " $wanted " in *" cantilever "*) no_more cantilever arm 1.7e-2 5 ;; esac
case " $wanted " in *" rotating-blade "*) no_more rotating-blade blade 6.8e-2 8 ;; esac
