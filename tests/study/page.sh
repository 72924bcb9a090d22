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
# A point of the diagram for every row that came to its end and has an error, where the ticks say; all of it within the frame.
awk -F, '
    function x_of(work) { return at["x", 1] + (log(work) / log(10) - tick["x", 1]) * (at["x", n["x"]] - at["x", 1]) / (tick["x", n["x"]] - tick["x", 1]) }
    function y_of(error) { return at["y", 1] + (log(error) / log(10) - tick["y", 1]) * (at["y", n["y"]] - at["y", 1]) / (tick["y", n["y"]] - tick["y", 1]) }
    FNR == 1 { file++ }
    file == 1 && /<svg/ { pictures++ }
    file == 1 && pictures == 1 && /class="grid"/ {
        axis = /"middle"/ ? "x" : "y"; split($0, word, "\""); label = $0
        sub(/.*>1e/, "", label); sub(/<.*/, "", label)
        tick[axis, ++n[axis]] = label; at[axis, n[axis]] = axis == "x" ? word[6] : word[8] - 4
    }
    file == 1 && pictures == 1 && /<circle r="4"/ { split($0, word, "\""); cx[++points] = word[6]; cy[points] = word[8] }
    file == 1 && / d="M[0-9.]* [0-9.-]*L/ && !/grid/ {
        path = $0; sub(/.* d="M/, "", path); sub(/".*/, "", path); m = split(path, corner, "L")
        for (i = 1; i <= m; i++) { split(corner[i], p, " "); if (p[1] < 70 || p[1] > 570 || p[2] < 20 || p[2] > 370) { print "beyond the frame: " corner[i]; bad = 1 } }
    }
    file == 2 && /^scheme/ { for (i = 1; i <= NF; i++) column[$i] = i; next }
    file == 2 && $column["status"] ~ /^(ok|reference)$/ && $column["error"] > 0 {
        rows++; found = 0
        for (i = 1; i <= points; i++) { dx = cx[i] - x_of($column["work"]); dy = cy[i] - y_of($column["error"]); if (dx * dx + dy * dy < 1) found = 1 }
        if (!found) { print "no point for " $0; bad = 1 }
    }
    END { if (rows != points) print rows " rows, " points " points"; exit bad || rows != points || rows < 10 }' "$work/page1.html" "$work/page.csv" >"$work/wrong"
expect "its diagram has the rows" 0 $? "$work/wrong"
expect "and the command" 1 "$(grep -c 'fmdsub study -q --budget 5 --repeats 0 --report page.html page.yaml' "$work/page1.html")"
