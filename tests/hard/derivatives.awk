# derivatives.awk -- columns of which one is the rate of another: differences over two records beside what stands between them.
#
#     -v apart=SHARE      of the largest rate of that unit
#
# NAME and NAME_rate, NAME_rate and NAME_accel; of bodies and points x, vx and ax, wz and alz, in the plane angle and wz; gap and
# gap_rate; works of the energies and the powers that make them, POWERS "damper=soft+brake external=wind"
function size(x) { return x < 0 ? -x : x + 0 }
function pair(a, b) { if (a in at && b in at) { n++; of[n] = at[a]; rate[n] = at[b]; what[n] = a " and " b } }
BEGIN { FS = "," }
NR == 1 {
    for (i = 1; i <= NF; i++) at[$i] = i
    for (a in at) {
        pair(a, a "_rate")
        if (a ~ /_rate$/) pair(a, substr(a, 1, length(a) - 4) "accel")
        if (match(a, /\.[xyz]$/)) { stem = substr(a, 1, RSTART); k = substr(a, RSTART + 1); pair(a, stem "v" k); pair(stem "v" k, stem "a" k) }
        if (a ~ /\.w[xyz]$/) { stem = a; sub(/w([xyz])$/, "al" substr(a, length(a)), stem); pair(a, stem) }
        if (a ~ /\.angle$/) { stem = a; sub(/angle$/, "wz", stem); pair(a, stem) }
    }
    nwork = split(powers, work, " ")
    next
}
NR == 2 { for (i = 1; i <= NF; i++) unit[i] = $i; next }
{
    rows++
    for (i = 1; i <= NF; i++) { older[i] = old[i]; old[i] = now[i]; now[i] = $i; if (size($i) > most[unit[i]]) most[unit[i]] = size($i) }
    if (rows < 3) next
    h = now[1] - older[1]
    for (k = 1; k <= n; k++) { d = size((now[of[k]] - older[of[k]]) / h - old[rate[k]]); if (d > worst[k]) worst[k] = d }
    for (k = 1; k <= nwork; k++) {
        split(work[k], side, "="); m = split(side[2], part, "+"); p = 0
        for (j = 1; j <= m; j++) { if (!((part[j] ".power") in at)) missing = part[j]; p += old[at[part[j] ".power"]] }
        if (size(p) > busy[k]) busy[k] = size(p)
        d = size((now[at["energy." side[1]]] - older[at["energy." side[1]]]) / h - p); if (d > off[k]) off[k] = d
    }
}
END {
    for (k = 1; k <= n; k++) if (worst[k] > apart * most[unit[rate[k]]]) { print what[k], worst[k], "of", most[unit[rate[k]]]; bad++ }
    for (k = 1; k <= nwork; k++) if (!(off[k] <= apart * busy[k])) { print work[k], off[k], "of", busy[k]; bad++ }
    if (missing != "") { print "no column " missing ".power"; bad++ }
    print n " pairs in " rows " records"
    exit bad || n < pairs || rows < 50
}
