# exit 3 alone
# err utf16.yaml:*error: * [E-encoding]
printf '\377\376f\0m\0d\0s\0u\0b\0:\0 \0001\0\n\0'
