# restarted.sh -- a run and its continuation from --final-state beside the run that was not stopped, for what sources this behind lib.sh:
# in $work, beside copies of all decks.
MAJORS=${MAJORS:-48}
cd "$work" || exit 1
cp "$ROOT"/decks/*.* "$ROOT"/decks/airscrew/* . && cp "$ROOT"/tests/decks/*.yaml "$ROOT"/tests/decks/*.json . || exit 1

# step, ratio of a deck; of one with steps of its own a thousandth of the run.
plan() {
    "$FMDSUB" check --expanded "$1" 2>/dev/null | awk '
        /^integrate:/ { on = 1 } /^[a-z]/ && !/^integrate:/ { on = 0 }
        on { gsub(/[{},]/, " "); for (i = 1; i < NF; i++) { if ($i == "step:") step = $(i + 1); if ($i == "ratio:") ratio = $(i + 1); if ($i == "until:" || $i == "latest:") until = $(i + 1) + 0 ? $(i + 1) : until; if ($i == "tolerance:") own = 1 } }
        END { if (step) print step, ratio ? ratio : 1, 0; else print until / 1000, 1, own + 0 }'
}

# one_run NAME DECK MAJORS SETTINGS...: prints why not.
one_run() {
    deck=$1 half=$(awk "BEGIN { printf \"%.12g\", $H * int($2 / 2) }") whole=$(awk "BEGIN { printf \"%.12g\", $H * $2 }")
    shift 2
    "$FMDSUB" run -q --columns '*' $every "$@" --until $whole $deck >whole 2>err
    rc=$?
    [ $rc -le 1 ] || { echo "skipped: $(tail -n 1 err)"; return; }
    "$FMDSUB" run -q --columns '*' $every "$@" --until $half --final-state half.json $deck >first 2>err
    "$FMDSUB" run -q --columns '*' $every "$@" --until $whole -s 'initial={from: half.json, time: keep}' $deck >rest 2>err
    [ $? = $rc ] || { echo "the rest ends with another status: $(tail -n 1 err)"; return; }
    [ "$(wc -l <whole)" -gt 2 ] || { echo "no records"; return; }
    { cat first; sed 1,2d rest; } >both
    [ "$(tail -n 1 first)" = "$(sed -n 2p rest)" ] || { echo "the first record of the rest is not the last one before it"; return; }
    cmp whole both 2>&1
}
