# usage.sh -- every option of every verb: misspelt, without its value, with one too many, with an empty one, of another verb,
# doubled; decks that are not there.  The list of options is that of the program's help, the exit codes are those of fmdsub(1).
. tests/tools/lib.sh
deck=$ROOT/decks/pendulum.yaml
cd "$work" || exit 1
"$FMDSUB" run -q -o a.csv "$deck" 2>err

# options [VERB]: a line each, "NAME value" or "NAME flag".
options() {
    "$FMDSUB" help "$@" | awk '/^options:/ { inside = 1; next } /^$/ { inside = 0 }
        inside && match($0, /--[a-z-]+/) { name = substr($0, RSTART, RLENGTH); rest = substr($0, RSTART + RLENGTH, 2)
                                           print name, rest ~ /^ [^ ]/ ? "value" : rest ~ /^\[/ ? "maybe" : "flag" }' | sort -u
}
# ends STATUS WORDS...: adds to the table of what went wrong.
ends() {
    want=$1; shift
    n=$((n + 1))
    timeout 20 "$FMDSUB" "$@" >out 2>err </dev/null
    got=$?
    [ $got -eq "$want" ] && { [ "$want" -eq 0 ] || [ "$(grep -c . err)" -ge 1 ]; } && { [ "$want" -eq 0 ] || [ ! -s out ]; } ||
        echo "exit $got, expected $want, or words at the wrong place: fmdsub $*" >>wrong
}
options >all
for verb in run check study plot animate sweep diff modes stability list 'list columns' schema explain selftest new; do
    : >wrong
    n=0
    # What makes it go, but for the option in question.
    case $verb in
    diff) set -- a.csv a.csv ;;
    new) set -- pendulum ;;
    explain) set -- W-bending ;;
    list | schema | selftest) set -- ;;
    animate) set -- -o film.html "$deck" ;;
    sweep) set -- --over 'integrate.step=[1.0e-3]' "$deck" ;;
    *) set -- "$deck" ;;
    esac
    ends 2 $verb --nonsense "$@"
    ends 2 $verb -Z "$@"
    options ${verb% *} >own
    while read -r option takes; do
        ends 2 $verb "$@" "${option}z"
        case $takes in
        flag) ends 2 $verb "$@" "$option=1" ;;
        maybe) ends 2 $verb "$@" "$option=" ;;
        value) ends 2 $verb "$@" "$option"; ends 2 $verb "$@" "$option=" ;;
        esac
    done <own
    cut -d ' ' -f 1 own >names
    grep -vwF -f names all >others
    while read -r option takes; do
        case $takes in value) ends 2 $verb "$option=1" "$@" ;; *) ends 2 $verb "$option" "$@" ;; esac
    done <others
    # The last one counts; flags are set once and for all.
    ends 0 $verb --quiet --color never --quiet --color auto "$@"
    case $verb in
    diff) ends 6 diff nowhere.csv a.csv; ends 6 diff a.csv nowhere.yaml; ends 2 diff a.csv; ends 2 diff a.csv a.csv a.csv ;;
    plot) ends 6 plot nowhere.yaml; ends 6 plot nowhere.csv; ends 6 plot . ; ends 2 plot ;;
    animate) ends 6 animate -o x.html nowhere.yaml; ends 2 animate "$deck"; ends 2 animate -o x.html ;;
    sweep) ends 6 sweep --over 'a=[1]' nowhere.yaml; ends 2 sweep --over 'a=[1]'; ends 2 sweep "$deck"; ends 6 sweep --merge nowhere.csv ;;
    list) ends 2 list nonsense; ends 2 list ''; ends 2 list joints forces; ends 2 list --set a=1 ;;
    schema | selftest) ends 2 $verb "$deck" ;;
    new) ends 2 new nonsense; ends 2 new pendulum beam ;;
    explain) ends 2 explain W-nonsense; ends 6 explain nowhere.yaml; ends 2 explain --set a.b=1 W-bending; ends 0 explain W-bending W-offset ;;
    *) ends 6 $verb nowhere.yaml; ends 6 $verb .; ends 2 $verb; ends 2 $verb "$deck" "$deck" ;;
    esac
    # A deck that is wrong, by itself or by what --set makes of it.
    case $verb in
    list | schema | selftest | new | explain) ;;
    diff) ends 3 diff --set 'bodies.ball.mass=-1' "$deck" "$deck" ;;
    *) ends 3 $verb --set 'bodies.ball.mass=-1' "$@"; ends 2 $verb --set bodies "$@"; ends 2 $verb --set =1 "$@" ;;
    esac
    [ "$n" -gt 40 ] && [ ! -s wrong ] && ok "exit codes of $verb: $n command lines" || not_ok "exit codes of $verb" "of $n command lines:" wrong
done
