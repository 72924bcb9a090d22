# exit 3 alone
# err empty.yaml:*error: * [E-empty]
:
