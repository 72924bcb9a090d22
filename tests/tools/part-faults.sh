# part-faults.sh -- faults of streams, signals and surroundings: every tests/faults/*.sh.
[ -d tests/faults ] || exit 1
for fault in tests/faults/*.sh; do
    sh "$fault" || { echo "not ok $fault"; echo "    the script stopped"; }
done
