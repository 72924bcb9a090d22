# part-sweep.sh -- many points: their values, what is kept of each run, failures as rows, parts, interrupts, the same bytes
# whichever way, and what a point costs.
. tests/tools/lib.sh
need_program sweep
cd "$work" || exit 1
PATH=$BUILD:$PATH
cat >arm.yaml <<'YAML'
fmdsub: 1
parameters: {k: 100, len: 1}
gravity: [0, -9.81]
bodies:
  arm: {mass: 1, inertia: 1/12, at: [0.5*len, 0]}
constraints:
  pin: {revolute: [ground, arm], at: [0, 0]}
forces:
  spring: {spring: pin, stiffness: k}
initial: {pin.angle: 0.05}
integrate: {scheme: midpoint, step: 1.0e-3, until: 0.2}
output: {every: 0.01, columns: [pin.angle, pin.angle_rate]}
YAML

# One point is one run.
fmdsub sweep --over 'k=[10, 1e3]' --over 'bodies.arm.mass=1:2:3' --of 'last(pin.angle), max(pin.angle), absmax(pin.angle_rate), range(pin.angle)' arm.yaml >table 2>err
ended "two factors" 0 $? table err
expect "all combinations, the last one fastest" "1,10,1 2,10,1.5 3,10,2 4,1e3,1 5,1e3,1.5 6,1e3,2" "$(echo $(sed 1d table | cut -d , -f 1-3))" table
expect "the head" "point,k,bodies.arm.mass,last(pin.angle),max(pin.angle),absmax(pin.angle_rate),range(pin.angle),exit" "$(head -n 1 table)"
fmdsub run -q -s parameters.k=1e3 -s bodies.arm.mass=1.5 arm.yaml >one.csv
awk -F, 'NR > 1 { if (NR == 2 || $2 > max) max = $2; if (NR == 2 || $2 < min) min = $2; r = $3 < 0 ? -$3 : $3; if (r > most) most = r; last = $2 }
    END { printf "%.12g %.12g %.12g %.12g\n", last, max, most, max - min }' one.csv >want
expect "the numbers of a point are those of its run" "$(cat want)" "$(awk -F, '$1 == 5 { printf "%.12g %.12g %.12g %.12g", $4, $5, $6, $7 }' table)" table
fmdsub sweep --over k=1:100:log:3 --over len=0:1:lin:2 arm.yaml >table 2>err
expect "ranges; last of every column" "point,k,len,last(pin.angle),last(pin.angle_rate),exit 1 1 0 10 0 10 1 100 0 100 1" "$(head -n 1 table) $(echo $(sed 1d table | cut -d , -f 2,3 | tr , ' ') | sed 's/^1 0 1 1/1 1 0/')" table

# mean and rms by time: t over [0, 0.2] has 0.1 and 0.2/sqrt(3), whatever the records are.
fmdsub sweep --over 'output.every=[0.01, 0.2]' --of 'mean(t), rms(t), first(t), min(t - 1)' arm.yaml 2>err | sed 1d | awk -F, '{ printf "%.9f %.9f %g %g\n", $3, $4, $5, $6 }' >got
expect "mean, rms, first, min" "0.100000000 0.115470054 0 -1 0.100000000 0.115470054 0 -1" "$(echo $(cat got))" err

# Drawn: moments, the same for the same seed, another for another; Latin hypercube: each part of the range once.
draw() { fmdsub sweep --over 'k~normal(100,10)' --over 'len~uniform(0.5,1.5)' --until 0.002 --of 'last(t)' "$@" arm.yaml 2>err; }
draw --sample 400 >drawn
ended "drawn" 0 $? drawn err
sed 1d drawn | awk -F, '{ n++; a += $2; b += $2 * $2; c += $3; d += $3 * $3; e += ($2 - 100) * ($3 - 1) }
    END { m = a / n; s = sqrt(b / n - m * m); u = c / n; v = sqrt(d / n - u * u)
          print n, (m > 98 && m < 102), (s > 9 && s < 11), (u > .97 && u < 1.03), (v > .27 && v < .31), (e / n > -.5 && e / n < .5) }' >got
