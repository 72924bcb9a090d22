# advice.sh -- the advice of check, followed: found errors are at most five times what was promised, also where loads and drives
# have corners in time, forces jump by the state, or the deck has a tolerance.  On five plain decks: tests/study/advice.sh.
. tests/tools/lib.sh
MOST=5e5 sh tests/tools/advice.sh tests/advice/*.yaml >"$work/advice" 2>&1
rc=$?
expect "advice followed where forces jump: $(tail -n 1 "$work/advice")" 0 $rc "$work/advice"
