# exit 3
# err include-a-folder.yaml:1:10: error: 'sub': is not a regular file [E-path]
mkdir sub
echo 'include: sub'
