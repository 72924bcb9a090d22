# part-bad.sh -- decks that are wrong, and what each must get.
#
# tests/bad/NAME.yaml is the deck, or NAME.sh prints it.  Comment lines at the top say what is expected:
#
#     # exit 3 alone                       the exit status; alone: no error but those below, for one mistake
#                                          gets one message
#     # args --set a.b=1                   more arguments of `fmdsub run` (optional)
#     # err NAME.yaml:4:7: error: *        every such pattern must fit a line of stderr, in this order; '*'
#                                          stands for anything
#
# Rules for all: nothing on stdout, an answer within seconds, no control bytes on stderr.  All that is said of each is what it was
# when it was read, by its line of tests/said/bad.txt.
. tests/tools/lib.sh
. tests/tools/sums.sh
need_program bad

for source in tests/bad/*.yaml tests/bad/*.sh; do
    [ -f "$source" ] || continue
    name=${source##*/}
    name=${name%.*}
    rm -rf "$work/x"
    mkdir "$work/x"
    case $source in
    *.sh) (cd "$work/x" && sh "$ROOT/$source" >"$name.yaml") ;;
    *) cp "$source" "$work/x/$name.yaml" ;;
    esac
    want=$(sed -n 's/^# exit \([0-9]*\).*/\1/p' "$source" | head -n 1)
    args=$(sed -n 's/^# args //p' "$source" | head -n 1)
    alone=$(grep -c '^# exit [0-9]* alone' "$source")
    sed -n 's/^# err //p' "$source" >"$work/wanted"
    (cd "$work/x" && eval "timeout ${BAD_SECONDS:-20} '$FMDSUB' run $args $name.yaml" >../out 2>../err </dev/null)
    rc=$?
    heard "bad-$name" "$work/err"
    if [ "$rc" != "$want" ]; then not_ok "$name" "exit $rc, expected $want" "$work/err"
    elif [ -s "$work/out" ]; then not_ok "$name" "bytes on stdout" "$work/out"
    elif LC_ALL=C tr -d '\11\12\40-\176\200-\377' <"$work/err" | grep -q .; then
        not_ok "$name" "control bytes on stderr"
    elif awk -v wanted="$work/wanted" '
        function pattern(s) {
            gsub(/[][\\.^$()|{}+?]/, "\\\\&", s)
            gsub(/\*/, ".*", s)
            return "^" s "$"
        }
        BEGIN { while ((getline line < wanted) > 0) { want[++n] = pattern(line); errors -= line ~ /error: / } at = 1 }
        /: error: / { errors++ }
        at <= n && $0 ~ want[at] { at++ }
        END { exit at <= n || n == 0 || (alone && errors != 0) }' alone="$alone" "$work/err"; then ok "$name"
    else
        not_ok "$name" "stderr is not what was expected; wanted, then got:" "$work/wanted" "$work/err"
    fi
done
sums_judge tests/said/bad.txt
