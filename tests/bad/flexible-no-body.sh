# exit 3 alone
# err flexible-no-body.yaml:4:19: error: 'arm.json': *[E-flexible]
echo '{"fmdsub_flex": 1, "modes": 2}' >arm.json
cat <<'END'
fmdsub: 1
title: bad
bodies:
  arm: {flexible: arm.json, at: [0, 0, 0]}
constraints:
  clamp: {fixed: [ground, arm], at: [0, 0, 0]}
integrate: {scheme: newmark, step: 1.0e-2, until: 1}
END
