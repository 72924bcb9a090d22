# exit 3 alone
# err only-comments.yaml:*error: * [E-empty]
echo "# nothing here"
