# same.sh -- whether two programs say the same of every deck, byte for byte: CSV, NDJSON, final state, words, exit code.
#
#     sh tests/tools/same.sh REFERENCE [PROGRAM] [DECK ...]           default: build/fmdsub, every deck there is
#
# D: only decks whose names contain one of its words.
#
# Each deck is run under every scheme that the reference lists, with all columns that it knows and the steps cut to what
# a short run takes; schemes of two rates once more at another ratio, with the last joint fast where the deck names
# none.  Only times and the number of columns there are are left out.  Prints a line for each difference; the last line is `N passed, N failed`.
. tests/tools/lib.sh
STEPS=${STEPS:-600} # most minor steps of a run, fewer for more than 20 freedoms; where stiffness sets the effort, radians

[ $# -gt 0 ] && [ -x "$1" ] || { echo "usage: same.sh REFERENCE [PROGRAM] [DECK ...]" >&2; exit 2; }
reference=$1 program=$FMDSUB
shift
case ${1:-} in *.yaml | '') ;; *) program=$1; shift ;; esac
[ -x "$program" ] || { echo "same: no program $program" >&2; exit 2; }

# ---- one transcript: sections headed `== DECK: TRY`, each with stdout, `-- exit CODE`, stderr and the final state ----

try() { # TRY ARGUMENTS...
    echo "== $name: $1"
    shift
    rm -f "$at/state"
    timeout 60 "$who" "$@" </dev/null >"$at/out" 2>"$at/err"
    code=$?
    sed 's/ columns of [0-9]*, / columns, /' "$at/out"
    echo "-- exit $code"
    sed 's/; [0-9.e+-]* s$/; (time)/' "$at/err"
    [ ! -f "$at/state" ] || { echo "-- state"; cat "$at/state"; }
}

run() { # TRY SETTINGS...
    what=$1
    shift
    for setting in "$@"; do set -- "$@" --set "$setting"; shift; done
    case $* in *tolerance*|*fixed-point*) end=$brief ;; *) end=$until ;; esac
    try "$what" run --columns "${columns:-*}" --every-steps $every --until $end --final-state "$at/state" "$@" "$deck"
}

# What the reference finds in a deck, as shell variables: the end of a cut run, steps, the last joint.
plan() {
    { "$reference" check --expanded "$deck"; "$reference" check -f json "$deck"; } 2>/dev/null | tr -d '",{}[]' | awk -v most="$STEPS" '
        $1 == "advice:"                { advice = 1 }
        $1 == "tolerance:" && !advice  { own = 1 } # steps of its own
        $1 == "freedoms:" && !freedoms { freedoms = $2 }
        $1 == "fast:" && fast == ""    { fast = $2 }
        $1 == "joint:"                 { joint = $2 }
        $1 == "step:"                  { step = $2 }
        $1 == "ratio:"                 { ratio = $2 }
        $1 == "major_steps:"           { major = $2 }
        $1 == "omega:"                 { omega = $NF }
        END {
            if (!major) exit
            if (freedoms > 20) most *= 20 / freedoms
            n = int(most / ratio) + 1; if (n < 5) n = 5; if (n > major) n = major
            until = n * step * ratio; brief = omega * until > most ? most / omega : until
            if (own) { n = 200; step = brief / n; until = brief }
            printf "until=%.12g brief=%.12g h=%.12g every=%d ", until, brief, step, n / 5 + 1
            printf "ratio=%d fast=%d joint=%s\n", ratio, fast, joint
        }'
}

schemes() {
    while read -r scheme rest; do
        set -- integrate.scheme=$scheme
        case $rest in *"own steps"*) set -- "$@" integrate.tolerance=1.0e-6 ;; *) set -- "$@" integrate.step=$h ;; esac
        run $scheme "$@"
        case $rest in *"two rates"*)
            set -- "$@" integrate.ratio=$((ratio == 4 ? 5 : 4))
            [ $fast -gt 0 ] || set -- "$@" "partition.fast=[$joint]"
            run "$scheme at another ratio" "$@" ;;
        esac
        case $scheme in
        subcycle) run "$scheme damped" "$@" integrate.rho_infinity=0.8 integrate.symmetric=true ;;
        newmark) run "$scheme damped" "$@" integrate.beta=0.3 integrate.gamma=0.6
                 run "$scheme fixed-point" "$@" integrate.iteration=fixed-point ;;
        esac
    done <"$work/schemes"
}

