# part-faults.sh -- faults of streams, signals and surroundings: every tests/faults/*.sh.
. tests/tools/lib.sh
need_program faults
for fault in tests/faults/*.sh; do
    sh "$fault" || { echo "not ok $fault"; echo "    the script stopped"; }
done
