# exit 3
# err lines-end-in-lone-cr.yaml:4:3: error: key 'a' is given twice [E-duplicate]
# err lines-end-in-lone-cr.yaml:3:3: note: first given here
printf 'fmdsub: 1\rparameters:\r  a: 1\r  a: 2\r'
