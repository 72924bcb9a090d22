# part-diff.sh -- two records compared: what is the same, what differs, what cannot be compared; the same records in three forms.
. tests/tools/lib.sh
need_program diff
cd "$work" || exit 1
pendulum=$ROOT/decks/pendulum.yaml

cat >a.csv <<'CSV'
t,arm.x,arm.y
0,1,0
0.5,-2,1e-13
1,1.5,
CSV
sed 's/^0.5,-2,/0.5,-2.0001,/' a.csv >b.csv
sed '/^0.5/d' a.csv >half.csv
sed '/^1,/d' a.csv >short.csv
diff_of() { # NAME WANTED ARGUMENT...: the rows without their heading in $rows
    name=$1 want=$2
    shift 2
    "$FMDSUB" diff "$@" >out 2>err </dev/null
    ended "$name" "$want" $? out err
    rows=$(sed 1d out)
}
diff_of "a record is the same as itself" 0 a.csv a.csv
expect "its rows" "arm.x,,0,2.0000009999999997e-6,0,1,1,same arm.y,,0,1.0000001e-12,0,0,0,same" "$(echo $rows)" out
diff_of "a number that moved" 1 a.csv b.csv
expect "where, by how much" "arm.x,,0.00010000000000021103,2.0000009999999997e-6,0.5,-2,-2.0001,differs" "$(echo "$rows" | head -n 1)" out
expect "words" "3 times compared (a has 3, b 3), 2 columns, 1 differs" "$(cat err)" err
diff_of "a tolerance for all" 0 --rel 1e-4 a.csv b.csv
expect "verdicts" "same same" "$(echo $(echo "$rows" | sed 's/.*,//'))" out
diff_of "a tolerance for one column" 0 --abs 0,'*.x=1e-3' a.csv b.csv
expect "what is allowed of each" "0.001002 1e-19" "$(echo $(echo "$rows" | cut -d , -f 4))" out
diff_of "a tolerance for another column" 1 --rel 'arm.y=1' a.csv b.csv
diff_of "columns that are asked for" 0 -c arm.y a.csv b.csv
expect "are compared alone" "arm.y" "$(echo "$rows" | cut -d , -f 1)" out
diff_of "times that only one has" 0 a.csv half.csv
expect "words: times in common" "2 times compared (a has 3, b 2)" "$(sed 's/, 2 col.*//' err)" err
diff_of "a record that ends early" 1 a.csv short.csv
expect "words: where" "the records do not begin and end together: 0 to 1 and 0 to 0.5" "$(tail -n 1 err)" err
# Times are the same within a billionth of the shorter of the two intervals, that of the rows' mean.
printf 't,x\n10,1\n11,2\n14,3\n' >long.csv
printf 't,x\n11.0000000019,2\n14.0000000021,3\n' >late.csv
diff_of "times within a billionth of two seconds between rows" 1 long.csv late.csv
expect "which meet" "1 times compared (a has 3, b 2)" "$(sed -n '1s/, 1 col.*//p' err)" err
diff_of "and in the other order" 1 late.csv long.csv
expect "the same meet" "1 times compared (a has 2, b 3)" "$(sed -n '1s/, 1 col.*//p' err)" err
printf 't,x\n2,5\n' >single.csv
printf 't,x\n2.0000000019,5\n' >single-late.csv
diff_of "single rows, within a billionth of their time" 0 single.csv single-late.csv
printf 't,x\n2.0000000021,5\n' >single-late.csv
refuse 2 "have no time in common" diff single.csv single-late.csv
sed 's/arm.y/arm.z/' a.csv >other.csv
diff_of "a column that only one has" 1 a.csv other.csv
expect "verdicts of lone columns" "same only in a only in b" "$(echo $(echo "$rows" | sed 's/.*,//'))" out
sed 's/^1,1.5,$/1,1.5,0/' a.csv >filled.csv
diff_of "a value that only one has" 1 --abs 1e9 a.csv filled.csv
printf 't,x,x\n0,1,2\n1,3,4\n' >twice.csv
diff_of "two columns of one name, with itself" 0 twice.csv twice.csv
sed 's/4$/5/' twice.csv >twice-other.csv
diff_of "two columns of one name, the second differs" 1 twice.csv twice-other.csv
expect "which of them differs" "same differs" "$(echo $(echo "$rows" | sed 's/.*,//'))" out
diff_of "quiet" 1 -q a.csv b.csv
expect "no words, all rows" "2 0" "$(grep -c arm out) $(wc -c <err)" err
diff_of "as JSON" 1 -f json a.csv b.csv
expect "an object a row" 2 "$(grep -c '"column":"arm' out)" out

