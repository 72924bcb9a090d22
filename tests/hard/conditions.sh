# conditions.sh -- a condition that is not a number is neither true nor false: it ends a run or a force with words.
. tests/tools/lib.sh

# ending CONDITION: a bob that passes 0 at t = 1.
ending() {
    echo 'fmdsub: 1
bodies: {bob: {mass: 1, inertia: 0.1, at: [1, 0]}}
constraints: {pin: {prismatic: [ground, bob], at: [0, 0], axis: [1, 0]}}
gravity: [0, 0]
initial: {pin.displacement: 1, pin.displacement_rate: -1}'
    echo "integrate: {scheme: midpoint, step: 0.01, until: {when: \"$1\", latest: 3}}"
}
# ends NAME STATUS CONDITION PATTERN
ends() {
    ending "$3" | go "$1" "$2"
    told "$1" "$4"
}
ends "of a root" 5 'sqrt(pin.displacement) > 2' 'stopped at t = 1[.01]* s: the condition at .*deck.yaml:6:[0-9]* that ends the run is not a number; look for roots.*not-finite'
ends "negated" 0 'not sqrt(pin.displacement) > 0.5' "done at t = 0.7[56] s"
ends "of a quotient" 0 'pin.displacement/t > 5' "is true at the start"
ends "of 0/0" 5 '(pin.displacement - 1)/t < -2' 'stopped at t = 0 s: the condition'
ends "guarded" 0 'pin.displacement > 0 and sqrt(pin.displacement) < 0.5' "done at t = 0.7[56] s"
{
    ending 't < 0'
    echo 'forces: {stop: {force: pin.displacement, value: "if(sqrt(pin.displacement) < 0.1, 50, 0)"}}'
} | go "of a force" 5
told "of a force" "force 'stop' is not a number"
