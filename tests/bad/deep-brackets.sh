# exit 7
# err deep-brackets.yaml:*error: * [E-limit-depth]
head -c 1000000 /dev/zero | tr '\0' '['
