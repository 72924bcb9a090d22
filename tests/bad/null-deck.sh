# exit 3 alone
# err null-deck.yaml:1:1: error: *
echo "null"
