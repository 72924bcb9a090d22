# watched.sh -- the share that `fmdsub run` reports of an effect turned off, beside what turning it on changes.
#
#     BUILD=build sh tests/tools/watched.sh [NAME ...]                default: all lines of the list below
#
# True: the largest change of a displacement of a flexible body (or what the line names) over its largest value.  Fails where the
# report is not within a factor of 3; a line with a - has no estimate, and no number may be told.
. tests/tools/lib.sh

# name, deck, effect, columns, settings
cat >"$work/list" <<'LIST'
spin-up-0.1       spin-up            stiffening arm.tip.dy  parameters.W=0.1
spin-up-0.3       spin-up            stiffening arm.tip.dy  parameters.W=0.3
spin-up-1         spin-up            stiffening arm.tip.dy  parameters.W=1
spin-up-2         spin-up            stiffening arm.tip.dy  parameters.W=2
spin-up-slow      spin-up-slow       stiffening arm.tip.dy
effect-stiffening effect-stiffening  stiffening arm.tip.dy
-crank            flexible-crank     stiffening rod.middle.bending integrate.until=0.05
pendulum          flexible-pendulum  stiffening lower.middle.dy
satellite         floating-satellite stiffening left.tip.dz
blade-5           rotating-blade     stiffening blade.tip.dz parameters.W=5
blade-20          rotating-blade     stiffening blade.tip.dz parameters.W=20
cantilever        cantilever         stiffening arm.tip.dy
robot             flexible-robot     stiffening link2.tip.dy
cantilever-damped cantilever         damping    arm.tip.dy
robot-damped      flexible-robot     damping    link2.tip.dy
turbine-damped    turbine-blade      damping    blade.tip.dz
LIST

wanted=${*:-$(awk '{ printf "%s ", $1 }' "$work/list")}
printf '%-18s %-11s %-20s %9s %9s %7s\n' scene off column reported true ratio
while read -r name deck effect column sets; do
    judged=1
    case " $wanted " in *" $name "*) ;; *) continue ;; esac
    case $name in -*) judged=0 name=${name#?} ;; esac
    more=
    for word in $sets; do more="$more -s $word"; done
    "$FMDSUB" run $more --columns "t,$column" decks/$deck.yaml >"$work/on" 2>/dev/null
    "$FMDSUB" run $more -s effects.$effect=false --columns "t,$column" decks/$deck.yaml >"$work/off" 2>"$work/err"
    told=$(sed -n "s/^left out: $effect of .*: about \(.*\) % .*/\1/p" "$work/err")
    line=$(paste -d, "$work/on" "$work/off" | awk -F, -v told="${told:-nan}" '
        NR > 1 { d = $4 - $2; if (d < 0) d = -d; if (d > off) off = d; x = $2 < 0 ? -$2 : $2; if (x > most) most = x }
        END { true = off / most; if (true > 2) true = 2; r = true > 0 ? told / 100 / true : 0; printf "%.2g %.2g %.2g", told / 100, true, r }')
    set -- $line
    printf '%-18s %-11s %-20s %9s %9s %7s\n' "$name" "$effect" "$column" "$1" "$2" "$3"
    if [ $judged = 0 ]; then expect "$name: no number is told" "" "$told" "$work/err"
    elif [ -z "$told" ]; then not_ok "$name" "no share is told" "$work/err"
    elif awk -v r="$3" 'BEGIN { exit !(r >= 0.33 && r <= 3.05) }'; then ok "$name: $3 times the true share"
    else not_ok "$name" "$3 times the true share"; fi
done <"$work/list"
