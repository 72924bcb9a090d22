# confined.sh -- what a stranger's deck may touch: files below its folder, as they are, and nothing else.
. tests/tools/lib.sh
cd "$work" || exit 1
mkdir -p decks/below out
deck=decks/deck.yaml
cp "$ROOT/decks/pendulum.yaml" $deck
echo 'secret: 1' >secret.yaml
echo 'a: 1' >decks/below/part.yaml

# Files that a deck names: no way out, nothing that blocks or never ends.
ln -s ../secret.yaml decks/link.yaml
ln -s /dev/zero decks/zero.yaml
mkfifo decks/pipe.yaml
for name in ../secret.yaml below/../../secret.yaml "$work/secret.yaml" link.yaml zero.yaml pipe.yaml /dev/stdin below .; do
    { cat $deck; echo "include: '$name'"; } >decks/tries.yaml
    timeout 5 "$FMDSUB" check decks/tries.yaml >out/words 2>err </dev/null
    expect "include: $(echo "$name" | sed "s|$work|...|"): status" 3 $? err
    grep -q 'E-path' err && ! grep -q secret: err && ok "include: $(echo "$name" | sed "s|$work|...|"): refused" ||
        not_ok "include: $name: refused" "stderr:" err
done

# A parser that somebody has taken over: the kernel keeps it inside, where it has Landlock.
if [ ! -f "$BUILD/tools/reach.so" ] || ! grep -q landlock /sys/kernel/security/lsm 2>/dev/null && [ "$(uname -r | cut -d . -f 1)" -lt 6 ]; then
    skip confined "no Landlock here"
else
    REACH="r:/etc/passwd r:secret.yaml r:decks/below/part.yaml w:decks/planted w:planted w:out/beside" LD_PRELOAD="$BUILD/tools/reach.so" \
        "$FMDSUB" run -q -o out/motion.csv $deck >words 2>err
    ended "confined: the run itself" 0 $? out/motion.csv err
    cat >want <<EOF
r:/etc/passwd: refused
r:secret.yaml: refused
r:decks/below/part.yaml: opened
w:decks/planted: refused
w:planted: refused
w:out/beside: opened
EOF
    grep '^[rw]:' err >got
    if grep -q refused got; then same "confined: run" want got; else skip "confined: run" "no Landlock here"; fi
    REACH="r:/etc/passwd r:decks/below/part.yaml w:out/beside" LD_PRELOAD="$BUILD/tools/reach.so" "$FMDSUB" check $deck 2>err >words
    printf 'r:/etc/passwd: refused\nr:decks/below/part.yaml: opened\nw:out/beside: refused\n' >want
    grep '^[rw]:' err >got
    if grep -q refused got; then same "confined: check" want got; else skip "confined: check" "no Landlock here"; fi
fi

# Links that lead nowhere yet are followed, as the shell's '>' does.
ln -s ../out/later.csv decks/dangling.csv
"$FMDSUB" run -q --until 0.1 -o decks/dangling.csv $deck 2>err
ended "-o by a link to nothing yet: status" 0 $? out/later.csv err
[ -L decks/dangling.csv ] && [ -s out/later.csv ] && ok "-o by a link to nothing yet: written where it leads" ||
    not_ok "-o by a link to nothing yet: written where it leads" "$(ls out decks | tr '\n' ' ')" err
