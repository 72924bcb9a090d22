# selftest.sh -- the program's own references, with the machine's mathematics and with a sine that is off by a millionth.
. tests/tools/lib.sh
"$FMDSUB" selftest >"$work/out" 2>"$work/err"
expect "selftest: status, references" "0 11 0" "$? $(grep -c '^ok ' "$work/out") $(grep -c '^not ok' "$work/out")" "$work/out" "$work/err"
LD_PRELOAD=$BUILD/tools/badsine.so "$FMDSUB" selftest -q >"$work/out" 2>"$work/err"
expect "selftest: a sine off by a millionth: status, told" "70 1" "$? $(grep -c 'references are not met' "$work/err")" "$work/out" "$work/err"
[ -s "$work/out" ] && ok "selftest -q: only what is wrong" || not_ok "selftest -q: only what is wrong" "nothing said"
# No deck can be held: nothing is met, that a wrong one is refused neither.
(
    ulimit -f 0
    trap '' XFSZ
    "$FMDSUB" selftest 2>&1
    echo "status $?"
) | cat >"$work/out"
expect "selftest: no room for decks: status, told" "1 1 11 0" \
    "$(grep -c '^status 70' "$work/out") $(grep -c '11 of 11 references are not met' "$work/out") $(grep -c '^not ok' "$work/out") $(grep -c '^ok' "$work/out")" "$work/out"
