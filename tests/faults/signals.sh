# signals.sh -- SIGINT and SIGTERM finish the step, write what is due, and leave by their own code.
. tests/tools/lib.sh
deck=$ROOT/decks/pendulum.yaml

# Every record has as many fields as the header, and the last one ends its line.
whole() { # NAME FILE
    if [ "$(tail -c 1 "$2" | od -An -c | tr -d ' ')" = '\n' ] && awk -F, 'NR == 1 { n = NF } NF != n { bad = 1 } END { exit bad || NR < 2 }' "$2"
    then ok "$1"
    else tail -n 2 "$2" >"$work/tail"; not_ok "$1" "the last record is cut" "$work/tail"; fi
}

for signal in INT:130 TERM:143; do
    name=SIG${signal%:*}
    timeout --preserve-status -s "${signal%:*}" 0.5 "$FMDSUB" run --every 1.0e-3 --until 1.0e+5 "$deck" >"$work/out.csv" 2>"$work/err"
    expect "$name: status" "${signal#*:}" $? "$work/err"
    whole "$name: records whole" "$work/out.csv"
done

# Writing to a pipe that nobody reads: still whole records, and it ends.
{ timeout --preserve-status -k 5 -s INT 0.5 "$FMDSUB" run --every 1.0e-3 --until 1.0e+5 "$deck" 2>/dev/null; echo $? >"$work/rc"; } |
    { sleep 1; cat >"$work/out.csv"; }
expect "SIGINT on a blocked pipe: status" 130 "$(cat "$work/rc")"
whole "SIGINT on a blocked pipe: records whole" "$work/out.csv"

# -o after SIGINT: the part file stays under its own name.
(cd "$work" && timeout --preserve-status -s INT 0.5 "$FMDSUB" run --every 1.0e-3 --until 1.0e+5 -o out.dat "$deck" 2>err)
expect "SIGINT with -o: status" 130 $? "$work/err"
if [ -s "$work/out.dat.part" ] && [ ! -e "$work/out.dat" ]; then ok "SIGINT with -o: kept as .part"
else not_ok "SIGINT with -o: kept as .part" "$(ls "$work" | tr '\n' ' ')" "$work/err"; fi
