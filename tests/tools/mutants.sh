# mutants.sh -- random one-token mutants of src: how many of them does a test notice?
#
#     BUILD=build/mutants COUNTED=build/coverage sh tests/tools/mutants.sh          N (60) of them from SEED (1) on
#
# FILES: of these files only.  ONLY="3 7": these of them again; TESTS: by these tests and no others.
#
# A mutant is one comparison, sign, logical word or whole number changed, or one statement left out, in the body of a function.
# One that compiles to the same code is none, and lines with texts in them, sizes of memory and tables are left alone.
#
# It meets the tests of `make test` and `make long` that run its line (the counters of COUNTED, see reached.sh, say which), no others could
# notice it: the unit test of its file first and those of its folder; then the part of its folder (see part_of) and others,
# quickest first, until BUDGET (90) seconds of a processor are spent; the first that fails ends it.  What these do not notice
# meets those that `make asan` runs, reduce, plot and diff once more with its folder and the arena compiled for the address
# sanitizer: an index one too far is seen there.  What is left then meets the rest of them, REST (600) seconds of it, and is
# counted by itself where that notices.  What takes ten times as long as ever is killed, too.  A test of the program that notices
# has to pass without the mutant, then and there, or it counts for nothing: others may be at work on the machine.  At least 85
# percent have to be noticed.  Survivors are printed as they are.
. tests/tools/lib.sh
UNIT_SECONDS=900 DECK_SECONDS=600 BAD_SECONDS=60 BROWSER=none
export BROWSER BUILD UNIT_SECONDS DECK_SECONDS BAD_SECONDS
N=${N:-60} SEED=${SEED:-1} CC=${CC:-gcc} BUDGET=${BUDGET:-90} REST=${REST:-600} TESTS=${TESTS:-}
case $COUNTED in /*) ;; *) COUNTED=$PWD/$COUNTED ;; esac
FLAGS="-std=c11 -D_GNU_SOURCE -Isrc -O1 -fPIC -ffp-contract=off -fno-math-errno"
LIBS="-lyaml -lcjson -lm"
live=$BUILD/live
mkdir -p "$live" "$work/o" "$work/lines" "$work/x"
[ -d "$COUNTED/reached" ] || { echo "mutants: no counters in $COUNTED" >&2; exit 2; }

# ---- the programs and their tests, on two libraries that can be changed under them ----

objects=$(find "$BUILD/obj" -name '*.o' ! -path '*/obj/reduce/*' | sort)
reducing=$(find "$BUILD/obj/reduce" -name '*.o' 2>/dev/null | sort)
FORTRAN="-larpack -llapack -lblas"
on_library() { $CC -o "$1" $2 -L"$live" -Wl,-rpath,"$live" -Wl,--no-as-needed $4 -lfmdsub $3 $LIBS; }
$CC -shared -o "$live/libfmdsub.so" $objects $LIBS && cp "$live/libfmdsub.so" "$live/clean-fmdsub.so" || exit 2
on_library "$BUILD/fmdsub" "" "" "" || exit 2
for test in "$BUILD"/unit/t-*.o; do
    name=${test%.o}
    [ "$name" -nt "$test" ] || on_library "$name" "$test" -lcmocka "" || exit 2
done
if [ "$reducing" ]; then
    $CC -shared -o "$live/libreduce.so" $reducing $FORTRAN && cp "$live/libreduce.so" "$live/clean-reduce.so" || exit 2
    on_library "$BUILD/fmdsub-reduce" "" "$FORTRAN" -lreduce || exit 2
    for test in "$BUILD"/reduce/t-*.o; do on_library "${test%.o}" "$test" "-lcmocka $FORTRAN" -lreduce || exit 2; done
fi

now() { date +%s.%N; }
took() { awk "BEGIN { printf \"%.2f\", $(now) - $1 }"; }
seconds_of() { cat "$COUNTED/reached/$1/seconds"; }

# run ITEM: 0: it passes.  The processor's time is limited, and the clock's for one that waits for ever.
run() {
    seconds=$(seconds_of "$1")
    (
        ulimit -t "$(awk "BEGIN { print int($seconds * 10 + 10) }")"
        exec timeout "$(awk "BEGIN { print int($seconds * 40 + 120) }")" sh tests/tools/item.sh "$1"
    ) </dev/null >/dev/null 2>&1
}

# near FOLDER: the unit tests that include its headers.
near() { grep -l "\"$1/" tests/unit/t-*.c tests/reduce/t-*.c | sed 's|.*/\(.*\)\.c|\1|'; }

