# completion.sh -- completion of shells: every shell offers what --help names, to each verb its own.
. tests/tools/lib.sh
cd "$work" || exit 1
"$FMDSUB" --help >help
sed -n 's/^  \([a-z]*\)  *[a-z].*/\1/p' help >verbs
for shell in bash zsh fish; do
    "$FMDSUB" list completion $shell >$shell 2>err
    ended "completion for $shell" 0 $? $shell err
    expect "completion for $shell names every verb" "" "$(while read -r verb; do grep -q "$verb" $shell || echo "$verb"; done <verbs; [ -s $shell ] || echo empty)"
    if command -v $shell >/dev/null; then
        [ -s $shell ] && $shell -n $shell >out 2>&1
        expect "completion for $shell is well-formed" 0 $? out
    fi
done
"$FMDSUB" list completion ksh >out 2>err
expect "completion for another shell" "2 1" "$? $(grep -c 'one of bash, zsh, fish' err)"
"$FMDSUB" list completion bash zsh >out 2>err
expect "completion for two shells" "2 1" "$? $(grep -c 'one of bash, zsh, fish' err)"

# Options that a verb has by its own help, one a line: name, letter, what its value is, what it does; "-" for none.
options() {
    "$FMDSUB" "$1" --help | awk '
        /^options:/ { on = 1; next }
        !/^ / { on = 0 }
        on {
            letter = "-"; value = "-"
            if (match($0, /^  -[a-zA-Z], /)) { letter = substr($0, 3, 2); $0 = "      " substr($0, 7) }
            at = match($0, /[^ ]   *[^ ]/)
            split(substr($0, 7, at - 6), word, /[ =[]/)
            value = substr($0, 7 + length(word[1]), at - 6 - length(word[1]))
            sub(/^ /, "", value)
            text = substr($0, at + 1)
            sub(/^ */, "", text)
            print word[1] "\t" letter "\t" (value == "" ? "-" : value) "\t" text
        }'
}
while read -r verb; do
    options "$verb" >"of.$verb"
    cut -f 1,2 "of.$verb" | tr '\t' '\n' | grep -v '^-$' | sort >wanted
    sed -n "s/^    $verb) compadd -- \(.*\) ;;/\1/p" zsh | tr ' ' '\n' | sort >there
    same "zsh: options of $verb" wanted there
    # fish: name, letter, a value that is asked for, what it does; of all verbs, or of this one among others
    awk -F '\t' '{ print $1 "\t" $2 "\t" ($3 ~ /^[^-[]/ ? $3 ~ /^[a-z]*\|[a-z|]*$/ ? $3 : "yes" : "no") "\t" $4 }' "of.$verb" | sort >wanted
    awk -v verb="$verb" '
        !/ -l / { next }
        / -n / && !index($0, "from " verb " ") && !index($0, "from " verb "\047") && !match($0, "from [a-z ]* " verb "[ \047]") { next }
        {
            text = $0; sub(/.* -d \047/, "", text); sub(/\047$/, "", text); gsub(/\\\047/, "\047", text)
            name = $0; sub(/.* -l /, "", name); sub(/ .*/, "", name)
            letter = "-"; if (match($0, / -s . /)) letter = "-" substr($0, RSTART + 4, 1)
            value = / -r -d / ? "yes" : "no"
            if (match($0, / -x -a \047[^\047]*\047/)) { value = substr($0, RSTART + 8, RLENGTH - 9); gsub(/ /, "|", value) }
            print "--" name "\t" letter "\t" value "\t" text
        }' fish | sort >there
    same "fish: options of $verb" wanted there
done <verbs

# What a shell reads between the quotes of verbs is what --help says of them.
sed -n 's/^  \([a-z]*\)  *\([a-z].*\)/\1:\2/p' help >wanted
[ -s wanted ] || echo "no verb" >wanted
eval "set -- $(sed -n '/^verbs=(/,/^)/p' zsh | sed '1d;$d' | tr '\n' ' ')"
printf '%s\n' "$@" >there
same "zsh: verbs" wanted there
awk '/__fish_use_subcommand/ { name = $0; sub(/.* -a /, "", name); sub(/ .*/, "", name); sub(/.* -d \047/, ""); sub(/\047$/, ""); gsub(/\\\047/, "\047"); print name ":" $0 }' fish >there
same "fish: verbs" wanted there

# Completion as bash would do it: WORDS..., the last one is being typed.
if ! command -v bash >/dev/null; then
    skip "completion" "bash is not installed"
    exit
fi
complete() { bash -c '. "$0"; COMP_WORDS=(fmdsub "$@"); COMP_CWORD=$#; _fmdsub; echo ${COMPREPLY[*]}' ./bash "$@" 2>&1; }
expect "bash: a verb" "animate" "$(complete an)"
expect "bash: an option of the verb" "--over" "$(complete sweep --ov)"
expect "bash: none of another verb" "--every --every-steps" "$(complete run --ov)$(complete run --ev)"
expect "bash: a word of an option" "ndjson ndjson" "$(complete run -f nd) $(complete run --format nd)"
expect "bash: no word of an option whose value is free" "--color" "$(complete study --budget SEC)$(complete run -o cs)$(complete list --co)"
expect "bash: all verbs" "$(sort verbs | tr '\n' ' ')" "$(complete '' | tr ' ' '\n' | sort | tr '\n' ' ')"
for verb in run diff new; do
    cut -f 1,2 "of.$verb" | tr '\t' '\n' | grep -v '^-$' | sort >wanted
    complete $verb - | tr ' ' '\n' | sort >there
    same "bash: options of $verb" wanted there
done
