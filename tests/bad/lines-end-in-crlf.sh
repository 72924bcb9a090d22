# exit 3
# err lines-end-in-crlf.yaml:4:3: error: key 'a' is given twice [E-duplicate]
# err lines-end-in-crlf.yaml:3:3: note: first given here
printf 'fmdsub: 1\r\nparameters:\r\n  a: 1\r\n  a: 2\r\n'