# lines_of FILE STAGE: which items run which of its lines, ITEM LINE, in a file whose name is printed; of stage 1 its own unit
# test and those of its folder, of stage 2 all others: counters are read where they are asked for.
lines_of() {
    room=$(basename "$(dirname "$1")") base=$(basename "$1" .c)
    list=$work/lines/$room-$base-$2
    [ -f "$list" ] || for item in "$COUNTED"/reached/*/seconds; do
        item=${item%/seconds}
        [ -f "$item/$room/$base.gcda" ] || continue
        stage=2
        grep -qx "${item##*/}" "$work/near" && stage=1
        [ $stage = "$2" ] || continue
        cp "$COUNTED/obj/$room/$base.gcno" "$item/$room/$base.gcda" "$work/x"
        gcov -t "$work/x/$base.gcda" 2>/dev/null | awk -v item="${item##*/}" -v file="$1" '
            / 0:Source:/ { own = substr($0, index($0, "Source:") + 7) == file }
            own && match($0, /^ *[-#=0-9]+\*?: *[0-9]+:/) {
                split($0, w, ":"); count = w[1]; gsub(/[ *]/, "", count)
                if (count != "-") reached = count !~ /[#=]/
                if (reached) print item, w[2] + 0
            }'
    done >"$list"
    echo "$list"
}

# part_of FOLDER: the part of `make test` that is about it, as a pattern of items.
part_of() {
    case $1 in
    film) echo '^animate$' ;;
    study) echo '^study-' ;;
    engine | multirate) echo '^order$' ;;
    cli) echo '^faults-' ;;
    deck | scene* | model | probe) echo '^(faults-sums|bad)$' ;;
    *) echo "^$1\$" ;;
    esac
}

# tests_of FILE LINE STAGE: items that run the line, in the order in which they are run; of stage 2 the part of its folder
# first, then the quickest, as many as BUDGET has time for; of stage 3 what REST has time for of the others.
tests_of() {
    own=t-$(basename "$1" .c) folder=$(basename "$(dirname "$1")")
    { echo "$own"; near "$folder"; } >"$work/near"
    awk -v line="$2" '$2 == line { print $1 }' "$(lines_of "$1" "$(test "$3" = 1 && echo 1 || echo 2)")" | while read -r item; do
        case $item in install | fuzz) ;; *) echo "$item $(seconds_of "$item")" ;; esac
    done | awk -v own="$own" -v part="$(part_of "$folder")" '{ print $1 == own ? 0 : $1 ~ part ? 1 : 2, $2, $1 }' |
        sort -k1n -k2n | awk -v budget="$BUDGET" -v rest="$REST" -v late="$(test "$3" = 3 && echo 1 || echo 0)" '
            $1 < 2 { if (!late) print $3; next }
            sum + $2 <= budget { sum += $2; if (!late) print $3; next }
            late && after + $2 <= rest { after += $2; print $3 }'
}

# ---- mutants ----

