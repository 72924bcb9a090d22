# exit 3 alone
# err control-character.yaml:2:9: error: a control character [E-character]
# err *a\x07b
printf 'fmdsub: 1\ntitle: a\007b\n'
