# exit 3
# err lines-end-in-nel.yaml:4:3: error: key 'a' is given twice [E-duplicate]
# err lines-end-in-nel.yaml:3:3: note: first given here
printf 'fmdsub: 1\302\205parameters:\302\205  a: 1\302\205  a: 2\302\205'
