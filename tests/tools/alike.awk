# alike.awk -- two texts, line by line: words the same, numbers to APART and a millionth of them.
#
#     awk -v apart=1e-6 -f tests/tools/alike.awk WANTED GOT       ends with 1 and the first places where they differ
#
# Colours as #a0b1c2 are words.
function words(line,    s) { s = line; gsub(number, " @ ", s); return s }
function numbers(line, x,    n, s) {
    s = line
    n = 0
    while (match(s, number)) { x[++n] = substr(s, RSTART, RLENGTH) + 0; s = substr(s, RSTART + RLENGTH) }
    return n
}
function differ(what) { if (++bad <= 5) print "line " FNR ": " what "\n  was " substr(was[FNR], 1, 300) "\n  is  " substr($0, 1, 300) }
BEGIN { number = "-?[0-9]+[.]?[0-9]*(e[-+]?[0-9]+)?" }
NR == FNR { was[FNR] = $0; n = FNR; next }
{
    k = FNR
    if (k > n) { differ("beyond the end"); next }
    if ($0 == was[k]) next
    a = was[k]; b = $0
    while (match(a, /#[0-9a-f][0-9a-f][0-9a-f][0-9a-f][0-9a-f][0-9a-f]/)) { # exactly
        i = substr(a, RSTART, 7)
        a = substr(a, 1, RSTART - 1) "~" substr(a, RSTART + 7)
        if (!match(b, /#[0-9a-f][0-9a-f][0-9a-f][0-9a-f][0-9a-f][0-9a-f]/) || substr(b, RSTART, 7) != i) { differ("a colour"); next }
        b = substr(b, 1, RSTART - 1) "~" substr(b, RSTART + 7)
    }
    if (words(a) != words(b)) { differ("words"); next }
    m = numbers(a, x)
    numbers(b, y)
    for (i = 1; i <= m; i++) {
        d = x[i] - y[i]; if (d < 0) d = -d
        s = x[i] < 0 ? -x[i] : x[i]
        if (!(d <= apart + 1e-6 * s)) { differ("number " i ", " x[i] " and " y[i]); break }
    }
}
END { if (FNR != n) { print FNR " lines, not " n; bad = 1 } exit bad > 0 }
