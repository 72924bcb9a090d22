# exit 7
# err deep-expression.yaml:*error: *
printf 'fmdsub: 1\ntitle: bad\nparameters: {a: '
head -c 50000 /dev/zero | tr '\0' '('
printf '1'
head -c 50000 /dev/zero | tr '\0' ')'
printf '}\n'