cat >"$work/find.awk" <<'END'
# file line column length class new: every place that could be changed.  Comments are masked.
function put(class, at, len, new) { print FILENAME, FNR, at, len, class, new }
function scan(class, from, new,    at, rest, k) {
    rest = $0
    at = 0
    while ((k = index(rest, from)) > 0) {
        put(class, at + k, length(from), new)
        at += k + length(from) - 1
        rest = substr(rest, k + length(from))
    }
}
FNR == 1 { body = comment = 0 }
/^{/ { body = 1; next }
/^}/ { body = 0; next }
!body { next }
{
    if (comment) { if (/\*\//) comment = 0; next }
    if (/\/\*/) { if (!/\*\//) comment = 1; sub(/\/\*.*/, "") }
    if (/"|'|static const|TAKE|sizeof|assert|^ *(const )?char |^ *enum |^ *case |^ *#|arena_more|(room|capacity) = |^ *(struct|double|int|unsigned)[^=;]*;/) next
    scan("compare", " < ", " <= "); scan("compare", " <= ", " < "); scan("compare", " > ", " >= "); scan("compare", " >= ", " > ")
    scan("compare", " == ", " != "); scan("compare", " != ", " == ")
    scan("logic", " && ", " || "); scan("logic", " || ", " && "); scan("logic", "(!", "(")
    scan("sign", " + ", " - "); scan("sign", " - ", " + "); scan("sign", " += ", " -= "); scan("sign", " -= ", " += ")
    scan("sign", " * ", " / "); scan("sign", "= -", "= "); scan("sign", "(-", "("); scan("sign", "return -", "return ")
    rest = $0; at = 0
    while (match(rest, /[^A-Za-z_0-9.][0-9]+[^A-Za-z_0-9.]/)) {
        put("number", at + RSTART + 1, RLENGTH - 2, substr(rest, RSTART + 1, RLENGTH - 2) + 1)
        at += RSTART; rest = substr(rest, RSTART + 1)
    }
    if (/^ +[A-Za-z_*(][^;]*;$/ && last ~ /[;{}]$/ && !/^ *(return|break|continue|goto|if|for|while|do|else|const|struct|enum|int|double|bool|char|size_t|void|long|unsigned|static|FILE|TRY\(.*fail)/)
        put("left-out", match($0, /[^ ]/), length($0) - match($0, /[^ ]/), "")
    last = $0
}
END
awk -f "$work/find.awk" ${FILES:-$(if [ "$reducing" ]; then ls src/*/*.c; else ls src/*/*.c | grep -v ^src/reduce/; fi)} | LC_ALL=C sort >"$work/places"
for class in compare logic sign number left-out; do awk -v c=$class '$5 == c' "$work/places" >"$work/places-$class"; done

seed=$(awk -v s="$SEED" 'BEGIN { print (s * 7919 + 12345) % 2147483647 }')
throw() { # MOST: into $thrown, 1 ... MOST
    seed=$(awk -v s="$seed" 'BEGIN { printf "%d", (s * 16807) % 2147483647 }')
    thrown=$(awk -v s="$seed" -v n="$1" 'BEGIN { print 1 + int(s / 2147483647 * n) }')
}

# compile FILE LINE COLUMN LENGTH NEW: as $work/m.o; 1: it is no mutant.
compile() {
    cp "$1" "$work/m.c"
    $CC $FLAGS -w -c -o "$work/o/same.o" "$work/m.c" || exit 2
    awk -v line="$2" -v at="$3" -v len="$4" -v new="$5" 'NR == line { $0 = substr($0, 1, at - 1) new substr($0, at + len) } { print }' "$1" >"$work/m.c"
    $CC $FLAGS -w -c -o "$work/m.o" "$work/m.c" 2>/dev/null && ! cmp -s "$work/m.o" "$work/o/same.o"
}

# put FROM LIBRARY: under the programs; by its name, for what runs may still have the old one.
put() { cp "$1" "$live/next.so" && mv "$live/next.so" "$live/lib$2.so"; }

# join FILE OBJECT LIBRARY [OTHER...]: the library with OBJECT for FILE, as $work/mutant.so; OTHERs take the place of the rest of
# its folder and of the arena, too.
join() {
    joined=$3
    case $joined in reduce) of=$reducing extra=$FORTRAN ;; *) of=$objects extra= ;; esac
    object=$BUILD/obj/${1#src/}
    echo "$of" | grep -vxF "${object%.c}.o" >"$work/objects"
    shift
    if [ $# -gt 2 ]; then
        grep -v "^${object%/*}/\|/obj/base/\(arena\|limits\)\.o\$" "$work/objects" >"$work/others"
        mv "$work/others" "$work/objects"
    fi
    with=$1
    shift 2
    $CC -shared -o "$work/mutant.so" $(cat "$work/objects") "$with" "$@" $extra $LIBS
}

# guarded ITEM: run with the sanitizer under it.
guarded() {
    (
        LD_PRELOAD=$($CC -print-file-name=libasan.so) ASAN_OPTIONS=detect_leaks=0
        export LD_PRELOAD ASAN_OPTIONS
        run "$1"
    )
}

# watched FILE...: compiled for the sanitizer, once; their objects.
watched() {
    for file; do
        object=$work/watched/$(echo "$file" | tr / -).o
        [ -f "$object" ] || $CC $FLAGS -g -w -fsanitize=address -c -o "$object" "$file" || return
        echo "$object"
    done
}

# sanitized FILE LINE: what notices it there, in $killer: with its folder compiled for the sanitizer, which may write for it.
# Texts of the sanitizer are no report of ours.
sanitized() {
    case $1 in src/base/arena.c | src/base/limits.c) return ;; esac
    mkdir -p "$work/watched"
    own=$(watched "$1") && $CC $FLAGS -g -w -fsanitize=address -c -o "$work/m.o" "$work/m.c" || return
    others=$(watched $(ls "$(dirname "$1")"/*.c src/base/arena.c src/base/limits.c | sort -u | grep -vxF "$1")) || return
    join "$1" "$own" $library $others && mv "$work/mutant.so" "$work/same.so" || return
    join "$1" "$work/m.o" $library $others || return
    put "$work/mutant.so" $library
    for item in $({ tests_of "$1" "$2" 1; tests_of "$1" "$2" 2; } | grep '^t-\|^decks-\|^bad$\|^reduce$\|^plot$\|^diff$'); do
        guarded "$item" && continue
        put "$work/same.so" $library
        guarded "$item" && { killer=$item,sanitized; break; }
        put "$work/mutant.so" $library
    done
}

# passes ITEM LIBRARY: without the mutant; asked of a unit test once.
passes() {
    case $1 in t-*) [ -f "$work/passes-$1" ] && return ;; esac
    put "$live/clean-$2.so" "$2"
    run "$1"
    passed=$?
    put "$work/mutant.so" "$2"
    [ $passed = 0 ] && touch "$work/passes-$1" || echo "$1 fails without a mutant: it counts for nothing" >&2
    return $passed
}

# meet ITEM...: the first that notices the mutant, in $killer.
meet() {
    put "$work/mutant.so" $library
    for item; do
        met=$((met + 1))
        run "$item" || ! passes "$item" $library || { killer=$item; return; }
    done
}

# judge FILE LINE: what notices the mutant, in $killer; "": nothing.  late=1: only the rest of `make test` does.
judge() {
    case $1 in src/reduce/*) library=reduce ;; *) library=fmdsub ;; esac
    join "$1" "$work/m.o" $library && cp "$work/mutant.so" "$work/alone.so" || exit 2
    killer= met=0 late=0
    if [ "$TESTS" ]; then meet $TESTS
    else
        meet $(tests_of "$1" "$2" 1; tests_of "$1" "$2" 2)
        [ "$killer" ] || sanitized "$1" "$2"
        cp "$work/alone.so" "$work/mutant.so"
        [ "$killer" ] || { meet $(tests_of "$1" "$2" 3); late=1; }
    fi
    put "$live/clean-$library.so" $library
}

echo "mutants: N=$N SEED=$SEED BUDGET=$BUDGET REST=$REST, $(wc -l <"$work/places") places"
made=0 dead=0 slow=0
while [ $made -lt "$N" ]; do
    throw 5
    class=$(echo compare logic sign number left-out | cut -d ' ' -f "$thrown")
    throw "$(wc -l <"$work/places-$class")"
    sed -n "${thrown}p" "$work/places-$class" >"$work/place"
    read -r file line at len class new <"$work/place"
    case $class in left-out | number) ;; *) new=$(cut -d ' ' -f 6- "$work/place") ;; esac
    compile "$file" "$line" "$at" "$len" "$new" || continue
    made=$((made + 1))
    case " ${ONLY:-$made} " in *" $made "*) ;; *) continue ;; esac
    start=$(now)
    judge "$file" "$line"
    was=$(sed -n "${line}p" "$file" | sed 's/^ *//')
    echo "$([ "$killer" ] && { [ $late = 1 ] && echo "late    " || echo "killed  "; } || echo SURVIVES) $made $file:$line:$at $class '$(sed -n "${line}p" "$file" | cut -c "$at-$((at + len - 1))")' -> '$new': $was  [${killer:-nothing}, $met tests, $(took "$start") s]"
    [ -z "$killer" ] || { dead=$((dead + 1)) slow=$((slow + late)); }
done
awk -v dead=$dead -v slow=$slow -v n="$N" 'BEGIN {
    printf "mutants: %d of %d killed, %.0f percent, %d of them by the rest of make test\n", dead, n, 100 * dead / n, slow
    exit dead < 0.85 * n }'
