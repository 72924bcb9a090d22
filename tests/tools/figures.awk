# figures.awk -- the figures that a deck carries, beside those of a run of it.
#
#     awk -f figures.awk DECK.yaml RUN.csv
#
# A figure is a line of the deck, `#= t column theirs limit`; bars around the column ask for its size without sign.
# Prints `case t column theirs ours difference limit` and, where the limit is missed, `beyond`.
FNR == 1 {
    if (NR > 1) {
        columns = split($0, name, ",")
        for (i = 1; i <= columns; i++) at[name[i]] = i
        next
    }
    split(FILENAME, word, "/")
    case = word[length(word)]
    sub(/\.yaml$/, "", case)
}
NR == FNR && $1 == "#=" { n++; t[n] = $2; what[n] = $3; theirs[n] = $4; limit[n] = $5 }
NR == FNR { next }
{
    split($0, value, ",")
    for (i = 1; i <= n; i++) {
        column = what[i]
        gsub(/\|/, "", column)
        if (size(value[1] - t[i]) < 1e-9 && column in at) {
            ours[i] = value[at[column]]
            if (column != what[i]) ours[i] = size(ours[i])
        }
    }
}
function size(x) { return x < 0 ? -x : x }
END {
    if (!n) print case, "has no figures: beyond"
    for (i = 1; i <= n; i++) {
        known = i in ours && ours[i] != ""
        off = known ? size(ours[i] - theirs[i]) : "-"
        printf "%-21s %5s  %-18s %14.9g %14s %11s %9s%s\n", case, t[i], what[i], theirs[i],
            known ? sprintf("%.9g", ours[i]) : "-", known ? sprintf("%.2e", off) : "-", limit[i],
            known && off <= limit[i] + 0 ? "" : "  beyond"
    }
}
