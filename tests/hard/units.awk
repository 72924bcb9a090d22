# units.awk -- is the second record the first in other units?  Both with --units, all columns but those of modes, whose unit is none, and of iterations
#
#     -v l=L -v m=M -v s=S      its lengths, masses and times in those of the first
#     -v apart=SHARE            how far they may be apart, of the largest number of that unit
function power(word,    n) {
    n = match(word, /-?[0-9]+$/) ? substr(word, RSTART) + 0 : 1
    sub(/-?[0-9]+$/, "", word)
    return of(word) ^ n
}
function of(name) {
    if (name == "m") return l
    if (name == "kg") return m
    if (name == "s") return s
    if (name == "N") return m * l / s^2
    if (name == "J") return m * l^2 / s^2
    if (name == "W") return m * l^2 / s^3
    if (name == "Pa") return m / l / s^2
    if (name != "rad" && name != "1" && name != "") unknown = name
    return 1
}
function factor(text,    part, word, i, k, n, f) {
    gsub(/[][]/, "", text)
    f = 1
    k = split(text, part, "/")
    n = split(part[1], word, " ")
    for (i = 1; i <= n; i++) f *= power(word[i])
    n = k > 1 ? split(part[2], word, " ") : 0
    for (i = 1; i <= n; i++) f /= power(word[i])
    return f
}
function size(x) { return x < 0 ? -x : x + 0 }
BEGIN { FS = "," }
FNR == 1 { file++; for (i = 1; i <= NF; i++) name[i] = $i; next }
FNR == 2 { for (i = 1; i <= NF; i++) { per[i] = factor($i); unit[i] = $i } next }
file == 1 { for (i = 1; i <= NF; i++) { a[FNR, i] = $i; if (size($i) > most[unit[i]]) most[unit[i]] = size($i) } rows = FNR; columns = NF; next }
{
    for (i = 1; i <= NF; i++) {
        if (name[i] ~ /\.mode[0-9]|^step\.sweeps$/ || $i == a[FNR, i]) continue
        d = size($i / per[i] - a[FNR, i])
        if (most[unit[i]] > 0 ? d > apart * most[unit[i]] : d) { print name[i], a[FNR, i], $i / per[i]; bad++ }
    }
    last = FNR
    if (NF != columns) bad++
}
END {
    if (unknown != "") print "unknown unit " unknown
    exit !(rows == 19 && last == rows && !bad && unknown == "")
}
