# watched.sh -- the shares that `fmdsub run` reports of effects turned off, beside what turning them on changes.
#
#     BUILD=build sh tests/tools/watched.sh [NAME ...]                default: all lines of the list below
#
# True: the largest change of a column over its largest value, by two runs here.  Records: the share by the watch at records alone
# (a run with a checkpoint has no other), of how a body bends; a line without has none, and no number may be told.  Run: the share
# by the second run that the program makes.  Each fails where it is not within a factor of 3.  A line `same` is off where it does
# not matter: both runs agree within the tolerance behind it, and nothing is warned of.
. tests/tools/lib.sh

# name, deck, effect, column, whether records tell, settings
cat >"$work/list" <<'LIST'
spin-up-0.1       spin-up            stiffening arm.tip.dy         yes parameters.W=0.1
spin-up-0.3       spin-up            stiffening arm.tip.dy         yes parameters.W=0.3
spin-up-1         spin-up            stiffening arm.tip.dy         yes parameters.W=1
spin-up-2         spin-up            stiffening arm.tip.dy         yes parameters.W=2
spin-up-slow      spin-up-slow       stiffening arm.tip.dy         yes
effect-stiffening effect-stiffening  stiffening arm.tip.dy         yes
pendulum          flexible-pendulum  stiffening lower.middle.dy    yes
satellite         floating-satellite stiffening left.tip.dz        yes
blade-5           rotating-blade     stiffening blade.tip.dz       yes parameters.W=5
blade-20          rotating-blade     stiffening blade.tip.dz       yes parameters.W=20
cantilever        cantilever         stiffening arm.tip.dy         yes effects.tolerance=1e-5
robot             flexible-robot     stiffening link2.tip.dy       yes
crank             flexible-crank     stiffening rod.middle.bending no  integrate.until=0.05
crank-place       flexible-crank     stiffening rod.middle.y       no integrate.until=0.05
cantilever-damped cantilever         damping    arm.tip.dy         yes
robot-damped      flexible-robot     damping    link2.tip.dy       yes
turbine-damped    turbine-blade      damping    blade.tip.dz       yes
crank-rotary      flexible-crank     rotary     rod.middle.bending no  integrate.until=0.05
cantilever-rotary cantilever         rotary     arm.root.bending   no
pendulum-rotary   flexible-pendulum  rotary     lower.middle.dy    no
satellite-rotary  floating-satellite rotary     left.tip.dz        no
blade-rotary      rotating-blade     rotary     blade.root.bending no
crank-shear       flexible-crank     shear      rod.middle.bending no  integrate.until=0.02 bodies.rod.section.ky=0.85
top               heavy-top          gyroscopic top.x              no
effect-gyroscopic effect-gyroscopic  gyroscopic stand.angle2       no
satellite-gyro    floating-satellite gyroscopic hinge1.angle       no
governor          governor           gyroscopic slide.displacement no
four-bar          four-bar           gravity    pivot.angle        no
double-four-bar   double-four-bar    gravity    bridge.x           no
pendulum-gravity  pendulum           gravity    ball.x             no
heavy-gravity     heavy-top          gravity    top.z              no
same:1e-3         cantilever         stiffening arm.tip.dy         yes
same:1e-3         spin-up            rotary     arm.tip.dy         no
same:1e-3         flexible-robot     rotary     link2.tip.dy       no
same:1e-3         bearing            gyroscopic rotor.y            no
LIST

# told EFFECT FILE: the share, as a number
told() { sed -n "s/^left out: $1[: ].*about \([0-9.e+-]*\) % .*/\1/p" "$2" | awk '{ printf "%.3g", $1 / 100 }'; }

within() { # NAME SHARE TRUE [SAID]
    if [ -z "$2" ]; then not_ok "$1" "no share is told" "${4:-$work/err}"
    elif awk -v a="$2" -v b="$3" 'BEGIN { r = b > 0 ? a / b : 0; exit !(r >= 0.33 && r <= 3.05) }'; then ok "$1: $2, true $3"
    else not_ok "$1" "$2, true $3"; fi
}

here=$PWD
wanted=${*:-$(awk '{ printf "%s ", $1 }' "$work/list")}
printf '%-18s %-11s %-22s %9s %9s %9s\n' scene off column records run true
while read -r name deck effect column records sets; do
    case " $wanted " in *" $name "*) ;; *) continue ;; esac
    more=
    for word in $sets; do more="$more -s $word"; done
    whole=${more}
    case $effect in rotary) [ $deck = flexible-crank ] && whole="$more -s bodies.rod.beam.rotary=true" ;; esac
    rm -f "$work/kept" "$work/part"
    "$FMDSUB" run -q $whole -s effects.$effect=true --columns "t,$column" decks/$deck.yaml >"$work/on" 2>"$work/err"
    (cd "$work" && "$FMDSUB" run $more -s effects.$effect=false -s "checkpoint={every: 1e6, file: kept}" --columns "t,$column" \
        -o part "$here/decks/$deck.yaml") >"$work/none" 2>"$work/first"
    case $name in same:*) more="$more -s effects.tolerance=${name#*:}" ;; esac
    "$FMDSUB" run $more -s effects.$effect=false --columns "t,$column" decks/$deck.yaml >"$work/off" 2>"$work/err"
    a=$(told $effect "$work/first") b=$(told $effect "$work/err")
    true=$(awk -F, 'NR == FNR { on[FNR] = $2; next }
        FNR > 1 { d = $2 - on[FNR]; if (d < 0) d = -d; if (d > off) off = d; x = on[FNR] < 0 ? -on[FNR] : on[FNR]; if (x > most) most = x }
        END { printf "%.3g", (most > 0 ? off / most : 0) }' "$work/on" "$work/off")
    [ $records = yes ] || a=${a:+told}
    printf '%-18s %-11s %-22s %9s %9s %9s\n' "${name%%:*}" "$effect" "$column" "${a:--}" "${b:--}" "$true"
    case $name in
    same:*)
        if awk -v x="$true" -v most="${name#*:}" 'BEGIN { exit !(x <= most) }' && ! grep -q W-effect "$work/err"; then
            ok "$deck, $effect: $true"
        else not_ok "$deck, $effect" "$true" "$work/err"; fi
        continue ;;
    esac
    if [ $records = yes ]; then within "$name, at records" "$a" "$(awk -v x="$true" 'BEGIN { print (x > 2 ? 2 : x) }')" "$work/first"
    else expect "$name: records tell no number" "" "$a" "$work/first"; fi
    if ! grep -q '^left out.*how it bends' "$work/err"; then within "$name, by a second run" "$b" "$true"; fi
done <"$work/list"
