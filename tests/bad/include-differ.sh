# exit 3
# err b.yaml:1:1: error: included files differ in 'gravity' [E-conflict]
# err a.yaml:1:1: note: the other value is here
echo 'gravity: [0, 0]' >a.yaml
echo 'gravity: [0, 1]' >b.yaml
echo 'include: [a.yaml, b.yaml]'
