# exit 3
# err empty.yaml:*error: * [E-empty]
:
