# exit 3
# err byte-order-mark.yaml:2:17: error: '010' is not a number: * [E-number]
printf '\357\273\277fmdsub: 1\nparameters: {a: 010}\n'
