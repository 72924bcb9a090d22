# subcycling.sh -- what sub-cycling at 10:1 gains over the single rate at the small step, and what it could.
. tests/tools/lib.sh
for deck in arms long-chain; do
    echo "$deck: $(sed -n 's/^title: //p' tests/bench/$deck.yaml)"
    "$BUILD/bench/subcycling" tests/bench/$deck.yaml "${REPEATS:-7}" || exit 1
done
