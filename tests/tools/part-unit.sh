# part-unit.sh -- every unit test executable or those of UNITS, two at a time, its TAP lines counted.
. tests/tools/lib.sh

for name in ${UNITS:-$(cd tests/unit && ls t-*.c)}; do
    name=${name%.c}
    [ -x "$BUILD/unit/$name" ] || { not_ok "$name" "not built"; continue; }
    echo "$name"
done >"$work/list"
grep '^not ok\|^    ' "$work/list"
grep '^t-' "$work/list" | xargs -P 2 -I{} sh -c '
    CMOCKA_MESSAGE_OUTPUT=TAP timeout "$4" "$1/unit/$2" >"$3/$2.tap" 2>&1; echo $? >"$3/$2.rc"' sh "$BUILD" {} "$work" "${UNIT_SECONDS:-120}"

for tap in "$work"/t-*.tap; do
    [ -f "$tap" ] || continue
    name=${tap##*/}
    name=${name%.tap}
    awk -v name="$name" -v limit="${UNIT_SECONDS:-120}" -v rc="$(cat "$work/$name.rc")" '
        # What a test says before its own line belongs to it; it is shown only when the test failed.
        function flush(show,   i) { if (show) for (i = 1; i <= n; i++) print "    | " said[i]; n = 0 }
        /^(TAP version|[0-9]+\.\.[0-9]+|# (not )?ok - )/ { next }
        /^(not )?ok [0-9]+.*# SKIP/ { sub(/.*# SKIP */, ""); print "skip " name "." $0 ": by itself"; ran++; failing = 0; n = 0; next }
        /^ok [0-9]+/     { sub(/^ok [0-9]+ *-? */, ""); print "ok " name "." $0; ran++; failing = 0; n = 0; next }
        /^not ok [0-9]+/ { sub(/^not ok [0-9]+ *-? */, ""); print "not ok " name "." $0; flush(1); failing = 1; bad++; ran++; next }
        failing          { print "    | " $0; next }
                         { said[++n] = $0 }
        END {
            if (rc == 124) { print "not ok " name; print "    still running after " limit " s"; flush(1) }
            else if (rc != 0 && !bad) { print "not ok " name; print "    exit status " rc " without a failed test"; flush(1) }
            else if (!ran) { print "not ok " name; print "    ran no test"; flush(1) }
        }' "$tap"
done