expect "mean and deviation of normal and uniform, no correlation" "400 1 1 1 1 1" "$(cat got)"
draw --sample 4 >few
expect "more draws begin with the same ones" "4 $(sed -n 2,5p drawn)" "$(sed 1d few | grep -c .) $(sed 1d few)"
draw --sample 4 --seed 2 >other
expect "another seed" "4 0" "$(sed 1d other | wc -l) $(sed 1d other | cut -d , -f 2 | grep -cFf - few)"
draw --sample 50 --latin >latin
expect "Latin hypercube: each fiftieth once" "50 50" "$(sed 1d latin | awk -F, '{ i = int(($3 - .5) * 50); if (!seen[i]++) n++; k = $2 < 100; low += k } END { print n, 2 * low }')" latin

# A point that fails is a row.
fmdsub sweep --over 'bodies.arm.mass=[1, -1, 2]' --of 'last(t)' arm.yaml >table 2>err
expect "a wrong point: status, rows" "1 0.2,0 ,3 0.2,0" "$? $(echo $(sed 1d table | cut -d , -f 3,4))" err table
expect "a wrong point: words" "fmdsub: point 2 (bodies.arm.mass=-1): exit 3: " "$(head -n 1 err | sed 's/exit 3: .*/exit 3: /')" err
expect "a wrong point: at the end" "fmdsub: 1 of 3 points did not end well: column exit" "$(tail -n 1 err)" err
fmdsub sweep -q --over 'integrate.step=[1e-3, 1e-9]' --max-time 3 --of 'last(t)' arm.yaml >table 2>err
expect "--max-time: what was done is kept" "7 1,1e-3,0.2,0" "$? $(sed 1d table)" err
fmdsub sweep --of 'max(t)' -f json --over 'integrate.scheme=[midpoint, "no, such"]' arm.yaml >table 2>err
expect "JSON: texts, none as null" '1 {"rows":[ {"point":1,"integrate.scheme":"midpoint","max(t)":0.2,"exit":0} ,{"point":2,"integrate.scheme":"\"no, such\"","max(t)":null,"exit":3} ]}' "$? $(echo $(cat table))" err

# The same bytes: by one process, in parts, point by point, merged, gone on with.
over="--over k~normal(100,30) --over len=0:1:3 --sample 5 --of last(pin.angle),rms(pin.angle)"
fmdsub sweep $over arm.yaml >all.csv 2>err
ended "fifteen points" 0 $? all.csv err
expect "fifteen rows" 16 "$(wc -l <all.csv)"
fmdsub sweep --jobs 1 $over arm.yaml >jobs.csv 2>err
same "by one process" all.csv jobs.csv
for i in 1 2 3 4; do fmdsub sweep --shard $i/4 -o part$i.csv $over arm.yaml 2>err || not_ok "part $i" "failed" err; done
expect "parts by turns" "3 7 11 15" "$(echo $(sed 1d part3.csv | cut -d , -f 1))"
fmdsub sweep --merge part3.csv part1.csv part4.csv part2.csv >merged.csv 2>err
same "parts, merged" all.csv merged.csv
fmdsub sweep $over --list arm.yaml >commands 2>err
expect "a command a point" 15 "$(wc -l <commands)" err
sh commands 2>err | fmdsub sweep --merge - >listed.csv 2>>err
same "one command after the other, merged" all.csv listed.csv
fmdsub sweep --merge $over part1.csv part2.csv part4.csv >gap.csv 2>err
expect "a part that is missing" "1 fmdsub: 4 of 15 points are missing, the first is point 3" "$? $(cat err)"
sed 5q all.csv >cut.csv.part
printf '9,1' >>cut.csv.part
fmdsub sweep --resume -o cut.csv $over arm.yaml 2>err
same "gone on with" all.csv cut.csv
sed 's/,0$/,7/' part2.csv >left.csv
fmdsub sweep --resume --shard 2/4 -o left.csv $over arm.yaml 2>err
same "what a limit ended is run again" part2.csv left.csv
fmdsub sweep -q --slurm 4 -o s.csv $over arm.yaml >job.sh 2>err
expect "a job script" "#SBATCH --array=1-4" "$(grep array= job.sh)" err
for i in 1 2 3 4; do SLURM_ARRAY_TASK_ID=$i sh job.sh 2>err || not_ok "task $i" "failed" err job.sh; done
sed -n 's/^# *fmdsub/fmdsub/p' job.sh >merge.sh
sh merge.sh 2>err
same "tasks of a job script, merged as it says" all.csv s.csv
fmdsub sweep $over --seed 9 --list -s 'bodies.arm.mass=2' "arm.yaml" >commands
# Texts with commas and quotes are one value, also where they are read back; a point that failed is told again, not run again.
sed "1a title: an arm" arm.yaml >titled.yaml
texts='title=["one, two", "say \"x\"", three]'
fmdsub sweep -q --over "$texts" --of 'last(t)' -o texts.csv titled.yaml 2>err
sed 3q texts.csv >begun.csv
fmdsub sweep -q --resume --over "$texts" --of 'last(t)' -o begun.csv titled.yaml 2>>err
same "texts with commas and quotes, gone on with" texts.csv begun.csv
fmdsub sweep --merge texts.csv >merged.csv 2>>err
same "texts with commas and quotes, merged" texts.csv merged.csv
expect "texts with commas and quotes: rows" "4 three" "$(wc -l <merged.csv) $(sed -n '$s/^3,\(.*\),0.2,0$/\1/p' merged.csv)" merged.csv err
masses='bodies.arm.mass=[1, -1, 2]'
fmdsub sweep -q --over "$masses" --of 'last(t)' -o failed.csv arm.yaml 2>err
cp failed.csv before.csv
fmdsub sweep --resume --over "$masses" --of 'last(t)' -o failed.csv arm.yaml 2>err
expect "a point that had failed: status, words" "1 1 fmdsub: 1 of 3 points did not end well: column exit" "$? $(wc -l <err) $(cat err)" err
same "a point that had failed: its row stays" before.csv failed.csv
sed 's/^3,/9,/' before.csv >far.csv
refuse 2 "far.csv has a point 9: this sweep has 3" sweep --resume --over "$masses" --of 'last(t)' -o far.csv arm.yaml
fmdsub sweep --over 'bodies.arm.mass=-1:-8:8' --of 'last(t)' arm.yaml >table 2>err
expect "points that fail: the first five are told" "5 fmdsub: and 3 more points that failed" "$(grep -c '^fmdsub: point [1-8] ' err) $(sed -n '6p' err)" err

