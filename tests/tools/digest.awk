# digest.awk -- of every line of the data of a picture the name of its thing, how many numbers it has, sums of them, colours.
{
    name = match($0, /"name":"[^"]*"/) ? substr($0, RSTART + 8, RLENGTH - 9) : ""
    n = sum = first = second = 0
    colour = ""
    rest = $0
    gsub(/"[^"]*"/, " ", rest)
    gsub(/[^-+.0-9eE]+/, " ", rest)
    count = split(rest, x, " ")
    for (i = 1; i <= count; i++) {
        if (x[i] !~ /^[-+]?[0-9.]/) continue
        n++
        if (x[i] > 1e5) { colour = colour " " x[i]; continue }
        sum += x[i]; first += x[i] * (n % 7); second += x[i] * x[i] * (n % 11)
    }
    if (n) printf "%s %d %.5f %.5f %.5f%s\n", name, n, sum, first, second, colour
}
