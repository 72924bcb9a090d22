# killed.sh -- killed outright, at any instant: what was written to a pipe or a file are whole rows, a file that is not whole
# keeps the name FILE.part, and no state is left but a whole one.
. tests/tools/lib.sh
deck=decks/bar-slider.yaml
long="--until 1000 --every-steps 1"

# Rows of as many fields as the head, each ended.  The kernel may cut a write(2) of the one that is killed, between two of its
# pages: there alone, at the end of a file, half a row is none of ours.
whole_rows() { # FILE
    [ -s "$1" ] || return 0
    cut=0
    [ "$(tail -c 1 "$1" | od -An -c | tr -d ' ')" = '\n' ] || cut=1
    [ $cut = 0 ] || [ $(($(wc -c <"$1") % $(getconf PAGESIZE))) = 0 ] || return 1
    awk -F, -v cut=$cut 'NR == 1 { n = NF } wrong { bad = 1 } { wrong = NF != n } END { exit bad || (wrong && !cut) }' "$1"
}

bad=0 rows=0
for after in 0.01 0.03 0.06 0.1 0.15 0.21 0.28 0.37; do
    rm -f "$work"/k.*
    "$FMDSUB" run -q $long -o "$work/k.csv" --final-state "$work/k.json" $deck 2>/dev/null &
    file=$!
    "$FMDSUB" run -q $long $deck 2>/dev/null >"$work/k.out" &
    pipe=$!
    sleep $after
    kill -9 $file $pipe
    wait $file $pipe 2>/dev/null
    [ ! -e "$work/k.csv" ] && [ ! -e "$work/k.json" ] || bad=$((bad + 1))
    for part in "$work/k.csv.part" "$work/k.out"; do
        [ ! -e "$part" ] && continue
        whole_rows "$part" || { bad=$((bad + 1)); tail -c 200 "$part" >"$work/tail"; }
        rows=$((rows + $(wc -l <"$part")))
    done
done
[ $rows -gt 100 ] || { echo "only $rows rows were written before" >"$work/tail"; bad=none; }
expect "killed: whole rows, no half state" 0 $bad "$work/tail"
