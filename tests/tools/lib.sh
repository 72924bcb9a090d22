# lib.sh -- what every part of the tests sources.
#
# A part prints one line per test: `ok NAME`, `not ok NAME` with its reason indented below, `known NAME: DEFECT` for a failure
# that is on a list of known ones, or `skip NAME: why`.  tests/run counts them.  Needs only sh, awk, sed and coreutils.
set -u
BUILD=${BUILD:-build}
case $BUILD in /*) ;; *) BUILD=$PWD/$BUILD ;; esac
ROOT=$PWD
FMDSUB=$BUILD/fmdsub
COMPARE=$BUILD/tools/compare
LC_ALL=C
export LC_ALL FMDSUB
unset LANG LANGUAGE 2>/dev/null || true

work=$(mktemp -d "${TMPDIR:-/tmp}/fmdsub-test.XXXXXX")
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM

ok() { echo "ok $1"; }
skip() { echo "skip $1: $2"; }
known() { echo "known $1: $2"; }

# Is a scheme in this build?
has_scheme() { "$FMDSUB" list schemes | grep "^$1 " | grep -qv 'not in this build'; }

# not_ok NAME REASON [FILE...]: the files are shown, indented.
not_ok() {
    echo "not ok $1"
    echo "    $2"
    shift 2
    for file in "$@"; do [ -s "$file" ] && head -n 40 "$file" | sed 's/^/    | /'; done
    return 0
}

# expect NAME WANTED GOT [FILE...]: exit codes and other words.
expect() {
    expect_name=$1 expect_want=$2 expect_got=$3
    shift 3
    if [ "$expect_want" = "$expect_got" ]; then ok "$expect_name"
    else not_ok "$expect_name" "got '$expect_got', expected '$expect_want'" "$@"; fi
}

# ended NAME WANTED STATUS OUT [FILE...]: with the status wanted, and one that ends well has something to show for it in OUT.
ended() {
    ended_name=$1 ended_want=$2 ended_got=$3 ended_out=$4
    shift 4
    if [ "$ended_got" != "$ended_want" ]; then not_ok "$ended_name" "exit $ended_got, expected $ended_want" "$@"
    elif [ "$ended_want" = 0 ] && [ ! -s "$ended_out" ]; then not_ok "$ended_name" "nothing was written" "$@"
    else ok "$ended_name"; fi
}

# wrote FILE: that, if there is anything in it; beside "nothing is told", which an empty program tells as well.
wrote() { [ -s "$1" ] && echo wrote; }

# same NAME FILE FILE: byte for byte.
same() {
    if [ ! -s "$2" ]; then not_ok "$1" "$2 is empty"
    elif cmp "$2" "$3" >"$work/cmp" 2>&1; then ok "$1"
    else not_ok "$1" "bytes differ" "$work/cmp"; fi
}

# go NAME STATUS [ARGUMENT...]: runs the deck on stdin; its last record in $last, $work/out and $work/err for the next two.
go() {
    go_name=$1 go_want=$2
    shift 2
    cat >"$work/deck.yaml"
    "$FMDSUB" run "$@" "$work/deck.yaml" >"$work/out" 2>"$work/err"
    ended "$go_name: status" "$go_want" $? "$work/out" "$work/err"
    last=$(tail -n 1 "$work/out")
}

# told NAME PATTERN: words or events of that run.
told() { if grep -q -- "$2" "$work/err" "$work/out"; then ok "$1: told"; else not_ok "$1: told" "'$2' is not in" "$work/err"; fi; }

# near NAME RECORD RECORD LIMIT: numbers side by side.
near() {
    printf '%s\n%s\n' "$2" "$3" | awk -F, -v limit="$4" '
        NR == 1 { for (i = 1; i <= NF; i++) a[i] = $i; n = NF }
        NR == 2 { for (i = 1; i <= NF; i++) { d = $i - a[i]; if (d < 0) d = -d; if (d > most) most = d }; same = NF == n && n > 1 }
        END { print most; exit !(same && most <= limit) }' >"$work/near" &&
        ok "$1" || not_ok "$1" "$2 and $3 differ by more than $4" "$work/near" "$work/err"
}

# refuse STATUS PATTERN ARGUMENT...: the program ends so, with one line that says why, and nothing on stdout.
refuse() {
    refuse_want=$1 refuse_pattern=$2
    shift 2
    "$FMDSUB" "$@" >"$work/out" 2>"$work/err" </dev/null
    refuse_got=$?
    if [ $refuse_got -ne "$refuse_want" ]; then not_ok "fmdsub $*" "exit $refuse_got, expected $refuse_want" "$work/err"
    elif [ -s "$work/out" ]; then not_ok "fmdsub $*" "words on stdout" "$work/out"
    elif [ "$(wc -l <"$work/err")" -ne 1 ] || ! grep -q -- "$refuse_pattern" "$work/err"; then not_ok "fmdsub $*" "expected one line with: $refuse_pattern" "$work/err"
    else ok "refused: $(echo "$*" | sed "s|$ROOT/||g")"; fi
}

# wanted NAME: whether it contains one of the words of D, if there are any.
D=${D:-}
wanted() {
    for word in $(echo "$D" | tr , ' '); do
        case $1 in *$word*) return 0 ;; esac
    done
    [ -z "$D" ]
}

# One failure instead of hundreds where the program is not there, or is another: one that does nothing and ends with 0.
need_program() {
    [ -x "$FMDSUB" ] && [ -x "$COMPARE" ] && case $("$FMDSUB" --version 2>/dev/null) in "fmdsub "[0-9]*) return ;; esac
    echo "not ok $1: $FMDSUB or its tools are not built"
    exit 0
}
