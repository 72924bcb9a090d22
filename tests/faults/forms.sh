# forms.sh -- what happens in a run is told alike in JSON and in NDJSON: every impact, in its order, with its time and words.
. tests/tools/lib.sh
"$FMDSUB" run -q -f ndjson decks/bounce-and-roll.yaml 2>"$work/err" >"$work/lines"
"$FMDSUB" run -q -f json decks/bounce-and-roll.yaml 2>>"$work/err" >"$work/whole"
sed -n 's/^{"type":"event",/{/p' "$work/lines" >"$work/wanted"
sed -n '/^"events":\[/,/^\]/p' "$work/whole" | sed -n 's/^,*\({"t":.*}\)$/\1/p' >"$work/there"
expect "events: there are some" yes "$([ "$(wc -l <"$work/wanted")" -gt 5 ] && echo yes)" "$work/err"
expect "events: a comma between them" "$(($(wc -l <"$work/wanted") - 1))" "$(sed -n '/^"events":\[/,/^\]/p' "$work/whole" | grep -c '^,{"t":')" "$work/whole"
[ -s "$work/wanted" ] || echo "no event" >"$work/wanted"
same "events: of JSON as of NDJSON" "$work/wanted" "$work/there"
