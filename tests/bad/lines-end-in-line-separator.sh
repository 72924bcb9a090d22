# exit 3
# err lines-end-in-line-separator.yaml:4:3: error: key 'a' is given twice [E-duplicate]
# err lines-end-in-line-separator.yaml:3:3: note: first given here
printf 'fmdsub: 1\342\200\250parameters:\342\200\250  a: 1\342\200\250  a: 2\342\200\250'
