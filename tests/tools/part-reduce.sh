# part-reduce.sh -- fmdsub-reduce: its unit tests, the same bytes twice, and what wrong input must get.
#
# tests/reduce/bar is a body of solid elements (README there).  Without LAPACK and ARPACK the program is not built.
. tests/tools/lib.sh

REDUCE=$BUILD/fmdsub-reduce
if [ ! -x "$REDUCE" ]; then
    skip reduce "fmdsub-reduce is not built: LAPACK or ARPACK is missing"
    exit 0
fi

for test in "$BUILD"/reduce/t-*; do
    [ -x "$test" ] && [ ! -d "$test" ] || continue
    case $test in *.d) continue ;; esac
    CMOCKA_MESSAGE_OUTPUT=TAP timeout 120 "$test" >"$work/tap" 2>"$work/err"
    rc=$?
    name=${test##*/}
    sed -n "s/^ok [0-9]* *-* */ok $name./p; s/^not ok [0-9]* *-* */not ok $name./p" "$work/tap" | grep -v '# ' >"$work/lines"
    cat "$work/lines"
    grep -q '^not ok' "$work/lines" && sed 's/^/    | /' "$work/err"
    [ $rc = 0 ] || grep -q '^not ok' "$work/lines" || not_ok "$name" "exit status $rc" "$work/err"
    [ -s "$work/lines" ] || not_ok "$name" "ran no test"
done

# ---- what it writes ----

bar=tests/reduce/bar
reduce() { timeout 60 "$REDUCE" "$@"; }

reduce -i root=root -i tip=tip -n 4 --material 7e10,0.3 --stress corner=1 --prestress accel-x:10=$bar-accel-x.sti $bar \
    >"$work/one.json" 2>"$work/one.err"
ended bar 0 $? "$work/one.json" "$work/one.err"
reduce -i root=root -i tip=tip -n 4 --material 7e10,0.3 --stress corner=1 --prestress accel-x:10=$bar-accel-x.sti -o "$work/two.json" $bar \
    2>"$work/two.err"
ended bar-to-a-file 0 $? "$work/two.json" "$work/two.err"
same same-bytes "$work/one.json" "$work/two.json"
same same-words "$work/one.err" "$work/two.err"
grep -q 'taken as zero, not given: accel-y, accel-z, spin-xx' "$work/one.err"
expect says-what-is-missing 0 $? "$work/one.err"
grep -q 'warning: along x .* of the effective mass is left out' "$work/one.err"
expect warns-of-left-out-mass 0 $? "$work/one.err"
reduce -q -i root=root -n 20 $bar >"$work/quiet.json" 2>"$work/quiet.err"
expect quiet "0 body 0" "$? $(grep -q '"fmdsub_flex"' "$work/quiet.json" && echo body) $(grep -vc '^warning: ' "$work/quiet.err")"

reduce -q -i root=root -i tip=tip:average -n 4 --material 7e10,0.3 --stiffening $bar >"$work/stiff.json" 2>"$work/stiff.err"
expect stiffening "0 1" "$? $(grep -c '"xs"' "$work/stiff.json")" "$work/stiff.err"

# Uniform strains cost what the material says, whatever the mesh: E and nu that are not those of the matrix are warned of.
material() {
    material_name=$1 material_count=$2
    shift 2
    reduce -q -i root=root -n 3 "$@" $bar >"$work/material.json" 2>"$work/material.err"
    expect "$material_name" "0 body $material_count" \
        "$? $(grep -q '"fmdsub_flex"' "$work/material.json" && echo body) $(
            grep -c '^warning: the stiffness matrix is in the mean that of E 7e+10, nu 0.3' "$work/material.err")" "$work/material.err"
}
material material-fits 0 --material 7e10,0.3 --stress corner=1
material material-fits-in-mm 0 --material 7e10,0.3 --length 1e-3 --mass 1e3 --stress corner=1
material material-in-other-units 1 --material 7e7,0.3 --stress corner=1
material material-in-other-units-in-mm 1 --material 7e7,0.3 --length 1e-3 --mass 1e3 --stress corner=1
material material-of-another-nu 1 --material 7e10,0.25 --stiffening
material material-for-nothing 0 --material 7e7,0.3

