# exit 7
# err long-scalar.yaml:*error: * [E-limit-scalar]
printf 'fmdsub: 1\ntitle: '; head -c 2000000 /dev/zero | tr '\0' x; echo
