# exit 7
# err alias-bomb.yaml:*error: *
echo "a: &a [x, x, x, x, x, x, x, x, x]"
for p in "b a" "c b" "d c" "e d" "f e" "g f" "h g" "i h"; do
    set -- $p
    echo "$1: &$1 [*$2, *$2, *$2, *$2, *$2, *$2, *$2, *$2, *$2]"
done
