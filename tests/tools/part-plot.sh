# part-plot.sh -- pictures: the scripts for gnuplot, names that would be commands, gnuplot there and missing.
. tests/tools/lib.sh
need_program plot
cd "$work" || exit 1

cat >two.csv <<'CSV'
t,arm.angle,arm.x,energy.residual
0,0.1,1,0
0.5,0.2,0.5,
1,0.15,0.25,1e-9
CSV
plot() { "$FMDSUB" plot "$@" 2>err; }

# The script, letter by letter; a pattern is a panel.
plot --script -c 'arm.*,energy.residual' -o picture.svg two.csv >script
same "plot --script" "$ROOT/tests/refdata/plot.gnuplot" script
plot --script -o picture.svg two.csv >script
expect "plot --script: a panel for each column of a file without units" 3 "$(grep -c '^plot ' script)" script
plot --script -o picture.svg "$ROOT/decks/pendulum.yaml" >script
expect "plot --script: a panel for each unit of a deck" "$(awk '/^set ylabel/ { n++ } END { print n }' script)" "$(grep -c '^plot ' script)" script
plot --script -o picture.svg -c 'pin.*' "$ROOT/decks/pendulum.yaml" >script
expect "plot --script: columns of a pattern, by units" "[N] pin.angle [rad] pin.angle_accel [rad/s2] pin.angle_rate [rad/s] pin.mz [N m] " \
    "$(sed -n "s/^set ylabel '\(.*\)' noenhanced/\1/p" script | LC_ALL=C sort | tr '\n' ' ')" script
plot --script -o picture.svg -c pin.angle "$ROOT/decks/pendulum.yaml" >script
expect "a deck is run with 500 records" 501 "$(awk '/^END/ { exit } /^[0-9]/ { n++ } END { print n }' script)" err
plot --script -o picture.svg -c pin.angle --every 1 "$ROOT/decks/pendulum.yaml" >script
expect "--every has the last word" 11 "$(awk '/^END/ { exit } /^[0-9]/ { n++ } END { print n }' script)" err

refuse 2 "takes decks and files of records" plot
refuse 2 "ends in .svg, .png or .pdf, not 'x.gif'" plot -o x.gif two.csv
refuse 2 "no column matches 'leg" plot --script -c 'leg*' two.csv
refuse 2 "would overwrite an input file" plot -o two.csv.svg two.csv two.csv.svg
refuse 6 "cannot read 'none.csv'" plot --script none.csv
refuse 2 "ends in .svg, .png or .pdf" study --plot x.gif "$ROOT/decks/pendulum.yaml"
refuse 2 "prints what draws --plot FILE" study --script "$ROOT/decks/pendulum.yaml"
printf 't,a\n0,1\n1,b\n' >bad.csv
refuse 6 "bad.csv:3: a field that is no number" plot --script bad.csv
printf 't,a\n0,1,2\n' >bad.csv
refuse 6 "bad.csv:2: more fields" plot --script bad.csv
printf 't,a\n' >bad.csv
refuse 6 "no records" plot --script bad.csv

# Too many of them: nothing is drawn in part.
wide() { awk -v n="$1" 'BEGIN { printf "t"; for (i = 1; i <= n; i++) printf ",c%d", i; for (r = 0; r < 2; r++) { printf "\n%d", r; for (i = 1; i <= n; i++) printf ",%d", i }; print "" }'; }
wide 16 >wide.csv
plot --script wide.csv >script
expect "plot: 16 panels" "0 16" "$? $(grep -c '^plot ' script)" err
wide 17 >wide.csv
refuse 2 "more than 16 panels: name the columns with --columns" plot --script wide.csv
wide 64 >wide.csv
plot --script -c 'c*' wide.csv >script
expect "plot: 64 columns in one panel" "0 1 64" "$? $(grep -c '^plot ' script) $(grep -c 'using 1:' script)" err
wide 65 >wide.csv
refuse 2 "more than 64 columns in one panel" plot --script -c 'c*' wide.csv