# All of both bodies, as they were when they were looked at: WRITE=1 writes what comes now.  Their last digits are LAPACK's and
# so differ between processors, and with them the checksum.
unsigned() { sed 's/^ "checksum": "[0-9a-f]\{16\}"}$/ "checksum": ""}/' "$1"; }
for body in one stiff; do
    [ -z "${WRITE:-}" ] || cp "$work/$body.json" tests/reduce/as-$body.json
    unsigned tests/reduce/as-$body.json >"$work/was.json"
    unsigned "$work/$body.json" >"$work/is.json"
    awk -v apart=1e-7 -f tests/tools/alike.awk "$work/was.json" "$work/is.json" >"$work/differs"
    expect "bar, $body: as it was" "0 1" "$? $(grep -c '^ "checksum": ""}' "$work/is.json")" "$work/differs"
done

mkdir "$work/loads"
reduce -i root=root -i tip=tip --loads "$work/loads/bar" $bar 2>"$work/loads.err"
expect loads "0 15" "$? $(ls "$work/loads" | wc -l)" "$work/loads.err"
awk '/^\*CLOAD/ { on = 1; next } on { split($0, f, ","); if (f[2] == 1) sum += f[3] } END { exit !(sum / 10 < -16.6799 && sum / 10 > -16.6801) }' \
    "$work/loads/bar-accel-x.inp"
expect load-is-the-weight 0 $? "$work/loads/bar-accel-x.inp"

# ---- what is refused: NAME STATUS PATTERN, arguments ----

refuse() {
    refuse_name=$1 refuse_status=$2 refuse_pattern=$3
    shift 3
    reduce "$@" >"$work/out" 2>"$work/err"
    refuse_rc=$?
    if [ $refuse_rc != "$refuse_status" ]; then
        not_ok "$refuse_name" "exit $refuse_rc, expected $refuse_status" "$work/err"
    elif [ -s "$work/out" ]; then not_ok "$refuse_name" "bytes on stdout" "$work/out"
    elif ! grep -q -- "$refuse_pattern" "$work/err"; then
        not_ok "$refuse_name" "stderr lacks '$refuse_pattern':" "$work/err"
    else ok "$refuse_name"; fi
}

# job NAME: a copy of the bar to spoil.
job() {
    rm -rf "$work/x"
    mkdir "$work/x"
    for end in inp sti mas dof; do cp $bar.$end "$work/x/bar.$end"; done
}
# spoil FILE AWK: the file through awk.
spoil() { awk "$2" "$work/x/$1" >"$work/x/new" && mv "$work/x/new" "$work/x/$1"; }
spoiled() {
    spoiled_name=$1 spoiled_status=$2 spoiled_pattern=$3
    job
    spoil "$4" "$5"
    refuse "$spoiled_name" "$spoiled_status" "$spoiled_pattern" -i root=root -n 3 "$work/x/bar"
}

