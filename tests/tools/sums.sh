# sums.sh -- sourced after lib.sh by tests that hold what many commands say: of each a line NAME WORDS NUMBERS SUM in a file under
# tests/said.  WORDS is the checksum of its text with numbers masked, NUMBERS how many there are, SUM the sum of their
# logarithms, so that each counts by its digits; what is below 1e-9 counts for nothing.
#
#     say NAME COMMAND...          runs it: records, messages and status are its text
#     heard NAME FILE              messages of a run that was done
#     sums_judge FILE [SOME [APART]]    every one against its line; SUM to APART: 1e-4, or more of what goes on by iterations, since
#                                  the last bits of functions of the C library differ between processors.  With SOME, FILE
#                                  may have others.  WRITE=1 writes it anew
mkdir "$work/texts"

# Times are no words, nor are names of files that pass.
heard() { sed "s/; [0-9.e-]* s\$//; s|$work|W|g" "$2" >>"$work/texts/$1"; }
say() {
    say_name=$1
    shift
    { "$@" 2>"$work/say"; echo "status $?"; } </dev/null >"$work/texts/$say_name"
    heard "$say_name" "$work/say"
}

sums_judge() {
    (
        cd "$work/texts" || exit
        mkdir ../masked
        awk 'FNR == 1 { close(file); file = "../masked/" FILENAME }
            {
                s = $0
                while (match(s, /[0-9]+[.]?[0-9]*(e[-+]?[0-9]+)?/)) {
                    x = substr(s, RSTART, RLENGTH) * 1e9
                    if (x > 1e150) x = 1e150
                    count[FILENAME]++
                    sum[FILENAME] += (count[FILENAME] % 7 + 1) * log(x + sqrt(x * x + 1))
                    s = substr(s, RSTART + RLENGTH)
                }
                gsub(/-?[0-9]+[.]?[0-9]*(e[-+]?[0-9]+)?/, "@")
                print >file
            }
            END { for (name in count) printf "%s %d %.5f\n", name, count[name], sum[name] }' * | sort >../numbers
        cd ../masked && cksum * | awk '{ print $3, $1 }' | sort | join - ../numbers
    ) >"$work/sums"
    [ -z "${WRITE:-}" ] || cp "$work/sums" "$1"
    awk -v some="${2:-}" -v apart="${3:-1e-4}" '
        NR == FNR { was[$1] = $0; next }
        {
            n = split(was[$1], w, " ")
            d = $4 - w[4]
            asked[$1]
            what = "ok"
            if (!(d * d <= apart * apart)) what = "has other numbers, by " d
            if ($3 != w[3]) what = "has more or fewer numbers"
            if ($2 != w[2]) what = "says other words"
            if (!n) what = "has no line there"
            print $1, what
        }
        END { for (name in was) if (!some && !(name in asked)) print name, "is not said any more" }' "$1" "$work/sums" >"$work/judged"
    while read -r sums_name sums_what; do
        [ "$sums_what" = ok ] && ok "$sums_name" ||
            not_ok "$sums_name" "$sums_what: not its line of $1 (WRITE=1 writes it; make same REV=... shows)" "$work/texts/$sums_name"
    done <"$work/judged"
}
