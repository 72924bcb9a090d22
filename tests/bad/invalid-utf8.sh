# exit 3 alone
# err invalid-utf8.yaml:2:10: error: * [E-encoding]
printf 'fmdsub: 1\ntitle: ab\300\257c\n'