transcript() { # PROGRAM
    who=$1
    try check check "$deck"
    try "check as json" check -f json "$deck"
    case $deck in tests/bad/*) return ;; esac
    try expanded check --expanded "$deck"
    try columns list columns "$deck"
    try modes modes "$deck"
    [ -n "$plan" ] || { try run run "$deck"; return; }
    try ndjson run -f ndjson --every-steps $every --until $brief "$deck"
    schemes
}

# What is said without a deck.
transcript_of_none() { # PROGRAM
    who=$1
    for verb in list "list schemes" "list joints" "list forces" "list sections" schema explain new --help --version; do try "$verb" $verb; done
}

# ---- two transcripts: sections that differ, and how many there are ----

differences() { # REFERENCE PROGRAM
    awk '
        function judge(   i, why) {
            if (code == "0" && !written) why = "nothing is written"
            else if (code == "124") why = "takes more than a minute"
            if (!why && code != exits[title]) why = "exit " exits[title] " -> " code
            for (i = 1; !why && (i <= n || i <= lines[title]); i++)
                if (now[i] "" != was[title, i] "") why = "line " i ": " first(was[title, i], now[i]) worst()
            if (why) { print title ": " why; failed++ } else passed++
        }
        function first(a, b,   i, k, x, y, name) { # what differs in two lines
            k = split(a, x, ",")
            if (split(was[title, 1], name, ",") != k || split(b, y, ",") != k || name[1] != "t")
                return part(a, b) " -> " part(b, a)
            for (i = 1; i < k && x[i] == y[i]; i++) ;
            return "t = " x[1] ", " name[i] ": " x[i] " -> " y[i]
        }
        function part(a, b,   i) { # from shortly before they differ
            for (i = 1; i <= length(a) && substr(a, i, 1) == substr(b, i, 1); i++) ;
            return i > 30 ? "..." substr(a, i - 20, 80) : substr(a, 1, 80)
        }
        function size(x) { return x < 0 ? -x : x }
        function worst(   i, j, k, x, y, name, off, most, share, which) { # difference of a column, of its largest value
            k = split(was[title, 1], name, ",")
            if (name[1] != "t" || was[title, 1] != now[1]) return ""
            for (i = 2; was[title, i] ~ /^[-0-9.e]+,/ && now[i] ~ /^[-0-9.e]+,/; i++) {
                split(was[title, i], x, ","); split(now[i], y, ",")
                for (j = 1; j <= k; j++) {
                    if (size(x[j] - y[j]) > off[j]) off[j] = size(x[j] - y[j])
                    if (size(x[j]) > most[j]) most[j] = size(x[j])
                }
            }
            for (j = 1; j <= k; j++) if (off[j] > share * most[j]) { share = most[j] ? off[j] / most[j] : 1e99; which = name[j] }
            return which == "" ? "" : sprintf("; most in %s, %.2g of its largest value", which, share)
        }
        /^== /       { if (NR != FNR && FNR > 1) judge(); title = substr($0, 4); n = written = 0; code = ""; next }
        NR == FNR && /^-- exit / { exits[title] = $3 }
        NR == FNR    { was[title, ++lines[title]] = $0; next }
                     { now[++n] = $0 }
        /^-- exit /  { code = $3 }
        code == ""   { written = 1 }
        END          { judge(); print "#", passed + 0, failed + 0 }' "$1" "$2"
}

compare() { # TRANSCRIPT [DECK]
    $1 "$reference" >"$at/reference"
    $1 "$program" >"$at/program"
    differences "$at/reference" "$at/program"
}

# ---- all decks ----

# Decks that stand in scripts, where the shell puts nothing in, and in the manual.
written_decks() { # FOLDER
    mkdir "$1"
    awk -v out="$1" '
        FNR == 1        { n = 0; end = "" }
        end == "" && match($0, /<<.?[A-Z]+/) { end = substr($0, RSTART, RLENGTH); gsub(/[^A-Z]/, "", end); text = ""; next }
        end != "" && $0 == end { if (text ~ /^fmdsub: 1/ && text !~ /\$/) { k = split(FILENAME, part, "/")
                              file = out "/" part[k] "." ++n ".yaml"; printf "%s", text >file; close(file) }
                          end = "" }
        end != ""       { text = text $0 "\n" }' tests/hard/*.sh tests/faults/*.sh
    for page in man/*.[157]; do awk -v out="$1/${page##*/}" -f tests/tools/examples.awk "$page"; done
    "$reference" new >"$1/new.yaml"
}

if [ $# = 0 ]; then
    written_decks "$work/decks"
    set -- decks/*.yaml decks/*/*.yaml tests/decks/*.yaml tests/hard/*.yaml tests/bench/*.yaml tests/bad/*.yaml "$work"/decks/*.yaml -
fi
for deck in "$@"; do
    [ -f "$deck" ] || [ "$deck" = - ] || { echo "same: no deck $deck" >&2; exit 2; }
done
"$reference" list schemes >"$work/schemes"
for deck in "$@"; do wanted "$(basename "$deck" .yaml)" && echo "$deck"; done >"$work/all"
half() { # 0 or 1
    at=$work/$1
    mkdir "$at"
    awk "NR % 2 == $1" "$work/all" | while read -r deck; do
        name=${deck##*/}
        name=${name%.yaml}
        if [ "$deck" = - ]; then compare transcript_of_none; continue; fi
        plan=$(plan)
        eval "$plan"
        columns=
        [ -z "$plan" ] || columns=$("$reference" run -q --columns '*' --every-steps $every --until $until "$deck" 2>/dev/null | head -n 1)
        columns=${columns#t,}
        compare transcript
    done >"$at/found"
}
half 0 &
half 1
wait
cat "$work"/?/found | awk '
    /^# /  { passed += $2; failed += $3; next }
           { print }
    END    { printf "%d passed, %d failed\n", passed, failed; exit failed > 0 || passed == 0 }'
