# streams.sh -- readers that leave, full disks, closed and slow streams, failing writes.
. tests/tools/lib.sh
deck=$ROOT/decks/pendulum.yaml
# Some 5 MB of records in a second or two.
long="--every 1.0e-3 --until 50"

timeout 60 "$FMDSUB" run $long "$deck" >"$work/whole.csv" 2>"$work/err"
ended "a long run for comparison" 0 $? "$work/whole.csv" "$work/err"

# A reader that leaves: the program ends at once by SIGPIPE's code and says nothing.
{ "$FMDSUB" run $long "$deck" 2>"$work/err"; echo $? >"$work/rc"; } | head -n 1 >"$work/head"
expect "| head: status" 141 "$(cat "$work/rc")" "$work/err"
if [ ! -s "$work/head" ] || grep -qi 'error\|pipe' "$work/err"; then not_ok "| head: quiet" "words about it on stderr" "$work/err"; else ok "| head: quiet"; fi
head -n 1 "$work/whole.csv" >"$work/first"
same "| head: one whole line" "$work/first" "$work/head"

# A full disk, noticed while writing or at the close.
if [ -w /dev/full ]; then
    "$FMDSUB" run $long "$deck" >/dev/full 2>"$work/err"
    expect "full disk, long run" 6 $? "$work/err"
    if grep -q 'No space left' "$work/err"; then ok "full disk: says so"; else not_ok "full disk: says so" "no 'No space left' on stderr" "$work/err"; fi
    "$FMDSUB" run --until 0.5 "$deck" >/dev/full 2>"$work/err"
    expect "full disk, short run" 6 $? "$work/err"
else
    skip "full disk" "no /dev/full"
fi

"$FMDSUB" run --until 0.5 "$deck" >&- 2>"$work/err"
expect "stdout closed" 6 $? "$work/err"

# A limit on the size of files: SIGXFSZ ignored, the write fails with EFBIG.
(ulimit -f 100; "$FMDSUB" run $long "$deck" >"$work/limited.csv" 2>"$work/err")
expect "file size limit" 6 $? "$work/err"
awk -F, 'END { exit NR < 2 }' "$work/limited.csv" && ok "file size limit: records before it are there" ||
    not_ok "file size limit: records before it are there" "nothing was written"

# -o: the name appears when the run is done, a part file stays where it is not.
(cd "$work" && "$FMDSUB" run --until 0.5 -o done.csv "$deck" 2>err)
ended "-o: status" 0 $? "$work/done.csv" "$work/err"
[ -s "$work/done.csv" ] && [ ! -e "$work/done.csv.part" ] && ok "-o: renamed when done" ||
    not_ok "-o: renamed when done" "$(ls "$work" | tr '\n' ' ')"
(cd "$work" && "$FMDSUB" run -o no/such/folder.csv "$deck" 2>err)
expect "-o into a folder that is not there" 6 $? "$work/err"
(cd "$work" && ulimit -f 100; "$FMDSUB" run $long -o cut.csv "$deck" 2>err)
expect "-o: no room" 6 $? "$work/err"
[ ! -e "$work/cut.csv" ] && [ -s "$work/cut.csv.part" ] && ok "-o: what was written stays as .part" ||
    not_ok "-o: what was written stays as .part" "$(ls "$work" | tr '\n' ' ')"

# A slow reader loses nothing.
timeout 60 "$FMDSUB" run $long "$deck" 2>/dev/null | (sleep 1; cat) >"$work/slow.csv"
same "slow reader" "$work/whole.csv" "$work/slow.csv"

# write() fails at the k-th call, is interrupted, or writes a part.
bad_write() { BADWRITE=$1 LD_PRELOAD=$BUILD/tools/badwrite.so "$FMDSUB" run --every 1.0e-3 --until 5 -q "$deck"; }
for k in 1 2 3 7; do
    bad_write eio:$k >"$work/eio.csv" 2>"$work/err"
    rc=$?
    expect "write fails at call $k" 6 $rc "$work/err"
    if [ $rc != 6 ] || [ -s "$work/eio.csv" ] && [ "$(tail -c 1 "$work/eio.csv" | od -An -c | tr -d ' ')" != '\n' ]; then
        not_ok "write fails at call $k: last record whole" "it is cut, or nothing failed"
    else
        ok "write fails at call $k: last record whole"
    fi
done
"$FMDSUB" run --every 1.0e-3 --until 5 -q "$deck" >"$work/plain.csv" 2>/dev/null
for fault in eintr:2 short:7; do
    bad_write $fault >"$work/odd.csv" 2>"$work/err"
    same "writes with $fault" "$work/plain.csv" "$work/odd.csv"
done

# Closed streams at the start: words never land in a data file.
(cd "$work" && "$FMDSUB" run --until 0.5 -o closed.csv "$deck" <&- >&- 2>&-)
ended "all three streams closed: status" 0 $? "$work/closed.csv"
(cd "$work" && "$FMDSUB" run --until 0.5 -q -o plain.csv "$deck" 2>/dev/null)
same "all three streams closed: data" "$work/plain.csv" "$work/closed.csv"

# The counts, too, go where nothing can be written.
if [ -w /dev/full ]; then
    "$FMDSUB" run -q --until 0.5 --stats=/dev/full "$deck" >"$work/out" 2>"$work/err"
    expect "full disk: counts, status" 6 $? "$work/err"
    grep -q "/dev/full: cannot write" "$work/err" && ok "full disk: counts, told" || not_ok "full disk: counts, told" "stderr:" "$work/err"
fi

# '-' is standard output.
"$FMDSUB" run -q --until 0.5 "$deck" >"$work/there" 2>"$work/err"
(cd "$work" && "$FMDSUB" run -q --until 0.5 -o - "$deck") >"$work/here" 2>"$work/err"
same "-o -: standard output" "$work/there" "$work/here"
expect "-o -: no file of that name" "no, records" "$([ -e "$work/-" ] && echo yes || echo no)$([ -s "$work/here" ] && echo ", records")"

# Named pipes with nobody at the other end.
mkfifo "$work/pipe"
timeout 20 "$FMDSUB" run -q --max-time 0.2 "$work/pipe" >"$work/out" 2>"$work/err"
expect "a deck that nobody writes: status" 7 $? "$work/err"
grep -q "limit of time" "$work/err" && ok "a deck that nobody writes: told" || not_ok "a deck that nobody writes: told" "stderr:" "$work/err"
timeout 20 "$FMDSUB" run -q --max-time 0.2 -o "$work/pipe" "$deck" >"$work/out" 2>"$work/err"
expect "records that nobody reads: status" 7 $? "$work/err"
grep -q "limit of time" "$work/err" && ok "records that nobody reads: told" || not_ok "records that nobody reads: told" "stderr:" "$work/err"

# A deck of 300 kB that comes in pieces is read to its end.
{ awk 'BEGIN { for (i = 0; i < 3000; i++) printf "# %098d\n", i }'; cat "$ROOT/decks/pendulum.yaml"; } >"$work/long.yaml"
cat "$work/long.yaml" | "$FMDSUB" run -q - >"$work/out" 2>"$work/err"
ended "a long deck by a pipe" 0 $? "$work/out" "$work/err"
"$FMDSUB" run -q "$ROOT/decks/pendulum.yaml" | cmp -s - "$work/out" && [ -s "$work/out" ] && ok "a long deck by a pipe: as from its file" ||
    not_ok "a long deck by a pipe: as from its file" "differs" "$work/out" "$work/err"
