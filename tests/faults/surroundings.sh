# surroundings.sh -- the bytes of a run do not depend on where, when and beside what it runs.
. tests/tools/lib.sh
deck=$ROOT/decks/pendulum.yaml
run() { "$FMDSUB" run --every 0.01 --until 2 "$deck"; }

run >"$work/plain.csv" 2>"$work/err"
ended "a plain run" 0 $? "$work/plain.csv" "$work/err"

(ulimit -s 64; run) >"$work/stack.csv" 2>"$work/err"
same "a stack of 64 KiB" "$work/plain.csv" "$work/stack.csv"

if localedef -i de_DE -f UTF-8 "$work/de_DE.UTF-8" >/dev/null 2>&1 || [ -d "$work/de_DE.UTF-8" ]; then
    LOCPATH=$work LC_ALL=de_DE.UTF-8 "$FMDSUB" run --every 0.01 --until 2 "$deck" >"$work/locale.csv" 2>/dev/null
    same "a locale with decimal commas" "$work/plain.csv" "$work/locale.csv"
else
    skip "a locale with decimal commas" "localedef cannot make de_DE here (package locales)"
fi

# Eight at once in one folder.
(cd "$work" && for i in 1 2 3 4 5 6 7 8; do
    "$FMDSUB" run --every 0.01 --until 2 -q -o "at$i.csv" "$deck" 2>/dev/null &
done; wait)
good=0
for i in 1 2 3 4 5 6 7 8; do cmp -s "$work/plain.csv" "$work/at$i.csv" && good=$((good + 1)); done
expect "eight at once, same bytes" 8 $good
expect "eight at once, nothing left behind" 8 "$(ls "$work" | grep -c '^at')"

# Another day.
if command -v faketime >/dev/null; then
    faketime '2001-01-01 00:00:00' "$FMDSUB" run --every 0.01 --until 2 "$deck" >"$work/clock.csv" 2>/dev/null
else
    sleep 1.1
    run >"$work/clock.csv" 2>/dev/null
fi
same "another time, same bytes" "$work/plain.csv" "$work/clock.csv"
for format in ndjson json; do
    "$FMDSUB" run --until 1 -f $format "$deck" >"$work/a.$format" 2>/dev/null
    sleep 1.1
    "$FMDSUB" run --until 1 -f $format "$deck" >"$work/b.$format" 2>/dev/null
    same "another time, same bytes: $format" "$work/a.$format" "$work/b.$format"
done

env -i "$FMDSUB" run --every 0.01 --until 2 "$deck" >"$work/env.csv" 2>/dev/null
same "empty environment" "$work/plain.csv" "$work/env.csv"
BIG=$(head -c 100000 /dev/zero | tr '\0' x) TZ=Pacific/Kiritimati MALLOC_PERTURB_=165 \
    "$FMDSUB" run --every 0.01 --until 2 "$deck" >"$work/env.csv" 2>/dev/null
same "large environment, another zone, memory not zero" "$work/plain.csv" "$work/env.csv"
