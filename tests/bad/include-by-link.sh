# exit 3
# err include-by-link.yaml:1:10: error: 'inside.yaml': is outside the deck's folder [E-path]
echo 'gravity: [0, 0]' >../outside.yaml
ln -s ../outside.yaml inside.yaml
echo 'include: inside.yaml'
