# exit 3
# err include-outside.yaml:*error: * [E-path]
printf 'fmdsub: 1\ninclude: ../../etc/passwd\n'
