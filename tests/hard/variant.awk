# variant.awk -- the same planar mechanism in other words: a deck with one entry a line, read, and written
#
#     -v reversed=1         bodies, constraints and forces in the opposite order
#     -v renamed=1          every body and constraint with another name
#     -v x=X -v y=Y         shifted
#     -v turn=PHI           turned, gravity and axes too
#     -v scale=S            lengths in units of 1/S m: masses stay, inertias go with S^2, stiffnesses of slides stay
#
# Rates along axes are lengths, so are springs' ends; nothing else of a deck is known to this script.
BEGIN { if (scale == "") scale = 1; if (turn == "") turn = 0; if (x == "") x = 0; if (y == "") y = 0 }

# [a, b] of the expressions a and b, turned and scaled; at a place if it is one
function vector(a, b, place,    c, s) {
    c = "cos(" turn ")*(" a ") - sin(" turn ")*(" b ")"
    s = "sin(" turn ")*(" a ") + cos(" turn ")*(" b ")"
    if (place == "axis") return "[" c ", " s "]"
    if (place == "at") return "[" x " + " scale "*(" c "), " y " + " scale "*(" s ")]"
    return "[" scale "*(" c "), " scale "*(" s ")]"
}

# The text between key "[" and "]", at its comma
function rewrite(line, key, place,    at, end, inside, comma) {
    at = index(line, key)
    if (!at) return line
    end = index(substr(line, at), "]") + at - 1
    inside = substr(line, at + length(key), end - at - length(key))
    comma = index(inside, ",")
    return substr(line, 1, at - 1) substr(key, 1, length(key) - 1) vector(substr(inside, 1, comma - 1), substr(inside, comma + 1), place) substr(line, end + 1)
}

function scaled(line, key, factor,    at, rest, n) {
    at = index(line, key)
    if (!at) return line
    rest = substr(line, at + length(key))
    n = match(rest, /[,}]/)
    return substr(line, 1, at + length(key) - 1) factor "*(" substr(rest, 1, n - 1) ")" substr(rest, n)
}

{
    line = $0
    if (line ~ /^#/) next
    if (line ~ /^[a-z]/) section = substr(line, 1, index(line, ":") - 1)
    if (section == "gravity") line = rewrite(line, "gravity: [", "vector")
    if (section == "bodies" || section == "constraints") {
        line = rewrite(line, " at: [", "at")
        line = rewrite(line, " axis: [", "axis")
        line = scaled(line, "inertia: ", "(" scale ")^2")
    }
    if (section == "initial") line = scaled(line, "displacement_rate: ", scale)
    text[++n] = line
    of[n] = section
    if (line ~ /^  [A-Za-z]/ && section ~ /^(bodies|constraints|forces)$/) {
        name = line
        sub(/^ */, "", name)
        sub(/:.*/, "", name)
        if (section != "forces") names[++count] = name # a force may have the name of its kind
        entry[n] = 1
    }
}

END {
    for (i = 1; i <= n; i++) {
        j = i
        if (reversed && entry[i]) { # the mirror image within its section
            for (first = i; entry[first - 1] && of[first - 1] == of[i]; first--);
            for (last = i; entry[last + 1] && of[last + 1] == of[i]; last++);
            j = first + last - i
        }
        line = text[j]
        if (renamed)
            for (k = 1; k <= count; k++) line = replaced(line, names[k], "Z" count - k "_" k)
        print line
    }
}

# Whole words only
function replaced(line, word, by,    out, at, before, after) {
    out = ""
    while (at = index(line, word)) {
        before = at > 1 ? substr(line, at - 1, 1) : " "
        after = substr(line, at + length(word), 1)
        out = out substr(line, 1, at - 1) (before ~ /[A-Za-z0-9_.]/ || after ~ /[A-Za-z0-9_]/ ? word : by)
        line = substr(line, at + length(word))
    }
    return out line
}
