# mutants.sh -- random one-token mutants of src: how many of them does a test notice?
#
#     BUILD=build/mutants sh tests/tools/mutants.sh          N (60) of them from SEED (1) on
#
# FILES: of these files only.  ONLY="3 7": these of them again; TESTS: by these tests and no others.
#
# A mutant is one comparison, sign, logical word or whole number changed, or one statement left out, in the body of a function.
# One that compiles to the same code is none, and lines with texts in them, sizes of memory and tables are left alone.  It meets
# the unit tests of its file and its folder, then whatever else there is, quickest first, of unit tests, wrong decks, decks
# against their records, faults and hard cases, about 40 seconds of an idle processor in all; what takes ten times as long as ever is killed, too.  At
# least 85 percent have to be.  Survivors are printed as they are.
. tests/tools/lib.sh
export BUILD
N=${N:-60} SEED=${SEED:-1} CC=${CC:-gcc} BUDGET=${BUDGET:-40}
FLAGS="-std=c11 -D_GNU_SOURCE -Isrc -O1 -fPIC -ffp-contract=off -fno-math-errno"
LIBS="-lyaml -lcjson -lm"
live=$BUILD/live
mkdir -p "$live" "$work/o"

# ---- the program and its tests, on one library that can be changed under them ----

objects=$(find "$BUILD/obj" -name '*.o' ! -path '*/obj/reduce/*' | sort)
$CC -shared -o "$live/libfmdsub.so" $objects $LIBS || exit 2
on_library() { $CC -o "$1" $2 -L"$live" -Wl,-rpath,"$live" -Wl,--no-as-needed -lfmdsub $3 $LIBS; }
on_library "$BUILD/fmdsub" "" "" || exit 2
for test in "$BUILD"/unit/t-*.o; do
    name=${test%.o}
    [ "$name" -nt "$test" ] || on_library "$name" "$test" -lcmocka || exit 2
done

# run ITEM: 0: it passes.
run() {
    case $1 in
    t-*) "$BUILD/unit/$1" ;;
    decks-*) ! D=${1#decks-} sh tests/tools/part-decks.sh | grep -m 1 '^not ok' ;;
    faults-* | hard-*) ! sh "tests/$(echo "$1" | sed 's|-|/|').sh" | grep -m 1 '^not ok' ;;
    *) ! sh "tests/tools/part-$1.sh" | grep -m 1 '^not ok' ;;
    esac
} >/dev/null 2>&1

now() { date +%s.%N; }
took() { awk "BEGIN { printf \"%.2f\", $(now) - $1 }"; }

# What there is, with its time.
items="bad man faults-arguments faults-check faults-warnings faults-names hard-drawn hard-told hard-counts hard-branches"
for deck in decks/*.yaml tests/decks/*.yaml; do items="$items decks-$(basename "$deck" .yaml)"; done
for test in "$BUILD"/unit/t-*.o; do items="$items $(basename "$test" .o)"; done
touch "$BUILD/times"
for item in $items; do
    grep -q "^$item " "$BUILD/times" && continue
    start=$(now)
    run "$item" && echo "$item $(took "$start")" >>"$BUILD/times" || echo "$item fails without a mutant, it is left out" >&2
done

# tests_of FILE: items in the order in which they are run.
tests_of() {
    own=t-$(basename "$1" .c) folder=$(basename "$(dirname "$1")")
    grep -l "\"$folder/" tests/unit/t-*.c | sed 's|.*/\(.*\)\.c|\1|' >"$work/near"
    awk -v own="$own" -v near="$work/near" -v folder="$folder" '
        BEGIN { while ((getline name < near) > 0) of[name] = 1 }
        {
            rank = $1 == own ? 0 : $1 in of ? 1 : $1 ~ /^(bad|man|faults-)/ ? (folder ~ /^(deck|expr|scene|base|cli|out)/ ? 1 : 2) : 2
            print rank, $2, $1
        }' "$BUILD/times" | sort -k1n -k2n | awk -v budget="$BUDGET" '$1 < 1 || sum + $2 <= budget { sum += $2; print $3, $2 }'
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
    if (/"|'|static const|TAKE|sizeof|assert|^ *(const )?char |^ *enum |^ *case |^ *#|arena_more|^ *(struct|double|int|unsigned)[^=;]*;/) next
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
awk -f "$work/find.awk" ${FILES:-$(ls src/*/*.c | grep -v ^src/reduce/)} | LC_ALL=C sort >"$work/places"
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

# judge FILE: what notices the mutant, in $killer; "": nothing.
judge() {
    object=$BUILD/obj/${1#src/}
    object=${object%.c}.o
    $CC -shared -o "$live/next.so" $(echo "$objects" | grep -vxF "$object") "$work/m.o" $LIBS && mv "$live/next.so" "$live/libfmdsub.so" || exit 2
    killer=
    if [ "${TESTS:-}" ]; then for item in $TESTS; do echo "$item $(awk -v i="$item" '$1 == i { print $2 }' "$BUILD/times")"; done
    else tests_of "$1"; fi >"$work/tests"
    while read -r item seconds; do
        timeout "$(awk "BEGIN { print int(${seconds:-1} * 10 + 10) }")" sh "$work/one.sh" "$item" </dev/null >/dev/null 2>&1 ||
            { killer=$item; break; }
    done <"$work/tests"
}
{ echo 'set -u'; sed -n '/^run() {/,/^}/p' tests/tools/mutants.sh; echo 'run "$1"'; } >"$work/one.sh"

echo "mutants: N=$N SEED=$SEED, $(wc -l <"$work/places") places"
made=0 dead=0
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
    judge "$file"
    was=$(sed -n "${line}p" "$file" | sed 's/^ *//')
    echo "$([ "$killer" ] && echo "killed  " || echo SURVIVES) $made $file:$line:$at $class '$(sed -n "${line}p" "$file" | cut -c "$at-$((at + len - 1))")' -> '$new': $was  [${killer:-nothing}, $(took "$start") s]"
    [ -z "$killer" ] || dead=$((dead + 1))
done
rm -f "$live/libfmdsub.so" # a mutant
awk -v dead=$dead -v n="$N" 'BEGIN { printf "mutants: %d of %d killed, %.0f percent\n", dead, n, 100 * dead / n; exit dead < 0.85 * n }'
