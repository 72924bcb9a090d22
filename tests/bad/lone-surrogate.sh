# exit 3 alone
# err lone-surrogate.yaml:2:9: error: not UTF-8 text here [E-encoding]
printf 'fmdsub: 1\ntitle: \303\251\355\240\200\n'
