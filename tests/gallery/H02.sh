# H02: a slider-crank that stands in its dead centre with the slider's speed given: no crank's speed belongs to it.
for scheme in $schemes; do
    row $scheme told 'rail' <<'DECK'
fmdsub: 1
bodies:
  crank: {mass: 1, inertia: 0.01, at: [0.075, 0]}
  rod: {mass: 1, inertia: 0.01, at: [0.325, 0]}
  slider: {mass: 1, at: [0.5, 0]}
constraints:
  shaft: {revolute: [ground, crank], at: [0, 0]}
  elbow: {revolute: [crank, rod], at: [0.15, 0]}
  wrist: {revolute: [rod, slider], at: [0.5, 0]}
  rail: {prismatic: [ground, slider], axis: [1, 0]}
initial: {rail.displacement_rate: 1}
integrate: {step: 1.0e-3, until: 1}
DECK
done
