# film.sh -- animations read back by others: VTK (python3-vtk9) and the Khronos validator of glTF (npm gltf-validator, where it
# is below GLTF, a folder with node_modules).
. tests/tools/lib.sh
need_program film
cd "$work" || exit 1
cat >beam.yaml <<'YAML'
fmdsub: 1
gravity: [0, -9.81]
bodies:
  arm:
    beam: {from: [0, 0], to: [2, 0], elements: 8}
    section: {rectangle: [0.02, 0.01]}
    material: steel
    modes: 4
    points: {tip: {station: 1}}
    stress: {root: {station: 0, corner: top}, mid: {station: 0.5, corner: top}, end: {station: 1, corner: top}}
constraints: {clamp: {fixed: [ground, arm], at: [0, 0]}}
integrate: {scheme: midpoint, step: 1.0e-3, until: 0.3}
output: {every: 0.01, columns: [arm.tip.x, arm.tip.y, arm.tip.dy, arm.root.von_mises]}
YAML
"$FMDSUB" animate -q --every 0.01 -o beam.pvd beam.yaml 2>err
ended "ParaView's files" 0 $? beam.pvd err
expect "a file a record" 31 "$(ls beam.*.vtu | wc -l)"
"$FMDSUB" run -q beam.yaml >beam.csv 2>err
python=
for try in python3 /usr/bin/python3; do command -v $try >/dev/null && $try -c 'import vtkmodules.vtkIOXML' 2>/dev/null && python=$try; done
if [ -n "$python" ]; then
    $python - >vtk.out 2>&1 <<'PY'
import csv, glob
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
rows = list(csv.DictReader(open("beam.csv")))
files = sorted(glob.glob("beam.*.vtu"))
apart, bend, stress, cells = 0, 0, 0, 0
for row, name in zip(rows, files):
    r = vtkXMLUnstructuredGridReader(); r.SetFileName(name); r.Update()
    g = r.GetOutput(); p = g.GetPointData()
    u, s = p.GetArray("displacement"), p.GetArray("stress")
    line = [i for c in range(g.GetNumberOfCells()) if g.GetCellType(c) == 3 for i in
            (g.GetCell(c).GetPointId(0), g.GetCell(c).GetPointId(1))]
    tip, root = max(line, key=lambda i: g.GetPoint(i)[0]), min(line, key=lambda i: g.GetPoint(i)[0])
    x = g.GetPoint(tip); cells = g.GetNumberOfCells()
    apart = max(apart, abs(x[1] - float(row["arm.tip.y"])))
    bend = max(bend, abs(u.GetTuple3(tip)[1] - float(row["arm.tip.dy"])))
    stress = max(stress, abs(s.GetValue(root) - float(row["arm.root.von_mises"])) / 1e7)
print(len(files) == len(rows) == 31, cells > 8, apart < 2e-4, bend < 1e-5, stress < 1e-5)
print(apart, bend, stress)
PY
    expect "VTK: the tip of a beam, its displacement, its stress at the root" "True True True True True" "$(head -n 1 vtk.out)" vtk.out
else
    skip "VTK" "it is not installed (Debian: python3-vtk9)"
fi

cat >validate.js <<'JS'
const fs = require('fs'), v = require('gltf-validator');
(async () => { for (const f of process.argv.slice(2)) { const r = await v.validateBytes(new Uint8Array(fs.readFileSync(f)));
  const i = r.issues; console.log(f.replace(/.*\//, ''), i.numErrors, i.numWarnings, i.messages.slice(0, 3).map(m => m.code + ' ' + m.pointer).join('; ')); } })();
JS
if command -v node >/dev/null && [ -d "${GLTF:-none}/node_modules/gltf-validator" ]; then
    for deck in pendulum bricard suspension flexible-crank flexible-robot chain; do
        "$FMDSUB" animate -q --every 0.05 -o $deck.glb "$ROOT/decks/$deck.yaml" 2>err || "$FMDSUB" animate -q -o $deck.glb "$ROOT/decks/$deck.yaml" 2>err
    done
    "$FMDSUB" animate -q -o beam.glb beam.yaml 2>err
    NODE_PATH=$GLTF/node_modules node validate.js ./*.glb >gltf.out 2>&1
    expect "glTF: seven files, no error and no warning" "7 0 0" "$(awk '{ n++; e += $2; w += $3 } END { print n, e, w }' gltf.out)" gltf.out
else
    skip "glTF by the validator of Khronos" "node or gltf-validator is not there (npm install gltf-validator; GLTF=that folder)"
fi
