# page.sh -- a page of a study (--report).
. tests/tools/lib.sh

# A page of it: whole, nothing from outside, the deck and the command in it, markup in the deck as text; the same twice.
cat >"$work/page.yaml" <<'YAML'
fmdsub: 1
title: "a <b> & c"
bodies: {ball: {mass: 1, inertia: 0.1, at: [1, 0]}}
constraints: {pin: {revolute: [ground, ball], at: [0, 0]}}
forces: {spring: {spring: pin, stiffness: 10}}
initial: {pin.angle: 0.3}
integrate: {scheme: newmark, step: 1.0e-2, until: 1}
output: {every: 0.1, columns: [pin.angle, "energy.*"]}
YAML
for i in 1 2; do
    (cd "$work" && "$FMDSUB" study -q --budget 5 --repeats 0 --report page.html page.yaml >page.csv 2>err)
    ended "a page, $i" 0 $? "$work/page.html" "$work/err"
    mv "$work/page.html" "$work/page$i.html"
done
same "the same page twice" "$work/page1.html" "$work/page2.html"
expect "the page has what it says" "1 2 1 0 0" "$(grep -c '</html>' "$work/page1.html") $(grep -c '<svg' "$work/page1.html") $(grep -c '^title: &quot;a &lt;b&gt; &amp; c&quot;' "$work/page1.html") $(grep -c 'https*://\|src=' "$work/page1.html") $(grep -c 'nan\|inf' "$work/page1.html")" "$work/page1.html"
expect "and the command" 1 "$(grep -c 'fmdsub study -q --budget 5 --repeats 0 --report page.html page.yaml' "$work/page1.html")"
