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

# same NAME FILE FILE: byte for byte.
same() {
    if [ ! -s "$2" ]; then not_ok "$1" "$2 is empty"
    elif cmp "$2" "$3" >"$work/cmp" 2>&1; then ok "$1"
    else not_ok "$1" "bytes differ" "$work/cmp"; fi
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
