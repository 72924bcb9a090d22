# H33: reduced bodies that are none: a mode twice, a mass matrix that is not positive, one that is not finite: refused.
rod="$ROOT/tests/decks/crank-rod-testset.json"
reduced() { printf 'fmdsub: 1\nbodies: {rod: {flexible: rod.json, origin: [0, 0]}}\nconstraints: {pin: {revolute: [ground, rod], at: [0, 0]}}\nintegrate: {step: 1.0e-4, until: 0.01}\noutput: {columns: [pin.angle]}\n'; }
sed 's/"mass": 0.15/"mass": -0.15/' "$rod" >rod.json
reduced | row deck told 'mass'
sed 's/"ff": \[0, 0, 0, 0, 0.0755/"ff": [0, 0, 0, 0, -0.0755/' "$rod" >rod.json
reduced | row deck told 'positive\|definite\|mass'
sed 's/"K": \[123144/"K": [nan, 123144/' "$rod" >rod.json
reduced | row deck told 'number\|finite\|rod.json'
sed 's/"modes": 4/"modes": 400/' "$rod" >rod.json
reduced | row deck told 'rod.json'
