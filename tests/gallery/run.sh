# run.sh -- the gallery: hard cases judged by number, as a table.  Each case is a file beside this one; its first line says in
# words what it is.  The verdicts: right, the run ends and its figure is within the limit; told, it stopped, or ended with a
# status, and said why; silent, a wrong number without a word.
#
#     BUILD=build sh tests/gallery/run.sh          all; with D=H2 those that have H2 in their names
#
# Ends with 1 where a case is silent, or told where its limit does not say so.
. tests/tools/lib.sh
cd "$work" || exit 1
printf '%-5s %-18s %-7s %-12s %-10s %s\n' case scheme verdict figure limit seconds

# line SCHEME LIMIT STATUS FIGURE: a line of the table; words of the run in err.  LIMIT: a number, the run ends with 0 and a
# figure no larger; `told`, it ends with a status and FIGURE, a pattern, in its words; a number and `or-told`.
line() {
    verdict=silent figure=$4
    case $2 in
        told) figure=- && [ "$3" != 0 ] && [ "$3" -le 7 ] && [ -n "$4" ] && grep -q -e "$4" err && verdict=told ;;
        *) if [ "$3" = 0 ]; then awk -v f="$4" -v l="${2%or-told}" 'BEGIN { exit !(f != "" && f + 0 == f && f >= 0 && f <= l) }' && verdict=right
           else case $3 in 1|5) [ -s err ] && verdict=told ;; esac; fi ;;
    esac
    printf '%-5s %-18s %-7s %-12s %-10s %s\n' "$case_" "$1" $verdict "${figure:--}" "$2" \
        "$(awk -v ns=$(($(date +%s%N) - begun)) 'BEGIN { printf "%.2f", ns / 1e9 }')" | tee -a "$work/table"
    case $verdict,$2 in right,*|told,*told) ;; *) echo "not as it should be: status $3" && head -n 3 err ;; esac >&2
}

# Side by side, where they apply.
schemes='subcycle midpoint newmark generalized-alpha miao'

# row SCHEME LIMIT AWK [ARGUMENT...]: runs the deck on stdin under SCHEME (`deck`: it is refused while it is read or put together, by
# whatever scheme).  AWK prints the figure from the records, fields by comma, with abs(x), and the worst that see(x) saw; where
# LIMIT is `told`, it is the pattern.
words='function abs(x) { return x < 0 ? -x : x } function see(x) { x = abs(x); if (!(x <= worst)) worst = x }'
row() {
    scheme=$1 limit=$2 figure=$3 begun=$(date +%s%N)
    shift 3
    cat >deck.yaml
    given="integrate.scheme=$scheme"
    [ "$scheme" = deck ] && given="title=as it is"
    "$FMDSUB" run -q "$@" --set "$given" deck.yaml >out 2>err # the scheme last: of all that is set
    status=$?
    [ "$limit" = told ] || figure=$(awk -F, "$words $figure" out)
    line "$scheme" "$limit" $status "$figure"
}

# touching LIMIT AWK [ARGUMENT...]: by each scheme that takes rigid contacts.
touching() {
    cat >touching.yaml
    for scheme in midpoint subcycle; do row $scheme "$@" <touching.yaml; done
}

# fall STEP UNTIL: a ball that falls, for several cases.
fall() { printf 'fmdsub: 1\ngravity: [0, -9.81]\nbodies: {ball: {mass: 1, at: [0, 0]}}\nconstraints: {rail: {prismatic: [ground, ball], axis: [0, 1]}}\nintegrate: {step: %s, until: %s}\noutput: {columns: [ball.ay]}\n' "$1" "$2"; }

for file in "$ROOT"/tests/gallery/[A-Z]*.sh; do
    case_=$(basename "$file" .sh) begun=$(date +%s%N)
    wanted "$case_" && . "$file"
done
awk '{ n[$3]++ } ($3 == "told" && $5 !~ /told/) || $3 == "silent" { bad++ }
    END { printf "%d right, %d told, %d silent\n%d passed, %d failed\n", n["right"], n["told"], n["silent"], NR - bad, bad; exit bad || !NR }' table
