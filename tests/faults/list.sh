# list.sh -- fmdsub list: words for people say what the tables say: keys with types, units and defaults, schemes, effects,
# columns of a deck.
. tests/tools/lib.sh
list() { "$FMDSUB" list "$@" 2>>"$work/err"; }
# Rows of a table of texts and numbers, fields by tabulators.
rows() { list -f json "$@" | sed -n '/^,*{"[a-z]*":"/ { s/^,*{"[a-z]*":"//; s/,"[a-z_]*":/\t/g; s/}$//; s/\t"/\t/g; s/"\(\t\|$\)/\1/g; s/\\"/"/g; p; }'; }

for topic in sections joints forces contacts friction; do
    list $topic >"$work/text"
    rows $topic >"$work/rows"
    awk -F '\t' '
        function fits(said) {
            return index(said, $4) && ($5 != "") == (index(said, " [" $5 "]") > 0) && ($6 == "yes") == (index(said, ", required") > 0) &&
                   ($7 != "") == (index(said, ", default ") > 0) && ($7 == "" || index(said, ", default " $7))
        }
        NR == FNR { if (/^    [^ ]/) line = $0; else if (/^      /) { split(line, word, " "); n++; key = word[1] substr($0, 7); of[key, ++many[key]] = line } else if (/[^ ]/) heads++; next }
        {
            i++
            found = 0
            for (k = 1; k <= many[$3 $8]; k++) found = found || fits(of[$3 $8, k])
            if (!found) { print "no such line: " $0; bad = 1 }
        }
        END { if (i != n) print n " keys, " i " rows"; exit bad || i != n || n < 1 || heads < 1 }' "$work/text" "$work/rows" >"$work/wrong"
    expect "list $topic: text and table" 0 $? "$work/wrong" "$work/err"
done
expect "list sections: a limit that is no more than itself" 1 "$(list sections | grep -c '^    fmdsub  *whole number, >= 1, <= 1, required$')"

list schemes >"$work/text"
rows schemes >"$work/rows"
awk -F '\t' '
    NR == FNR { line[++n] = $0; next }
    { i++; split(line[i], word, " ")
      if (word[1] != $1 || !index(line[i], "order " $2) || ($3 == "yes") != (line[i] ~ /, two rates/) || ($4 == "yes") != (line[i] ~ /, own steps/) || !index(line[i], $5)) { print line[i]; bad = 1 } }
    END { exit bad || i != n || n < 10 }' "$work/text" "$work/rows" >"$work/wrong"
expect "list schemes: text and table" 0 $? "$work/wrong" "$work/err"
list effects >"$work/text"
rows effects | tr '\t' '\n' | grep -v '^$' >"$work/rows"
sed 's/^\([a-z_]*\): /\1\n/; s/^    \(tells\|left out\|costs\|watched\)  *//' "$work/text" | grep -v '^$' >"$work/plain"
same "list effects: text and table" "$work/plain" "$work/rows"
list columns decks/flexible-crank.yaml | sed 's/  */ /g' >"$work/text"
list columns -f json decks/flexible-crank.yaml >/dev/null
rows columns decks/flexible-crank.yaml | awk -F '\t' '{ print $1 " " ($2 == "" ? "-" : $2) " " $3 }' >"$work/rows"
same "list columns: text and table" "$work/text" "$work/rows"

# Names alone: each joint and each scheme that is there once, no line longer than a terminal.
list >"$work/text"
expect "list: schemes and joints" "wrote $( { rows schemes | awk -F '\t' '$6 == "" { print $1 }'; list joints | sed -n 's/^constraints.NAME.\([a-z-]*\): .*/\1/p'; } | sort | tr '\n' ' ')" \
    "$(wrote "$work/text") $(awk '/^[a-z]/ { on = /^(schemes|joints) /; $1 = "" } on { gsub(/,/, " "); for (i = 1; i <= NF; i++) print $i }' "$work/text" | sort | tr '\n' ' ')" "$work/text"
expect "list: lines of at most 80 letters" "0 wrote" "$(sed '/^$/,$d' "$work/text" | awk 'length > 80' | wc -l) $(wrote "$work/text")" "$work/text"
