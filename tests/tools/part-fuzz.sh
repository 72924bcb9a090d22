# part-fuzz.sh -- the harnesses of the fuzzers without clang: they read their corpus (tests/fuzz/corpus: what broke one once, and
# what reaches most of the readers), and the project's own decks, right and wrong.
. tests/tools/lib.sh

replay() { # HARNESS FILES...
    harness=$1
    shift
    timeout 100 "$BUILD/fuzz/$harness" "$@" >"$work/read" 2>"$work/err"
    rc=$?
    tail -n 1 "$work/read" >"$work/last"
    expect "$harness: $# files" "0 read $#" "$rc $(cat "$work/last")" "$work/last" "$work/err"
}

for folder in tests/fuzz/corpus/*/; do replay "$(basename "$folder")" "$folder"*; done
replay deck decks/*.yaml tests/decks/*.yaml tests/bad/*.yaml tests/decks-by-users/*.yaml tests/validation/*.yaml
replay body tests/decks/*.json
replay table decks/*.csv tests/decks-by-users/*.csv
