# schema.sh -- fmdsub schema has every key that `fmdsub list sections` has of joints, forces, surfaces, contacts and maps, kind by kind.
. tests/tools/lib.sh
"$FMDSUB" schema >"$work/schema" 2>"$work/err"
ended "schema" 0 $? "$work/schema" "$work/err"
"$FMDSUB" list sections -f json 2>>"$work/err" | sed -n 's/^,*{"section":"\([^"]*\)","kind":"\([^"]*\)","key":"\([^"]*\)".*"required":"\([a-z]*\)".*/\1 \2;\3;\4/p' >"$work/rows"
awk -F ';' '
    { split($1, at, " "); name = at[2] }
    name == "" { n = split(at[1], part, "."); name = part[n] }
    at[1] ~ /^(constraints|forces|surfaces|contacts|measures)\.NAME$|^(integrate|output|checkpoint|energy)$/ { print name, $2 }' "$work/rows" | sort -u >"$work/wanted"
awk '
    { match($0, /^\t*/); depth = RLENGTH; line = substr($0, depth + 1) }
    line ~ /^"properties":\t\{/ { from = depth; n[depth] = 0; inside[depth] = 1; next }
    inside[depth - 1] && match(line, /^"[a-z_0-9]*":\t\{/) { key[depth - 1, ++n[depth - 1]] = substr(line, 2, RLENGTH - 5) }
    line ~ /^\}/ { inside[depth] = 0 }
    line ~ /^"title":/ { split(line, word, "\""); for (i = 1; i <= n[depth]; i++) print word[4], key[depth, i] }' "$work/schema" | sort -u >"$work/there"
expect "schema: keys of kinds there are" yes "$([ "$(wc -l <"$work/wanted")" -gt 100 ] && echo yes)" "$work/err"
expect "schema: every key of every kind" "" "$(comm -23 "$work/wanted" "$work/there" | head -n 5)$([ -s "$work/there" ] || echo "no keys")"
# A choice is one of several, one kind alone stands for itself: bodies, joints, measures, tables, signals, forces, surfaces, partition.
expect "schema: choices, and those of one kind" "8 0" "$(awk '
    { match($0, /^\t*/); depth = RLENGTH }
    /"anyOf":\t\[/ { open[depth] = all++ + 1; n[depth] = 1 }
    /^\t*\}, \{$/ && depth in open { n[depth]++ }
    /^\t*\}\]/ && depth in open { lone += n[depth] < 2; delete open[depth] }
    END { print all + 0, lone + 0 }' "$work/schema")" "$work/err"
