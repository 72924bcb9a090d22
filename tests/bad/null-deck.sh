# exit 3
# err null-deck.yaml:1:1: error: *
echo "null"
