# exit 3 alone
# err flexible-not-placed.yaml:*: error: body 'bar': expected 'at' or 'origin'*[E-missing-key]
cp "${0%/bad/*}/reduce/as-one.json" body.json
cat <<'END'
fmdsub: 1
space: 3d
bodies:
  bar: {flexible: body.json}
constraints:
  hinge: {revolute: [ground, bar], at: [0, 0, 0], axis: [0, 0, 1]}
integrate: {scheme: newmark, step: 1.0e-5, until: 1.0e-4}
END
