# exit 7
# err *endless-deck.yaml: larger than 16777216 bytes
head -c 17000000 /dev/zero | tr '\0' ' '
