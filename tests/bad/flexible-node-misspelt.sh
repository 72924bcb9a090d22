# exit 3 alone
# err flexible-node-misspelt.yaml:*: error: body 'bar' has no node 'tpi'*[E-unknown-point]
cp "${0%/bad/*}/reduce/as-one.json" body.json
cat <<'END'
fmdsub: 1
space: 3d
bodies:
  bar: {flexible: body.json, origin: [0, 0, 0], points: {end: tpi}}
constraints:
  hinge: {revolute: [ground, bar], at: [0, 0, 0], axis: [0, 0, 1]}
integrate: {scheme: newmark, step: 1.0e-5, until: 1.0e-4}
END
