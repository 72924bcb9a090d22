# exit 7
# err huge-repeat.yaml:*error: * [E-limit-repeat]
cat <<'DECK'
fmdsub: 1
title: bad
bodies:
  ball$i: {repeat: {i: [1, 100000000]}, mass: 1, at: [i, 0]}
integrate: {scheme: newmark, step: 1.0e-2, until: 1}
DECK