refuse no-arguments 2 'expected one CalculiX job'
refuse no-interface 2 'name at least one interface' $bar
refuse near-option 2 "did you mean '--interface'" --interfce root=root $bar
refuse bad-kind 2 'neither rigid nor average' -i root=root:loose $bar
refuse bad-number 2 'expects a number above 0' -i root=root --length -1 $bar
refuse bad-load 2 'is none of accel-x' -i root=root --prestress accel-w=$bar-accel-x.sti $bar
refuse stress-without-material 2 'needs --material' -i root=root --stress a=1 $bar
refuse stiffening-without-material 2 'needs --material' -i root=root --stiffening $bar
refuse stiffening-twice 2 'one of both' -i root=root --material 1,0.3 --stiffening --prestress accel-x=x.sti $bar
refuse no-such-job 6 'No such file' -i root=root tests/reduce/none
refuse no-such-set 4 "no node set 'rot'" -i root=rot $bar
refuse no-such-node 4 'node 9999 is not part' -i root=9999 $bar
refuse nodes-on-a-line 4 'lie on one line' -i root=1+2 $bar
refuse single-node 4 'does not stop' -i root=1 $bar
refuse node-in-two 4 'belongs to two interfaces' -i root=root -i also=1+3+5 $bar
refuse too-many-modes 4 'freedoms' -i root=root -n 300 $bar
refuse no-modes 4 'no modes' -i root=root -n 0 $bar
refuse no-directory 6 'No such file' -i root=root -o "$work/none/x.json" $bar
refuse prestress-of-the-free-body 6 'No such file' -i root=root --prestress accel-x=tests/reduce/none.sti $bar
refuse stress-point-missing 4 'is not part of the body' -i root=root --material 1,0.3 --stress a=9999 $bar

