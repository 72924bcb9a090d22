# exit 7
# err deep-blocks.yaml:*error: * [E-limit-depth]
awk 'BEGIN { for (i = 0; i < 200; i++) { printf "%" i "s", ""; print "a:" } }'
