# outputs.sh -- what is written is neither what is read nor another output: refused before anything is opened.
. tests/tools/lib.sh
deck=$ROOT/decks/pendulum.yaml
cd "$work" || exit 1

fresh() {
    rm -rf x
    mkdir x
    cp "$deck" x/q.yaml
    printf 'fmdsub: 1\ninclude: part.yaml\nforces: {f: {torque: pin, value: {file: pull.csv}}}\n' >x/whole.yaml
    sed /fmdsub:/d "$deck" >x/part.yaml
    printf '0,0\n10,0\n' >x/pull.csv
    ln x/q.yaml x/hard
    ln -s q.yaml x/soft
    cp x/q.yaml x/out.part
    find x -type f -exec cat {} + | cksum >sum
}

# refuse NAME PATTERN COMMAND: status 2, one line with the pattern, nothing on stdout, every file as it was.
refuse() {
    fresh
    (cd x && eval "$3") >out 2>err </dev/null
    rc=$?
    if [ $rc != 2 ]; then not_ok "$1" "exit $rc, expected 2" err
    elif [ -s out ]; then not_ok "$1" "words on stdout" out
    elif [ "$(wc -l <err)" -ne 1 ] || ! grep -q -- "$2" err; then not_ok "$1" "expected one line with: $2" err
    elif [ "$(find x -type f -exec cat {} + | cksum)" != "$(cat sum)" ]; then not_ok "$1" "a file was changed"
    else ok "$1"; fi
}

refuse "-o the deck" "--output 'q.yaml' would overwrite an input file" '"$FMDSUB" run -q -o q.yaml q.yaml'
refuse "--final-state the deck" "--final-state 'q.yaml' would overwrite" '"$FMDSUB" run -q --final-state q.yaml q.yaml'
refuse "--stats the deck" "--stats './q.yaml' would overwrite" '"$FMDSUB" run -q --stats=./q.yaml q.yaml'
refuse "-o the deck by a hard link" "would overwrite" '"$FMDSUB" run -q -o hard q.yaml'
refuse "-o the deck by a soft link" "would overwrite" '"$FMDSUB" run -q -o soft q.yaml'
refuse "-o the deck that comes by standard input" "would overwrite" '"$FMDSUB" run -q -o q.yaml - <q.yaml'
refuse "-o what the deck includes" "would overwrite" '"$FMDSUB" run -q -o part.yaml whole.yaml'
refuse "-o a table of the deck" "would overwrite" '"$FMDSUB" run -q -o pull.csv whole.yaml'
refuse "-o whose part file is the deck" "is written as .*out.part. first, which would overwrite" '"$FMDSUB" run -q -o out out.part'
refuse "study -o the deck" "would overwrite" '"$FMDSUB" study -q -o q.yaml q.yaml'
refuse "-o and --final-state" "--output and --final-state name one file, 'x'" '"$FMDSUB" run -q -o x --final-state x q.yaml'
refuse "-o and --stats" "--output and --stats name one file, 'x'" '"$FMDSUB" run -q -o ./x --stats=x q.yaml'
refuse "--final-state and --stats" "name one file" '"$FMDSUB" run -q --final-state x --stats="$PWD/x" q.yaml'
refuse "--final-state and the part file of -o" "name one file" '"$FMDSUB" run -q -o x --final-state x.part q.yaml'

refuse "-o a link to what is not there yet, and --stats that" "name one file" 'ln -s x link; "$FMDSUB" run -q -o link --stats=x q.yaml'
refuse "-o by two links to what --stats makes" "name one file" \
    'mkdir y; ln -s ../x y/link; ln -s y/link link; "$FMDSUB" run -q -o link --stats=x q.yaml'
refuse "-o the checkpoint" "--output and the checkpoint name one file, 'x'" \
    '"$FMDSUB" run -q -o x -s "checkpoint={every: 1, file: x}" q.yaml'
refuse "--final-state the checkpoint" "name one file" '"$FMDSUB" run -q --final-state x -s "checkpoint={every: 1, file: x}" q.yaml'
refuse "--stats the checkpoint" "name one file" '"$FMDSUB" run -q --stats=x -s "checkpoint={every: 1, file: x}" q.yaml'
refuse "the part file of -o the checkpoint" "name one file" '"$FMDSUB" run -q -o x -s "checkpoint={every: 1, file: x.part}" q.yaml'
refuse "the deck the checkpoint" "the checkpoint 'q.yaml' would overwrite" '"$FMDSUB" run -q -s "checkpoint={every: 1, file: q.yaml}" q.yaml'

# Records on standard output, that is a file.
fresh
(cd x && "$FMDSUB" run -q --final-state y q.yaml >y 2>../err)
expect "--final-state where standard output goes" 2 $? err
# What comes of the two is nobody's file.
"$FMDSUB" run -o /dev/null --final-state /dev/null --stats=/dev/null x/q.yaml 2>err
ended "three outputs to /dev/null" 0 $? err err
# A state that a deck starts from is read, too.
(cd x && "$FMDSUB" run -q --until 0.1 --final-state s.json q.yaml >/dev/null &&
    "$FMDSUB" run -q --until 0.2 -s 'initial={from: s.json, time: keep}' --final-state s.json q.yaml) >out 2>err
expect "--final-state the state it starts from" 2 $? err
(cd x && "$FMDSUB" run -q --until 0.2 -s 'initial={from: s.json, time: keep}' --final-state t.json -o u --stats=v q.yaml) >out 2>err
ended "three files of their own: status" 0 $? x/u err
expect "three files of their own" 3 "$(find x/t.json x/u x/v -size +0 | wc -l)" err
