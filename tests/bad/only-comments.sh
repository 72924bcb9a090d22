# exit 3
# err only-comments.yaml:*error: * [E-empty]
echo "# nothing here"