# Names that a shell would take apart; more tasks than points; what is drawn by Latin hypercube is drawn the same again.
drawn="--over len~uniform(0,1) --sample 3 --latin --times --of last(t)"
fmdsub sweep -q $drawn -s "title=arm's length; \$HOME" --slurm 40 -o "arm's \$s.csv" arm.yaml >job.sh 2>err
expect "a job script: no more tasks than points" "#SBATCH --array=1-3" "$(grep array= job.sh)" err
for i in 1 2 3; do SLURM_ARRAY_TASK_ID=$i sh job.sh 2>err || not_ok "task $i of names with spaces" "failed" err job.sh; done
sed -n 's/^# *fmdsub/fmdsub/p' job.sh >merge.sh
sh merge.sh 2>err
fmdsub sweep -q $drawn arm.yaml >drawn.csv 2>err
cut -d , -f 1-3 drawn.csv >drawn
cut -d , -f 1-3 "arm's \$s.csv" >again
same "a job script: names with spaces, quotes and dollars" drawn again
expect "a job script: times are taken" "point,len,last(t),cpu,exit 3" "$(head -n 1 "arm's \$s.csv") $(awk -F, 'NR > 1 && $4 > 0' "arm's \$s.csv" | wc -l)" "arm's \$s.csv"
fmdsub sweep -q $drawn --slurm 2 arm.yaml >job.sh 2>err
expect "a job script: a file where none is named" 2 "$(grep -c 'output sweep.csv' job.sh)" job.sh
expect "a command has what was set" 15 "$(grep -c -- '--seed 9 .*--set bodies.arm.mass=2 arm.yaml$' commands)" commands

# Ended by a signal: rows that are done are kept, and nothing is run twice.
fmdsub sweep -q --over 'integrate.step=[1e-3, 2e-3, 1e-9, 5e-4]' --jobs 1 --of 'last(t)' -o i.csv arm.yaml 2>err &
pid=$!
n=0
while [ $n -lt 100 ] && ! { [ -s i.csv.part ] && [ "$(wc -l <i.csv.part)" = 3 ]; }; do sleep 0.1; n=$((n + 1)); done
kill -TERM $pid # a shell has its jobs ignore SIGINT
wait $pid
expect "SIGTERM: status, rows" "143 2" "$? $(sed 1d i.csv.part | wc -l)" err i.csv.part
expect "SIGTERM: words" "fmdsub: unfinished rows are kept in i.csv.part" "$(grep unfinished err)" err

