# memory.sh -- no memory at some allocation: every verb ends with status 7 and says so, whichever allocation it is.
#
# Of each command MOST allocations are refused (40), one a run, the first half of them first and the rest spread; `make memory` all.
. tests/tools/lib.sh
MOST=${MOST:-40}
cp -r decks "$work/decks"
cp tests/reduce/bar.inp tests/reduce/bar.sti tests/reduce/bar.mas tests/reduce/bar.dof "$work"
cd "$work" || exit 1

refuse() { # WORDS...
    "$BUILD/tools/everyalloc" "$BUILD/tools/badalloc.so" "$work" "$MOST" "$@" >"$work/refused"
    rc=$?
    name="memory: ${1##*/}"
    shift
    expect "$name $*" 0 $rc "$work/refused"
}

for verb in schema list new "explain E-tab" --help; do refuse "$FMDSUB" $verb; done
for deck in pendulum telescope spin-up suspension gear-train bricard; do
    for verb in "check --no-trial" "check --expanded" "check --no-trial -f json" modes "list columns" "run -q --until 0.002 --every-steps 1"; do
        [ "$MOST" -gt 40 ] || [ $deck = telescope ] || [ "$verb" = "check --no-trial" ] || continue
        refuse "$FMDSUB" $verb decks/$deck.yaml
    done
done
short="-q --until 0.002 --every-steps 1 decks/telescope.yaml"
for format in ndjson json; do refuse "$FMDSUB" run -f $format $short; done
refuse "$FMDSUB" run --stats=stats.txt --final-state state.json -o out.csv $short
refuse "$FMDSUB" study -q --steps 2.0e-4 --ratios 1,5 --until 0.02 --repeats 1 decks/telescope.yaml
deck=decks/pendulum.yaml
"$FMDSUB" run -q --until 0.5 -o a.csv $deck 2>err
"$FMDSUB" run -q --until 0.5 -f json -o a.json $deck 2>err
for words in "stability --script --plot x.svg $deck" "explain --until 0.01 $deck" "diff a.csv a.json" "plot --script a.csv" \
    "diff --until 0.1 $deck $deck" "plot --script --until 0.1 $deck" "animate -q --until 0.1 -o a.html $deck" \
    "animate -q --until 0.1 -o a.glb $deck" "sweep --list --over integrate.step=[1.0e-3,2.0e-3] $deck" \
    "study -q --script --plot x.svg --until 0.01 --repeats 0 --schemes newmark,midpoint $deck"; do
    refuse "$FMDSUB" $words
done
[ ! -x "$BUILD/fmdsub-reduce" ] || refuse "$BUILD/fmdsub-reduce" -i root=root -i tip=tip -n 4 -o body.json bar
