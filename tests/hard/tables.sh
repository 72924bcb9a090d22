# tables.sh -- a signal that is a table, read by other expressions: the same motion as by the same value written out; one of
# more than 200 points is refused.
. tests/tools/lib.sh
cd "$work" || exit 1
cat >deck.yaml <<'YAML'
fmdsub: 1
gravity: [0, -9.81]
bodies: {arm: {mass: 1, inertia: 1/12, at: [0.5, 0]}}
constraints: {pin: {revolute: [ground, arm], at: [0, 0]}}
signals:
  error: goal - pin.angle
  goal: {table: [[0.13, 0.1], [0.3, 0.5], [0.55, -0.2], [1, 0.4]]}
forces: {motor: {torque: pin, value: 60*error - 8*pin.angle_rate}}
integrate: {scheme: dop853, tolerance: 1.0e-10, until: 1.5}
output: {every: 0.25, columns: [pin.angle, goal, error]}
YAML
"$FMDSUB" run -q deck.yaml >table 2>err
ended "a table in an expression" 0 $? table err
"$FMDSUB" run -q -s 'signals.goal=if(t < 0.13, 0.1, if(t < 0.3, 0.1 + 0.4*(t - 0.13)/0.17, if(t < 0.55, 0.5 - 0.7*(t - 0.3)/0.25, if(t < 1, -0.2 + 0.6*(t - 0.55)/0.45, 0.4))))' deck.yaml >written 2>>err
expect "records" 8 "$(wc -l <table)" err
for n in 3 5 8; do near "as it is written out, record $n" "$(sed -n ${n}p written)" "$(sed -n ${n}p table)" 1e-9; done

awk 'BEGIN { for (i = 0; i < 201; i++) printf "%g,%g\n", i / 100, i % 7 }' >long.csv
"$FMDSUB" check -s 'signals.goal={file: long.csv}' deck.yaml >out 2>err
expect "a long one" 3 $? err
expect "a long one: said" 1 "$(grep -c "signal 'goal' is a table of many points, which stands by itself" err)" err
