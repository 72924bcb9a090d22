# part-install.sh -- what is installed, the tarball of the sources.
. tests/tools/lib.sh
need_program install
to=$work/root
make -s install BUILD="$BUILD" DESTDIR="$to" PREFIX=/usr >"$work/out" 2>&1
expect "make install" 0 $? "$work/out"
for file in bin/fmdsub share/man/man1/fmdsub.1 share/man/man5/fmdsub-deck.5 share/doc/fmdsub/decks/pendulum.yaml share/doc/fmdsub/README.md \
    share/fmdsub/deck.schema.json share/bash-completion/completions/fmdsub share/zsh/site-functions/_fmdsub share/fish/vendor_completions.d/fmdsub.fish; do
    expect "installed: $file" yes "$([ -s "$to/usr/$file" ] && echo yes)"
done
same "the schema is the program's" "$to/usr/share/fmdsub/deck.schema.json" "$("$FMDSUB" schema >"$work/schema"; echo "$work/schema")"
make -s uninstall DESTDIR="$to" PREFIX=/usr >"$work/out" 2>&1
expect "make uninstall leaves no file, of all that were there" "0 yes" "$(find "$to" -type f | wc -l) $([ -d "$to/usr/bin" ] && echo yes)"

# --stats: JSON by the name of the file, plain lines otherwise.
"$FMDSUB" run -q --stats="$work/s.json" decks/pendulum.yaml >"$work/out" 2>"$work/err"
expect "--stats=FILE.json" "0 1 1" "$? $(grep -c '^{.*"minor_steps":10000,.*}$' "$work/s.json") $(grep -c '"cpu_seconds":' "$work/s.json")" "$work/err" "$work/s.json"
"$FMDSUB" run -q --stats="$work/s.txt" decks/pendulum.yaml >"$work/out" 2>"$work/err"
expect "--stats=FILE: name value" "yes" "$(grep -q '^minor_steps 10000$' "$work/s.txt" && ! grep -q '  ' "$work/s.txt" && echo yes)" "$work/s.txt"

# The demo: its table, and the three commands at its end work as printed.
sh tests/tools/demo.sh >"$work/demo" 2>"$work/err"
ended "the demo" 0 $? "$work/demo" "$work/err"
ln -s "$ROOT/decks" "$work/decks"
sed -n '/^next:/,$p' "$work/demo" | sed -n 's/^    //p' >"$work/next"
expect "three commands to try next" 3 "$(wc -l <"$work/next")" "$work/demo"
folder=${BUILD#"$ROOT"/} # as printed
case $folder in /*) ;; *) mkdir -p "$work/$folder" && rmdir "$work/$folder" && ln -s "$BUILD" "$work/$folder" ;; esac
(cd "$work" && sh -e next) >"$work/out" 2>"$work/err"
expect "they work as printed" "0 yes yes" "$? $([ -s "$work/crank.html" ] && echo yes) $([ -s "$work/first.yaml" ] && echo yes)" "$work/err"

# The tarball: the same bytes twice, and it needs no git.
if git rev-parse --git-dir >/dev/null 2>&1; then
    make -s dist BUILD="$work/dist" >"$work/out" 2>&1
    expect "make dist" 0 $? "$work/out"
    tar=$(ls "$work"/dist/fmdsub-*.tar.gz)
    first=$(cksum <"$tar")
    make -s dist BUILD="$work/dist" >"$work/out" 2>&1
    expect "the same bytes twice" "$first" "$(cksum <"$tar")" "$work/out"
    mkdir "$work/away" && tar xzf "$tar" -C "$work/away"
    (cd "$work"/away/fmdsub-* && PATH=$work/nogit:$PATH make -n all BUILD=b) >"$work/out" 2>&1
    expect "make knows what to do there" "0 yes" "$? $(grep -q 'cli/main' "$work/out" && echo yes)" "$work/out"
else
    skip "make dist" "no git"
fi

# The schema takes every deck that the program takes, and marks what is misspelt.
python=
for try in python3 /usr/bin/python3; do command -v $try >/dev/null && $try -c 'import jsonschema, yaml' 2>/dev/null && python=$try; done
if [ -n "$python" ]; then
    "$FMDSUB" schema >"$work/schema.json"
    "$FMDSUB" new controller >"$work/controller.yaml"
    sed 's/^forces:/contacts: {c: {between: [a, b], stiffness: 1.0e+6, exponent: 1.5}}\n&/' "$work/controller.yaml" >"$work/soft.yaml"
    $python - "$work/schema.json" "$work/controller.yaml" decks/*.yaml decks/airscrew/airscrew.yaml tests/decks/signals.yaml "$work/soft.yaml" >"$work/out" 2>&1 <<'PY'
import copy, json, sys, jsonschema, yaml
schema = json.load(open(sys.argv[1]))
jsonschema.Draft7Validator.check_schema(schema)
check = jsonschema.Draft7Validator(schema)
wrong = [(f, e.json_path if hasattr(e, "json_path") else list(e.path)) for f in sys.argv[2:] for e in check.iter_errors(yaml.safe_load(open(f)))]
deck = yaml.safe_load(open(sys.argv[2]))
bad = []
for change in (lambda d: d["integrate"].update(scheme="dopri6"), lambda d: d.update(signal={}), lambda d: d["signals"].update(x=[1]),
               lambda d: d["forces"]["motor"].update(valu=1), lambda d: d.update(drives={"a": {"drive": "pin", "valve": "t"}}), lambda d: d.pop("bodies"),
               lambda d: d.update(contacts={"c": {"between": ["a", "b"], "exponent": 2}})):
    d = copy.deepcopy(deck)
    change(d)
    bad.append(not check.is_valid(d))
print(len(wrong), bad.count(True))
print(*wrong, sep="\n")
PY
    expect "the schema: all decks fit, seven slips do not" "0 7" "$(head -n 1 "$work/out")" "$work/out"
else
    skip "the schema, by a validator" "python3 with jsonschema and yaml is not installed"
fi
