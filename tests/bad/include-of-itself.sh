# exit 3
# err include-of-itself.yaml:*error: * [E-include]
printf 'fmdsub: 1\ninclude: include-of-itself.yaml\n'
