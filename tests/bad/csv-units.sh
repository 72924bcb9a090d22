# exit 3 alone
# err f.csv:2:1: error: expected a number, found 's' [E-csv]
# err *one row of names may come first: units stand behind a '#'
printf 'time,torque\ns,Nm\n0,1\n1,2\n2,3\n' >f.csv
cat <<END
fmdsub: 1
bodies: {arm: {mass: 1, inertia: 0.1, at: [1, 0]}}
constraints: {pin: {revolute: [ground, arm], at: [0, 0]}}
forces: {f: {torque: pin, value: {file: f.csv}}}
integrate: {scheme: newmark, step: 1.0e-2, until: 1}
END
