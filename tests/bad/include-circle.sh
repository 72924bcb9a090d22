# exit 3
# err b.yaml:1:10: error: files include each other: a.yaml -> b.yaml -> a.yaml [E-include]
echo 'include: b.yaml' >a.yaml
echo 'include: a.yaml' >b.yaml
echo 'include: a.yaml'
