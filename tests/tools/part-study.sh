# part-study.sh -- statements about accuracy and cost, shown by `fmdsub study` itself: every tests/study/*.sh.
. tests/tools/lib.sh
need_program study
for subject in tests/study/*.sh; do
    sh "$subject" || { echo "not ok $subject"; echo "    the script stopped"; }
done
