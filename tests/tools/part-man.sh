# part-man.sh -- the manual: clean mdoc, and its examples do what they show.
#
# Sessions run line by line in a folder with copies of the shipped decks, fmdsub first in PATH.  The lines
# under a `$ command` are its output (stdout and stderr); `...` stands for any lines; a command without
# lines under it may print what it likes.  The last command's exit status must be 0, or as the page says.
# Decks must pass `fmdsub check`.
. tests/tools/lib.sh
need_program man
PATH=$BUILD:$PATH
mkdir "$work/x"
cp -r decks/* "$work/x"

# Splits a session into commands K.cmd and what they should print K.want; prints how many.
split_session() { # FILE FOLDER
    awk -v to="$2/" '
        /^\$ /  { if (n) close(to n ".want"); n++; print substr($0, 3) > (to n ".cmd"); close(to n ".cmd"); more = /\\$/; next }
        /^> /   { if (more) { print substr($0, 3) >> (to n ".cmd"); close(to n ".cmd"); more = /\\$/; next } }
                { print > (to n ".want") }
        END     { print n + 0 }' "$1"
}

fits() { # WANTED GOT
    awk -v wanted="$1" '
        BEGIN { while ((getline line < wanted) > 0) want[++n] = line; at = 1 }
        {
            if (want[at] == "...") { if (want[at + 1] == $0) at += 2; next }
            if (at > n || want[at] != $0) { bad = 1; exit }
            at++
        }
        END { if (want[at] == "...") at++; exit bad || at <= n }' "$2"
}

run_session() { # NAME FILE STATUS
    steps=$work/steps
    rm -rf "$steps"
    mkdir "$steps"
    count=$(split_session "$2" "$steps")
    k=1
    while [ "$k" -le "$count" ]; do
        (cd "$work/x" && timeout 60 sh "$steps/$k.cmd") >"$steps/got" 2>&1 </dev/null
        rc=$?
        if [ -s "$steps/$k.want" ] && ! fits "$steps/$k.want" "$steps/got"; then
            not_ok "$1" "command $k shows something else; the command, wanted, got:" "$steps/$k.cmd" "$steps/$k.want" "$steps/got"
            return
        fi
        for made in $(sed -n 's/.*fmdsub.* -o \([^ ;]*\).*/\1/p' "$steps/$k.cmd"); do
            [ -s "$work/x/$made" ] || { not_ok "$1" "command $k does not write $made"; return; }
        done
        k=$((k + 1))
    done
    expect "$1" "$3" $rc "$2" "$steps/got"
}

for page in man/*.[157]; do
    [ -f "$page" ] || continue
    name=${page##*/}
    if command -v mandoc >/dev/null; then
        mandoc -T lint -W warning "$page" >"$work/lint" 2>&1
        expect "$name lint" 0 $? "$work/lint"
    else
        skip "$name lint" "mandoc is not installed"
    fi
    mkdir -p "$work/examples"
    awk -v out="$work/examples/$name" -f tests/tools/examples.awk "$page"
done

for file in "$work"/examples/*.sh "$work"/examples/*.yaml; do
    [ -f "$file" ] || continue
    name=${file##*/}
    status=$(cat "$file.status")
    case $file in
    *.sh) run_session "$name" "$file" "$status" ;;
    *.yaml)
        (cd "$work/x" && timeout "${CHECK_SECONDS:-60}" "$FMDSUB" check - <"$file") >"$work/out" 2>"$work/err"
        expect "$name" "$status said" "$? $(cat "$work/out" "$work/err" | grep -q . && echo said)" "$work/err" "$file"
        ;;
    esac
done
