# exit 3 alone
# err overlong-utf8.yaml:3:9: error: not UTF-8 text here [E-encoding]
printf 'fmdsub: 1\n# k\303\251y\ntitle: x\300\257\n'
