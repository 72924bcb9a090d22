# exit 3 alone
# err flexible-placed-twice.yaml:*: error: body 'bar': expected 'at' or 'origin'*[E-two-kinds]
cp "${0%/bad/*}/reduce/as-one.json" body.json
cat <<'END'
fmdsub: 1
space: 3d
bodies:
  bar: {flexible: body.json, at: [0, 0, 0], origin: [0, 0, 0]}
constraints:
  hinge: {revolute: [ground, bar], at: [0, 0, 0], axis: [0, 0, 1]}
integrate: {scheme: newmark, step: 1.0e-5, until: 1.0e-4}
END
