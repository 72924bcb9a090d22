# part-hard.sh -- cases that break simulators, each with its criterion: every tests/hard/*.sh.  Others of the kind are
# unit tests of loops (t-loops) and cases of the orders.
. tests/tools/lib.sh
need_program hard
for case in tests/hard/*.sh; do
    sh "$case" || { echo "not ok $case"; echo "    the script stopped"; }
done
