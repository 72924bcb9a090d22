# table.sh -- every deck of tests/validation run, its published figures beside ours.
#
#     sh tests/validation/table.sh [option of fmdsub run ...]
#
# Exit: 0 if all are met, 1 if not.
FMDSUB=${FMDSUB:-${BUILD:-build}/fmdsub}
here=$(dirname "$0")
run=$(mktemp "${TMPDIR:-/tmp}/fmdsub-validation.XXXXXX")
trap 'rm -f "$run" "$run.err"' EXIT
trap 'exit 130' INT TERM

{
    printf '%-21s %5s  %-18s %14s %14s %11s %9s\n' case t quantity theirs ours difference limit
    for deck in "$here"/*.yaml; do
        "$FMDSUB" run -q "$@" "$deck" >"$run" 2>"$run.err" || { echo "$deck: exit status $?"; cat "$run.err"; } >&2
        [ -s "$run" ] || echo t >"$run"
        awk -f "tests/tools/figures.awk" "$deck" "$run"
    done
} | awk '
    { print }
    NR > 1 { n++; cases[$1]; if ($NF == "beyond") beyond++; else if ($6 > worst * $7) worst = $6 / $7 }
    END {
        for (c in cases) m++
        printf "%d cases, %d figures, %d beyond their limits, all others within %.2f of them\n", m, n, beyond, worst
        exit beyond > 0 || n == 0
    }'