# What is read is not written over, whatever it is called; refused before anything is opened.
overwrite() { # NAME PATTERN, arguments
    overwrite_name=$1 overwrite_pattern=$2
    shift 2
    job
    cp $bar-accel-x.sti "$work/x/load.sti"
    cp $bar-accel-x.dof "$work/x/load.dof"
    mv "$work/x/bar.inp" "$work/x/nodes.inp"
    echo '*INCLUDE, INPUT=nodes.inp' >"$work/x/bar.inp"
    overwrite_sum=$(cat "$work"/x/* | cksum)
    rm -f "$work/err"
    refuse "$overwrite_name" 2 "$overwrite_pattern" -i root=root -n 3 "$@" "$work/x/bar"
    expect "$overwrite_name: nothing is changed" "told $overwrite_sum" "$([ -s "$work/err" ] && echo told) $(cat "$work"/x/* | cksum)"
}
for file in bar.inp bar.sti bar.mas bar.dof nodes.inp load.sti load.dof; do
    overwrite "over-$file" "--output '.*/$file' would overwrite an input file" \
        --prestress accel-x="$work/x/load.sti" -o "$work/x/$file"
done
cp $bar.inp "$work/mesh-accel-x.inp"
overwrite over-the-mesh-by-loads "--loads '.*/mesh-accel-x.inp' would overwrite an input file" -i tip=tip --mesh "$work/mesh-accel-x.inp" \
    --loads "$work/mesh"

spoiled value-not-finite 3 'bar.sti:7: error: row .* the value is not finite' bar.sti 'NR == 7 { $3 = "NaN" } 1'
spoiled value-infinite 3 'bar.mas:9: error: row .* the value is not finite' bar.mas 'NR == 9 { $3 = "1e999" } 1'
spoiled value-missing 3 "bar.sti:8: error: expected 'row column value'" bar.sti 'NR == 8 { $3 = "" } 1'
spoiled row-beyond 3 'bar.sti:5: error: .* the matrix has 210 rows' bar.sti 'NR == 5 { $2 = 9999 } 1'
spoiled entry-twice 3 'bar.sti:6: error: this entry was given before, on line 5' bar.sti 'NR == 5 { keep = $0 } NR == 6 { $0 = keep } 1'
spoiled both-triangles 3 'given before, on line' bar.sti '1; $1 != $2 && !done { print $2, $1, $3; done = 1 }'
spoiled diagonal-negative 3 'the diagonal is negative' bar.sti '$1 == $2 && !done { $3 = -$3; done = 1 } 1'
spoiled dof-shorter 3 'bar.dof: error: node .* has no freedom 3' bar.dof 'NR < 210'
spoiled dof-longer 3 'bar.dof: error: node 9999 is not in the mesh' bar.dof '1; END { print "9999.1" }'
spoiled dof-twice 3 'bar.dof:5: error: freedom .* was given before' bar.dof 'NR == 4 { keep = $0 } NR == 5 { $0 = keep } 1'
spoiled dof-rotation 3 'bar.dof:4: error: node .* has freedom 5' bar.dof 'NR == 4 { sub(/\..*/, ".5") } 1'
spoiled stiffness-changed 4 'as a rigid body it pushes back' bar.sti '$1 == $2 && !done { $3 *= 1.001; done = 1 } 1'
spoiled mesh-of-another 4 'turned about . as a rigid body it pushes back' bar.inp '/^5,/ && !done { $0 = "5, 1, -0.06, -0.03"; done = 1 } 1'
spoiled mass-across 4 'has the same mass along' bar.mas '$1 == 1 && $2 == 1 { print 1, 2, 0.01 } 1'
spoiled coordinate-missing 3 'bar.inp:5: error: node 2: a coordinate' bar.inp 'NR == 5 { $3 = "x," } 1'
spoiled set-of-nothing 3 "neither a node number nor a node set" bar.inp '/NSET=root/ { print; getline; print "nowhere, 1"; next } 1'
spoiled set-too-large 3 'bar.inp:.* error: GENERATE makes more than' bar.inp '1; END { print "*NSET, NSET=all, GENERATE"; print "1, 2000000000" }'
spoiled include-of-itself 3 'goes deeper than' bar.inp '1; END { print "*INCLUDE, INPUT=bar.inp" }'
job
spoil bar.inp '{ sub("C3D20R", "C3D8I") } 1'
refuse stiffening-of-others 3 'element 1: expected 8 nodes\|element .* expected 8 nodes' -i root=root --material 1,0.3 --stiffening "$work/x/bar"
job
spoil bar.inp '{ sub("C3D20R", "S8R") } 1'
refuse stiffening-of-shells 4 'the mesh has no elements' -i root=root --material 1,0.3 --stiffening "$work/x/bar"
spoiled mesh-without-nodes 3 'there is no \*NODE' bar.inp '/^\*NODE/ { print "*NODES"; next } 1'
spoiled transformed 3 'bar.inp:1: error: \*TRANSFORM' bar.inp 'NR == 1 { print "*TRANSFORM, NSET=bar" } 1'
spoiled mass-negative 4 'the whole mass is -' bar.mas '$1 != $2 { $3 = -9 * $3 } 1'

# ---- Matrix Market ----

# A frame of four nodes: K = sum of springs along its edges, M lumped; market 1: node 4 hangs on node 1 alone.
market() {
    cat >"$work/x/nodes.csv" <<'T'
node,x,y,z,set
1,0,0,0,root
2,1,0,0,root
3,0,1,0,root
4,0,0,1,tip
T
    awk -v loose="${1:-0}" 'function spring(a, b, k,   d, l, i, j) {
            l = 0
            for (i = 1; i <= 3; i++) { d[i] = x[a, i] - x[b, i]; l += d[i] * d[i] }
            for (i = 1; i <= 3; i++) for (j = 1; j <= 3; j++) {
                K[3*a-3+i, 3*a-3+j] += k * d[i] * d[j] / l; K[3*b-3+i, 3*b-3+j] += k * d[i] * d[j] / l
                K[3*a-3+i, 3*b-3+j] -= k * d[i] * d[j] / l; K[3*b-3+i, 3*a-3+j] -= k * d[i] * d[j] / l
            }
        }
        BEGIN {
            x[2, 1] = 1; x[3, 2] = 1; x[4, 3] = 1
            for (a = 1; a <= 4; a++) for (b = 1; b < a; b++) if (!(loose && a == 4 && b > 1)) spring(a, b, 100)
            for (i = 1; i <= 12; i++) for (j = 1; j <= i; j++) if (K[i, j] != 0) text[n++] = i " " j " " K[i, j]
            print "%%MatrixMarket matrix coordinate real symmetric"
            print "12 12 " n
            for (i = 0; i < n; i++) print text[i]
        }' >"$work/x/K.mtx"
    awk 'BEGIN { print "%%MatrixMarket matrix coordinate real symmetric"; print "12 12 12"; for (i = 1; i <= 12; i++) print i, i, 2 }' >"$work/x/M.mtx"
}
bad_market() {
    bad_name=$1 bad_status=$2 bad_pattern=$3
    rm -rf "$work/x"
    mkdir "$work/x"
    market
    spoil "$4" "$5"
    refuse "$bad_name" "$bad_status" "$bad_pattern" -i root=root -n 2 "$work/x/K.mtx" "$work/x/M.mtx" "$work/x/nodes.csv"
}
rm -rf "$work/x"
mkdir "$work/x"
market
# Node 4 hangs on three springs: with the others held K = [50 0 -50; 0 50 -50; -50 -50 200], the lowest eigenvalue
# 125 - sqrt 10625, mass 2.
reduce -i root=root -n 2 "$work/x/K.mtx" "$work/x/M.mtx" "$work/x/nodes.csv" >"$work/out" 2>"$work/err"
rc=$?
sed -n 's/.*"hertz": \[\([0-9.]*\).*/\1/p' "$work/out" |
    awk '{ d = $1 - 0.5269249707670844; near = d < 1e-12 && d > -1e-12 } END { exit !near }'
expect market "0 0" "$rc $?" "$work/err"

# Entries alone, one triangle or both, as Abaqus writes them.
cp "$work/out" "$work/want"
cp "$work/x/K.mtx" "$work/x/K.whole"
sed 1,2d "$work/x/K.whole" >"$work/x/K.mtx"
reduce -i root=root -n 2 "$work/x/K.mtx" "$work/x/M.mtx" "$work/x/nodes.csv" >"$work/out" 2>"$work/err"
same "market-bare: one triangle" "$work/want" "$work/out"
awk 'NR > 2 { print; if ($1 != $2) print $2, $1, $3 }' "$work/x/K.whole" >"$work/x/K.mtx"
reduce -i root=root -n 2 "$work/x/K.mtx" "$work/x/M.mtx" "$work/x/nodes.csv" >"$work/out" 2>"$work/err"
same "market-bare: both triangles" "$work/want" "$work/out"

bad_market market-no-banner 3 'K.mtx:1: error: expected the line' K.mtx 'NR > 1'
bad_market market-complex 3 'only real and integer' K.mtx 'NR == 1 { $4 = "complex" } 1'
bad_market market-array 3 "only 'matrix coordinate'" K.mtx 'NR == 1 { $3 = "array" } 1'
bad_market market-too-few 3 'the file ends after .* of .* entries' K.mtx 'NR == 2 { $3++ } 1; END { print "" }'
bad_market market-too-many 3 'more entries than' K.mtx 'NR == 2 { $3-- } 1'
bad_market market-not-square 3 'not square' K.mtx 'NR == 2 { $2++ } 1'
bad_market market-wrong-size 3 'has 15 rows, the nodes have 12 freedoms' K.mtx 'NR == 2 { $1 = $2 = 15 } 1'
bad_market market-count-lies 3 'entries are said, the file has' K.mtx 'NR == 2 { $3 = 100000 } 1'
bad_market market-asymmetric 3 'K.mtx:.* error: the matrix is not symmetric' K.mtx 'NR == 1 { $5 = "general" } 1'
bad_market mass-not-positive 4 'M.mtx: error: the mass matrix is not positive, at node' M.mtx 'NR == 2 { $3 = 15 } 1; END { print "4 1 5\n5 2 5\n6 3 5" }'
bad_market mass-of-nothing 4 'M.mtx: error: the whole mass is 0' M.mtx 'NR > 2 { $3 = 0 } 1'
bad_market table-no-heading 3 'nodes.csv:1: error: column' nodes.csv 'NR > 1'
bad_market table-node-twice 3 'a node number occurs twice' nodes.csv 'NR == 3 { sub(/^2/, "1") } 1'
bad_market table-not-finite 3 'nodes.csv:4: error: y is not a finite number' nodes.csv 'NR == 4 { sub(/,1,/, ",inf,") } 1'
market 1
refuse part-not-joined 4 'not positive with the interfaces held, at node 4' -i root=root -n 2 "$work/x/K.mtx" "$work/x/M.mtx" \
    "$work/x/nodes.csv"

# Commands that cannot be done: the status, one line with these words, nothing on standard output.
m='%%MatrixMarket matrix coordinate real symmetric'
h='node,x,y,z,row_x,row_y,row_z,set'
mkdir "$work/c"
cp tests/reduce/bar.* "$work/c"
cd "$work/c" || exit 1
for empty in empty.sti empty.csv; do : >$empty; done
printf 'node,x,y\n1,0,0\n' >bad1.csv
printf 'node,x,y,z,row_x\n1,0,0,0,1\n' >bad2.csv
printf 'node,x,x,y,z\n1,0,0,0,0\n' >bad3.csv
printf '%s\n0,0,0,0,1,2,3,set1\n' $h >bad4.csv
printf '%s\n1,0,a,0,1,2,3,set1\n' $h >bad5.csv
printf '%s\n1,0,0,0,0,2,3,set1\n' $h >bad6.csv
printf '%s\n' $h >bad7.csv
printf 'x,y,z\n1,0,0\n' >bad8.csv
printf 'node,x,y,z more\n1,0,0,0\n' >bad9.csv
printf 'node,y,z\n1,0,0\n' >bad10.csv
printf 'node,x,z\n1,0,0\n' >bad11.csv
printf '%s\n1,0,0,0,1,2,3,set1\n2,1,0,0,4,5,6,set2\n' $h >good.csv
printf '%s\n6 6 1\n1 1 1.0\n' "$m" | tee M.mtx >K.mtx
echo words >k1.mtx
printf '%s\n6 6 1\n1 1 1\n' "$(echo "$m" | sed s/coordinate/array/)" >k2.mtx
printf '%s\n6 6 1\n1 1 1\n' "$(echo "$m" | sed s/real/complex/)" >k3.mtx
printf '%s\n6 6 1\n1 1 1\n' "$(echo "$m" | sed s/symmetric/skew-symmetric/)" >k4.mtx
printf '%s\n6 6\n1 1 1\n' "$m" >k5.mtx
printf '%s\n6 6 1\n7 1 1\n' "$m" >k6.mtx
printf '%s\n6 6 1\n1 1 x\n' "$m" >k7.mtx
printf '%s\n6 6 3\n1 1 1\n' "$m" >k8.mtx
printf '%s\n5 5 1\n1 1 1\n' "$m" >k9.mtx
while IFS=$(printf '\t') read -r want words arguments; do
    case $want in '' | '#'*) continue ;; esac
    "$REDUCE" $arguments >out 2>err </dev/null
    rc=$?
    if [ $rc != "$want" ] || [ -s out ]; then not_ok "fmdsub-reduce $arguments" "exit $rc, expected $want" out err
    elif [ "$(wc -l <err)" != 1 ] || ! grep -qF -- "$words" err; then not_ok "fmdsub-reduce $arguments" "expected one line with: $words" err
    else ok "fmdsub-reduce $arguments"; fi
done <"$ROOT/tests/reduce/commands.txt"
"$REDUCE" --help >out 2>err
ended "fmdsub-reduce --help" 0 $? out err
expect "fmdsub-reduce --version" "fmdsub-reduce $("$BUILD/fmdsub" --version | sed 's/fmdsub //')" "$("$REDUCE" --version)"
