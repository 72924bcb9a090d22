# exit 3
# err include-outside.yaml:*error: * [E-include]
printf 'fmdsub: 1\ninclude: ../../etc/passwd\n'
