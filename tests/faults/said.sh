# said.sh -- what check, modes and explain say of four decks, all of it, as it was when it was read: words the same, numbers to a
# millionth.  WRITE=1 writes what is said now.
. tests/tools/lib.sh
for deck in decks/four-bar.yaml decks/flexible-crank.yaml decks/suspension.yaml tests/pictures/space.yaml; do
    name=$(basename $deck .yaml)
    for what in 'check --no-trial' 'check --no-trial -f json' modes 'modes -f json' 'list columns'; do
        file=$name.$(echo "$what" | tr -d ' -')
        "$FMDSUB" $what $deck >"$work/$file" 2>"$work/err"
        ended "$what $deck" 0 $? "$work/$file" "$work/err"
        cat "$work/err" >>"$work/$file"
        [ -z "${WRITE:-}" ] || cp "$work/$file" tests/said/
        awk -v apart=1e-9 -f tests/tools/alike.awk tests/said/$file "$work/$file" >"$work/differs" && ok "$file as it was" ||
            not_ok "$file as it was" "differs; WRITE=1 sh tests/faults/said.sh writes what is said now" "$work/differs"
    done
done