# Numbers that are not finite: the same where both have them.
printf 't,x\n0,inf\n1,2\n' >infinite.csv
sed 's/inf/1/' infinite.csv >finite.csv
diff_of "infinite in both" 0 infinite.csv infinite.csv
diff_of "infinite in the second" 1 --abs 1e300 finite.csv infinite.csv
diff_of "infinite in the first" 1 --abs 1e300 infinite.csv finite.csv
# Into a file: the same rows, nothing printed.  By a pattern what both have of it is compared, whatever one of them has besides.
"$FMDSUB" diff a.csv b.csv >rows.csv 2>err
diff_of "into a file" 1 -o file.csv a.csv b.csv
same "its rows as they are printed" rows.csv file.csv
expect "nothing is printed" "0 wrote" "$(wc -c <out | tr -d ' ') $(wrote file.csv)" out
mkdir folder
refuse 6 "folder: cannot open for writing" diff -o folder a.csv b.csv
refuse 6 "cannot" diff -o /dev/full a.csv b.csv
diff_of "columns of a pattern that one has alone" 0 -c 'arm.*' a.csv other.csv
expect "are left out" "arm.x same" "$(echo "$rows" | cut -d , -f 1,8 | tr , ' ')" out

# The same records in three forms, and made anew from the deck.
for form in csv ndjson json; do "$FMDSUB" run -q -f $form -o "p.$form" --until 2 "$pendulum" 2>err || not_ok "run -f $form" "failed" err; done
"$FMDSUB" run -q --units -o units.csv --until 2 "$pendulum" 2>err
diff_of "CSV with its units in a line" 0 --rel 0 --abs 0 units.csv p.csv
expect "whose units are told" "$(sed -n '2s/[][]//gp' units.csv | tr , '\n' | sed 1d | tr '\n' ' ')" "$(echo "$rows" | cut -d , -f 2 | tr '\n' ' ')" out
diff_of "CSV and NDJSON" 0 --rel 0 --abs 0 p.csv p.ndjson
expect "all columns, none differs" "8 0" "$(echo "$rows" | wc -l) $(echo "$rows" | grep -vc '^[a-z.]*,[^,]*,0,0,[0-9.]*,.*,same$')" out
diff_of "NDJSON and JSON" 0 --rel 0 --abs 0 p.ndjson p.json
expect "units of NDJSON" "ball.x,m" "$(echo "$rows" | head -n 1 | cut -d , -f 1,2)" out
diff_of "a golden file and its deck" 0 --rel 0 --abs 0 --until 2 p.csv "$pendulum"
expect "five times of eight columns" "5 times compared (a has 5, b 5), 8 columns, 0 differ" "$(tail -n 1 err)" err
diff_of "a golden file and a deck that changed" 1 --until 2 -s 'bodies.ball.at=[-1.01, 0]' p.csv "$pendulum"
diff_of "with records between" 0 --rel 0 --abs 0 --until 2 --every 0.1 -c 'ball.*' p.csv "$pendulum"
expect "words: records between" "5 times compared (a has 5, b 21), 4 columns, 0 differ" "$(tail -n 1 err)" err

sed 's/^\([0-9]\)/9\1/' a.csv >later.csv
refuse 2 "have no time in common: t 0 to 1 and 90 to 91" diff a.csv later.csv
refuse 2 "takes two" diff a.csv
for number in x=y -1 nan inf 1x arm.x=; do refuse 2 "--rel takes NUMBER or PATTERN=NUMBER, separated by commas, not '$number'" diff --rel=$number a.csv b.csv; done
refuse 2 "no column that both have fits .leg" diff -c 'leg*' a.csv b.csv
refuse 2 "would overwrite an input file" diff -o a.csv a.csv b.csv
refuse 6 "cannot read 'none.csv'" diff a.csv none.csv
sed 4q p.ndjson | sed '$s/.......$//' >cut.ndjson
refuse 6 "cut.ndjson:4: no object" diff p.csv cut.ndjson
printf '{"type":"row","t":0}\n' >bare.ndjson
refuse 6 "bare.ndjson:1: a row before the line of type meta" diff p.csv bare.ndjson
printf '{"type":"meta","columns":["t","a"]}\n{"type":"row","t":0,"a":"x"}\n' >words.ndjson
refuse 6 "words.ndjson:2: a value that is no number" diff p.csv words.ndjson
printf 'x' >no.json
refuse 6 "no.json: no JSON" diff p.csv no.json
"$FMDSUB" diff a.csv a.csv >/dev/full 2>err
expect "a full disk" 6 $? err

# What `plot` takes, too: NDJSON, and CSV whose first column has another name.
printf 'time,a\n0,1\n1,2\n' >time.csv
"$FMDSUB" plot --script -c a time.csv >out 2>err
expect "plot: a first column of another name" "0 2" "$? $(awk '/^END/ { exit } /^[01] / { n++ } END { print n + 0 }' out)" err
"$FMDSUB" plot --script -c ball.x p.ndjson >out 2>err
expect "plot: NDJSON" "0 1" "$? $(grep -c "^set ylabel 'ball.x \[m\]'" out)" out err
