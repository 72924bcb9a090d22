# part-long.sh -- what is too long for `make test`, of the kinds of faults, hard and study: every tests/long/*.sh.
. tests/tools/lib.sh
need_program long
for script in tests/long/*.sh; do
    sh "$script" || { echo "not ok $script"; echo "    the script stopped"; }
done
