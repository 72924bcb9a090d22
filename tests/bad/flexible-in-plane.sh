# exit 3 alone
# err flexible-in-plane.yaml:4:19: error: 'arm.json' moves out of the plane of x and y: it needs a 3-D deck [E-dimension]
cat >arm.json <<'END'
{"fmdsub_flex": 1, "modes": 1, "reference": 0, "at": [0.5, 0, 0], "mass": 1, "xx": [0.08333333333333333, 0,
0, 0, 0, 0, 0, 0, 0], "rot": [0, 0, 0, 0, 0, 0, 0, 0, 0], "f": [0, 0, 0.4], "xf": [0, 0, 0, 0, 0, 0, 0.1, 0,
0], "ff": [0, 0, 0, 0, 0, 0, 0, 0, 0.25], "rpsi": [0, 0, 0], "ppsi": [0], "K": [100], "nodes": [{"name":
"root", "x": [-0.5, 0, 0], "phi": [0, 0, 0], "psi": [0, 0, 0]}, {"name": "tip", "x": [0.5, 0, 0], "phi": [0,
0, 1], "psi": [0, -1.4, 0]}], "stresses": []}
END
cat <<'END'
fmdsub: 1
title: bad
bodies:
  arm: {flexible: arm.json, at: [0, 0]}
constraints:
  clamp: {fixed: [ground, arm], at: [0, 0]}
integrate: {scheme: newmark, step: 1.0e-2, until: 1}
END