refuse 2 "a sweep needs --over" sweep arm.yaml
refuse 2 "no parameter 'kk': did you mean 'k'" sweep --over kk=1:2:3 arm.yaml
refuse 2 "from:to:n" sweep --over k=1:2 arm.yaml
refuse 2 "of one sign and not 0" sweep --over k=0:2:log:3 arm.yaml
refuse 2 "the name is given twice" sweep --over k=1:2:3 --over k=1:2:4 arm.yaml
refuse 2 "are the same" sweep --over k=1:2:3 --over parameters.k=1:2:4 arm.yaml
refuse 2 "a distribution is normal" sweep --over 'k~gauss(0,1)' --sample 3 arm.yaml
refuse 2 "a distribution has two numbers" sweep --over 'k~normal(1)' --sample 3 arm.yaml
refuse 2 "how many values of 'k' are drawn" sweep --over 'k~normal(0,1)' arm.yaml
refuse 2 "nothing is drawn" sweep --over k=1:2:3 --sample 3 arm.yaml
refuse 2 "did you mean 'max'" sweep --over k=1:2:3 --of 'maxx(t)' arm.yaml
refuse 2 "--shard takes I/N" sweep --over k=1:2:3 --shard 4/3 arm.yaml
refuse 2 "not standard input" sweep --over k=1:2:3 -
refuse 2 "goes on with the rows of --output" sweep --over k=1:2:3 --resume arm.yaml
refuse 6 "no table of a sweep" sweep --merge one.csv
refuse 6 "is there already, and has another 'k'" sweep --merge few other
refuse 2 "few is of another deck, other settings or another program: at point 1 last(t) is 0.002 there and 0.001 here" sweep --over 'k~normal(100,10)' --over 'len~uniform(0.5,1.5)' --sample 4 --until 0.001 --of 'last(t)' --resume -o few arm.yaml
refuse 2 "is of another sweep: at point 1 k is" sweep --over 'k~normal(100,10)' --over 'len~uniform(0.5,1.5)' --sample 4 --seed 2 --of 'last(t)' --resume -o few arm.yaml
expect "of which nothing is lost" 5 "$(wc -l <few)"
fmdsub sweep --over k=1:2:3 --of 'max(pin.angl)' arm.yaml >out 2>err
expect "a column that is not there: status, words" "2 1" "$? $(grep -c "did you mean 'pin.angle'" err)" err

# Progress, when asked for: one point is done, the next never ends, so that the line comes however fast or slow the machine is.
fmdsub sweep -q --progress always --jobs 1 --over 'integrate.step=[1e-3, 1e-9, 1e-9]' --of 'last(t)' -o p.csv arm.yaml 2>err &
pid=$!
n=0
while [ $n -lt 600 ] && ! grep -q ' s to go' err; do sleep 0.1; n=$((n + 1)); done
kill -TERM $pid
wait $pid
expect "progress with the time to go" "143 yes" "$? $(tr '\r' '\n' <err | grep -q '1 of 3 points, 0 failed, [0-9]* s to go' && echo yes)" err

# What a point costs: 1000 points of about a millisecond, CPU time of all processes.
"$BUILD/tools/cputime" -n 2 "fmdsub sweep -q --over k=10:1000:log:1000 --times -o t.csv arm.yaml" >cputime 2>&1
sed 1d t.csv | awk -F, -v all="$(awk '{ print $1 }' cputime)" '{ run += $5; n++ } END { printf "%.2f ms a point, %.2f ms of them the run\n", 1000 * all / n, 1000 * run / n; exit !(n == 1000 && run > 0 && all > run && all - run < 2) }' >cost
expect "overhead of a point below 2 ms of CPU: $(cat cost)" 0 $? cost cputime

# With GNU parallel, where it is installed.
if ! command -v parallel >/dev/null; then
    skip "GNU parallel" "not installed (Debian: parallel)"
    exit 0
fi
fmdsub sweep $over --list arm.yaml | PARALLEL_HOME=$work parallel --will-cite 2>err | fmdsub sweep --merge - >parallel.csv 2>>err
same "GNU parallel" all.csv parallel.csv
