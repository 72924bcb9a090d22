# overshoot.sh -- hht and generalized-alpha overshoot a start that the step does not resolve; that is the schemes' own: the first
# step is the closed form of their formulas to round-off, and with a stiff damper -(gamma - 1/2)^2/(4 gamma) h^2 a0, which
# fmdsub-equations(7) derives.
. tests/tools/lib.sh
cat >"$work/deck.yaml" <<'END'
fmdsub: 1
bodies: {b: {mass: 1, at: [0, 0]}}
constraints: {p: {prismatic: [ground, b], at: [0, 0], axis: [1, 0]}}
forces: {d: {damper: p, damping: 1.0e+8}, f: {force: p, value: 1}}
integrate: {scheme: hht, step: 0.02, until: 0.02}
output: {every: 0.02, columns: [p.displacement, p.displacement_rate]}
END
# m and f of the scheme
while IFS='|' read -r scheme m f; do
    for c in 1.0e+4 1.0e+8; do
        "$FMDSUB" run -q -s "integrate={scheme: $scheme, step: 0.02, until: 0.02}" -s "forces.d.damping=$c" "$work/deck.yaml" 2>"$work/err" | tail -n 1 >"$work/row"
        awk -F , -v m="$m" -v f="$f" -v c=$c '{
            h = .02; g = .5 + f - m; b = (g + .5)^2/4
            a = (1 - m - (1 - f)*c*h*(1 - g))/(1 - m + (1 - f)*c*h*g)
            x = h*h*(.5 - b + b*a); v = h*(1 - g + g*a); limit = -(g - .5)^2/(4*g)*h*h
            size = h*h/4
            printf "x %.6g by hand %.6g, at last %.6g; v %.6g by hand %.6g\n", $2, x, limit, $3, v
            good = NF == 3 && ($2 - x)^2 < 1e-18*size^2 && ($3 - v)^2 < 1e-18*h^2 && (c < 1e7 || ($2 - limit)^2 < 1e-8*size^2) }
            END { exit !good }' "$work/row" >"$work/line"
        if [ $? = 0 ]; then ok "first step of a stiff damper, $scheme, $c: $(cat "$work/line")"
        else not_ok "first step of a stiff damper, $scheme, $c" "$(cat "$work/line")" "$work/err"; fi
    done
done <<'END'
hht, alpha: -0.05|0|0.05
hht, alpha: -0.3|0|0.3
generalized-alpha, rho_infinity: 0|-1|0
generalized-alpha, rho_infinity: 0.5|0|0.3333333333333333333
generalized-alpha, rho_infinity: 1|0.5|0.5
newmark|0|0
END
