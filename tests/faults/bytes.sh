# bytes.sh -- decks with one byte replaced, put in or left out: check says what is wrong, or reads them; it never dies of one.
#
# N of them (200) from seed SEED (1) on; what went wrong is kept in KEEP.
. tests/tools/lib.sh
"$BUILD/tools/bytes" "$FMDSUB" "${KEEP:-$work}" "${N:-200}" "${SEED:-1}" decks/*.yaml tests/decks/*.yaml >"$work/said"
rc=$?
expect "decks with one byte changed: $(tail -n 1 "$work/said")" "0 yes" "$rc $(grep -q ': [0-9]* end with 0 .*[0-9] end with 3' "$work/said" && echo yes)" "$work/said"
