# exit 3 alone
# err utf16-bare.yaml:1:1: error: this is UTF-16; save the deck as UTF-8 [E-encoding]
printf 'f\0m\0d\0s\0u\0b\0:\0 \0001\0\n\0'