# One range for all panels, whichever file ends where; what is no number is a gap, a column without any is left out, by name.
printf 't,arm.angle,arm.x\n0,1,nan\n1,1e400,\n3,2,nan\n' >holes.csv
plot --script two.csv holes.csv >script
expect "plot --script: one range" "1 set xrange [0:3]" "$(grep -c xrange script) $(grep xrange script)" script
expect "plot --script: holes" "0 1 NaN" "$(awk '/^.file1/ { on = 1 } on && $1 == 0 { a = $2 } on && $1 == 1 { print 0, a, $2 }' script)" script
expect "plot --script: nothing of a column without numbers" "2 0" "$(grep -c 'using 1:[23] .*two' script) $(grep -c 'using 1:3.*holes' script)" script
printf 't,a,b\n0,1,nan\n1,2,\n' >half.csv
plot --script half.csv >script
expect "plot: a column without numbers" "0 1 1" "$? $(grep -c '^plot ' script) $(grep -c "no number in column 'b'" err)" script err
printf 't,b\n0,nan\n1,\n' >half.csv
refuse 2 "no column to draw over t" plot -q half.csv
refuse 2 "two.csv: 'sp' is an expression, which only a run computes" plot -c 'sp=hypot(arm.x,arm.angle)' two.csv
refuse 2 "pick takes one error, not '1e-2,1e-3'" study --pick 1e-2,1e-3 "$ROOT/decks/pendulum.yaml"

# A study's script has a line a scheme; rows go to -o.
"$FMDSUB" study -q --repeats 0 --until 1 --schemes midpoint,dop853 --plot x.svg --script -o rows.csv "$ROOT/decks/pendulum.yaml" >script 2>err
expect "study --script: status, lines, a picture by work" "0 2 1 0" "$? $(grep -c '^.line[0-9] << END' script) $(grep -c '^plot ' script) $(test -e x.svg; echo $((! $?)))" err script
expect "study --script: rows" 0 "$(test "$(wc -l <rows.csv)" -gt 5; echo $?)" rows.csv

# Words of that script letter by letter, its numbers masked.  Its lines are the rows by growing work; the front those that none
# is both cheaper and more accurate than, by falling error; the range whole decades around all of them.
sed '/^[0-9]/d; s/x [0-9.]* a digit/x D a digit/; s/first [0-9][0-9.e-]*/first E/g; s/^set yrange .*/set yrange/' script >shape
same "study --script: words" "$ROOT/tests/refdata/study.gnuplot" shape
awk '
    function wrong(what) { print what; bad = 1 }
    FNR == 1 { file++ }
    file == 1 && /^scheme/ { split($0, name, ","); for (i in name) at[name[i]] = i; next }
    file == 1 { split($0, x, ","); n++; e[n] = x[at["error"]]; w[n] = x[at["work"]]; of[n] = x[at["scheme"]]; least = n == 1 || x[at["uncertain"]] < least ? x[at["uncertain"]] : least; next }
    /<< END/ { kind = substr($1, 2); last = ""; next }
    /^END/ { kind = ""; next }
    kind ~ /^line/ {
        for (i = 1; i <= n; i++) if (w[i] == $1 && e[i] == $3) { drawn[i]++; if (of[i] != scheme[kind] && scheme[kind]) wrong(kind " is of two schemes"); scheme[kind] = of[i] }
        if (last != "" && $1 < last) wrong(kind " goes back from " last " to " $1)
        last = $1
    }
    kind ~ /^front/ {
        fronts++
        for (i = 1; i <= n; i++) if (w[i] < $1 && e[i] <= $3) wrong("the front at " $1 ": " w[i] " is better")
        if (last != "" && $3 > last) wrong("the front goes back")
        last = $3
    }
    /^set yrange/ { gsub(/\[|\]|:/, " "); low = $3; high = $4 }
    END {
        for (i = 1; i <= n; i++) {
            if (drawn[i] != 1) wrong("row " i " is drawn " drawn[i] + 0 " times")
            best = 1
            for (k = 1; k <= n; k++) if (e[k] <= e[i] && w[k] < w[i]) best = 0
            bests += best
            smallest = i == 1 || e[i] < smallest ? e[i] : smallest
            largest = e[i] > largest ? e[i] : largest
        }
        if (least > 0 && least / 2 < smallest) smallest = least / 2
        if (fronts != bests) wrong("the front has " fronts + 0 " rows of " bests)
        if (!(low <= smallest && low > smallest / 10 && high >= largest && high < 10 * largest)) wrong("range " low " to " high " for " smallest " to " largest)
        exit bad || n < 6
    }' rows.csv script >wrong
