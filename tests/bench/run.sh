# run.sh -- every bench of this folder, one after the other.
for bench in tests/bench/*.sh; do
    [ "$bench" = tests/bench/run.sh ] || sh "$bench" || exit 1
    echo
done
