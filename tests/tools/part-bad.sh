# part-bad.sh -- decks that are wrong, and what each must get.
#
# tests/bad/NAME.yaml, or NAME.sh which prints the deck, with NAME.expect:
#
#     exit 3                    the exit status
#     args --set a.b=1          more arguments of `fmdsub run` (optional)
#     NAME.yaml:4:7: error: ... every further line must stand in stderr, in this order; the first one
#                               first of all; a line that ends with ... fixes its beginning only
#
# Rules for all: nothing on stdout, an answer within a second (more under a sanitizer), no raw
# control bytes on stderr.
. tests/tools/lib.sh

for expected in tests/bad/*.expect; do
    [ -f "$expected" ] || continue
    name=${expected##*/}
    name=${name%.expect}
    if [ -f "tests/bad/$name.sh" ]; then (cd "$work" && sh "$ROOT/tests/bad/$name.sh" >"$name.yaml")
    else cp "tests/bad/$name.yaml" "$work/$name.yaml"; fi
    want=$(awk '$1 == "exit" { print $2; exit }' "$expected")
    args=$(sed -n 's/^args //p' "$expected")
    (cd "$work" && eval "timeout ${BAD_SECONDS:-5} '$FMDSUB' run $args $name.yaml" >out 2>err </dev/null)
    rc=$?
    if [ $rc != "$want" ]; then not_ok "$name" "exit $rc, expected $want" "$work/err"; continue; fi
    if [ -s "$work/out" ]; then not_ok "$name" "bytes on stdout" "$work/out"; continue; fi
    if LC_ALL=C tr -d '\12\40-\176\200-\377\11' <"$work/err" | grep -q .; then
        not_ok "$name" "control bytes on stderr"; continue
    fi
    if awk -v expected="$expected" '
        BEGIN { while ((getline line < expected) > 0) if (line !~ /^(exit|args) /) want[++n] = line; at = 1 }
        at <= n {
            w = want[at]
            if (w ~ /\.\.\.$/) hit = index($0, substr(w, 1, length(w) - 3)) == 1
            else hit = $0 == w
            if (hit) at++
            else if (NR == 1) exit
        }
        END { exit at <= n }' "$work/err"; then ok "$name"
    else
        grep -v '^exit \|^args ' "$expected" >"$work/wanted"
        not_ok "$name" "stderr is not what was expected; wanted, then got:" "$work/wanted" "$work/err"
    fi
    rm -f "$work/$name.yaml"
done
