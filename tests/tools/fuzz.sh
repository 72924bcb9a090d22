# fuzz.sh -- each harness named, fed by libFuzzer for FOR seconds (60) from its corpus, the project's own files of that kind and
# what former runs have reached.
#
# What breaks one is left as BUILD/fuzz/NAME-*: once cured it goes to tests/fuzz/corpus/NAME, where part-fuzz.sh reads it.
# MERGE=1 brings a small set of files that reaches what has been reached into the corpus.
set -u
status=0
words=$BUILD/fuzz/words seeds=$BUILD/fuzz/seeds
mkdir -p "$BUILD/fuzz"
"$PROGRAM" schema | grep -o '"[a-z_0-9]*"' | sort -u >"$words"
for word in sin atan2 hypot pow mod floor if min max abs log exp and or not '<=' '!=' '^' '${' '<<' '&a' '*a' '- '; do echo "\"$word\""; done >>"$words"

# The files that a harness starts from, beside its corpus.
seeds_of() {
    case $1 in
    deck) cp decks/*.yaml tests/decks/*.yaml tests/bad/*.yaml tests/decks-by-users/*.yaml tests/validation/*.yaml "$seeds"
        rm "$seeds"/airscrew* ;; # slow
    body) cp tests/decks/*.json "$seeds" ;;
    table) cp decks/*.csv tests/decks-by-users/*.csv "$seeds" ;;
    expression)
        grep -ho '"[^"]*[-+*/(][^"]*"' decks/*.yaml tests/decks/*.yaml | sort -u |
            awk -v to="$seeds" '{ gsub(/"/, ""); file = to "/" NR; printf "%c%s", NR % 90 + 33, $0 >file; close(file) }' ;;
    esac
}

for name in "$@"; do
    reached=$BUILD/reached/$name corpus=tests/fuzz/corpus/$name
    rm -rf "$seeds"
    mkdir -p "$seeds" "$reached" "$corpus"
    seeds_of "$name"
    echo "== $name"
    case $name in deck) most=1500 ;; body) most=2500 ;; *) most=300 ;; esac
    if [ "${MERGE:-}" ]; then set -- -set_cover_merge=1 -max_len=$most "$corpus" "$reached"
    else set -- -max_total_time="${FOR:-60}" -max_len=4096 "$reached" "$corpus" "$seeds"; fi
    ASAN_OPTIONS=allocator_may_return_null=1:detect_leaks=1 "$BUILD/fuzz/$name" -timeout=100 -rss_limit_mb=2500 \
        -malloc_limit_mb=1500 -artifact_prefix="$BUILD/fuzz/$name-" -dict="$words" "$@" \
        >"$BUILD/fuzz/$name.log" 2>&1 || { status=1; grep -v '^#' "$BUILD/fuzz/$name.log" | tail -n 60; }
    grep 'DONE\|^Done\|^MERGE-OUTER: .* new ' "$BUILD/fuzz/$name.log"
done
exit $status
