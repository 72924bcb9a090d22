# exit 3 alone
# err zero-byte.yaml:*error: *
printf 'fmdsub: 1\ntitle: a\0b\n'
