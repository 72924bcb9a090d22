# said.sh -- what check, modes and list say of decks, all of it, as it was when it was read: words the same, numbers to a
# millionth.  WRITE=1 writes what is said now.
. tests/tools/lib.sh

# as_it_was DECK VERB...: what each says of it.
as_it_was() {
    deck=$1 name=$(basename "$1" .yaml)
    shift
    for what; do
        file=$name.$(echo "$what" | tr -d ' -')
        "$FMDSUB" $what "$deck" >"$work/$file" 2>"$work/err"
        ended "$what $deck" 0 $? "$work/$file" "$work/err"
        cat "$work/err" >>"$work/$file"
        [ -z "${WRITE:-}" ] || cp "$work/$file" tests/said/
        awk -v apart=1e-9 -f tests/tools/alike.awk "tests/said/$file" "$work/$file" >"$work/differs" && ok "$file as it was" ||
            not_ok "$file as it was" "differs; WRITE=1 sh tests/faults/said.sh writes what is said now" "$work/differs"
    done
}

for deck in decks/four-bar.yaml decks/flexible-crank.yaml decks/suspension.yaml tests/pictures/space.yaml; do
    as_it_was "$deck" 'check --no-trial' 'check --no-trial -f json' modes 'modes -f json' 'list columns'
done
# Other joints, forces, beams and loops.
for deck in cardan governor screw-actuator bearing gear-train rotor turbine-blade flexible-robot heavy-top driven-telescope geared-pendulum \
    light-hub spin-up-segments bricard quick-return; do
    as_it_was decks/$deck.yaml 'check --no-trial -f json' modes
done
for deck in touch drive spatial; do as_it_was tests/hard/units/$deck.yaml 'check --no-trial' 'list columns'; done
