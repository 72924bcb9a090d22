# commands.sh -- commands that cannot be done: the status, nothing on standard output and one line, with these words.
# commands.txt has them; D/ stands for the shipped decks, W/ for the files below.
. tests/tools/lib.sh
cd "$work" || exit 1
echo words >text.csv
: >empty.csv
printf 't,a,b\n0,1\n' >narrow.csv
printf 't,a\n0,x\n' >number.csv
printf 't,a\n0,1\n1,2\n' >one.csv
printf 'point,k,status\n1,2\n' >nopoint.csv
for point in 0 1.5 x; do printf 'point,k,status\n%s,2,0\n' $point >point$point.csv; done
printf 'point,k,status\n1,2,0\n' >other1.csv
printf 'point,j,status\n2,2,0\n' >other2.csv
printf 'point,k,status\n1,2,0\n1,3,0\n' >twice.csv
echo '{"a": [1' >bad.json
echo '{"t": 1' >bad.ndjson
tab=$(printf '\t')
while IFS=$tab read -r want words command; do
    case $want in '' | '#'*) continue ;; esac
    eval "set -- $(echo "$command" | sed "s|\([ =]\)D/|\1$ROOT/decks/|g; s|\([ =]\)W/|\1|g")"
    "$FMDSUB" "$@" >out 2>err </dev/null
    rc=$?
    if [ $rc != "$want" ] || [ -s out ]; then not_ok "$command" "exit $rc, expected $want" out err
    elif [ "$(wc -l <err)" != 1 ] || ! grep -qF -- "$words" err; then not_ok "$command" "expected one line with: $words" err
    else ok "$command"; fi
done <"$ROOT/tests/faults/commands.txt"