expect "study --script: lines, front, range" 0 $? wrong rows.csv

# Without gnuplot: the package is named, at once; scripts are printed all the same.
bare() { PATH=$work/none "$FMDSUB" "$@"; }
bare plot two.csv >out 2>err
expect "no gnuplot: status, words" "6 1 0" "$? $(grep -c 'gnuplot-nox' err) $(wc -c <out)" err
bare study --plot x.png --budget 1000 "$ROOT/decks/whip.yaml" >out 2>err
expect "no gnuplot, study: status, words" "6 1 0" "$? $(grep -c 'gnuplot-nox' err) $(wc -c <out)" err
bare plot --script two.csv >out 2>err
ended "no gnuplot: --script" 0 $? out err

# One that ends at once, and reads nothing of a script that is longer than a pipe holds: nobody waits for it.
mkdir ended
printf '#!/bin/sh\necho worn out >&2\n' >ended/gnuplot
chmod +x ended/gnuplot
awk 'BEGIN { print "t,a"; for (i = 0; i < 20000; i++) print i ",0.123456" }' >long.csv
mkdir shut
printf 'words\n' >shut/gnuplot
PATH=$work/shut "$FMDSUB" plot two.csv >out 2>err
expect "gnuplot that cannot be started: status, words" "6 1 0" "$? $(grep -c 'gnuplot cannot be started: ' err) $(wc -c <out)" err
PATH=$work/ended:$PATH timeout 30 "$FMDSUB" plot -o a.svg long.csv >out 2>err
expect "gnuplot ends without reading: status, words" "6 1" "$? $(grep -c 'gnuplot has drawn nothing: worn out' err)" err

# Where it is there.
if ! command -v gnuplot >/dev/null; then
    echo "skip pictures: no gnuplot (Debian: gnuplot-nox)"
    exit 0
fi
for ending in svg png pdf; do
    plot -o "a.$ending" two.csv
    rc=$?
    ended "plot -o a.$ending" 0 $rc "a.$ending" err
done
expect "a.svg" 0 "$(grep -q '<svg' a.svg; echo $?)"
expect "a.png" 0 "$(head -c 4 a.png | grep -q PNG; echo $?)"
expect "a.pdf" 0 "$(head -c 5 a.pdf | grep -q '%PDF-'; echo $?)"
plot two.csv >out
expect "plot into the terminal" "0 0" "$? $(grep -q 'arm.angle' out; echo $?)" err out
"$FMDSUB" study -q --until 1 --schemes midpoint,dop853 --plot s.svg -o rows.csv "$ROOT/decks/pendulum.yaml" 2>err
expect "study --plot" "0 0" "$? $(grep -q 'dop853' s.svg; echo $?)" err

# Names that would be commands: of files, columns, units of nothing.
name="a'; system('touch hit1'); \`touch hit2\` \$(touch hit3) @x %s {=99 x}.csv"
printf '%s\n' 't,x'"'"'`touch hit4`,"y'"'"'; system(""touch hit5"")",<b>&amp;' '0,1,2,3' '1,2,3,4' >"$name"
cp "$name" other.csv
plot -o names.svg "$name" other.csv
ended "names that would be commands: status" 0 $? names.svg err
expect "names that would be commands: nothing was done" "0 a picture" "$(ls hit* 2>/dev/null | wc -l) $([ -s names.svg ] && echo "a picture")"
rm -f names.svg
printf 't\na,b\n' >newline.csv
mv other.csv 'line
break.csv'
plot -o names.svg 'line
break.csv' two.csv
ended "a line break in a name" 0 $? names.svg err
