# onto.sh -- conditions that end a run, and ranges that are left: schemes with a tolerance step onto them, to 1e-9.
. tests/tools/lib.sh

# A body that falls passes -2 m at sqrt(4/9.81) s, under every scheme within its first steps, which would lead to seconds later.
for scheme in dopri5 dop853 radau5 radau9 rk4 newmark midpoint subcycle; do
    go "falls past a height, $scheme" 0 <<END
fmdsub: 1
gravity: [0, -9.81]
bodies: {ball: {mass: 1, inertia: 1, at: [0, 0]}}
constraints: {v: {prismatic: [ground, ball], axis: [0, 1]}}
integrate: {scheme: $scheme, tolerance: 1.0e-4, until: {when: "v.displacement < -2", latest: 5}}
output: {every: 0.5, columns: [v.displacement, v.displacement_rate]}
END
    near "falls past a height, $scheme" "0.638550856814101,-2,-6.264183905346329" "$last" 1e-9
done

# A spring of 1 rad/s from 1 m: 2 pi/3 and 4 pi/3 s at -0.5 m, and again a period later; 0.99 m and on the way back within 0.15 s.
spring() { # SCHEME UNTIL
    cat <<END
fmdsub: 1
bodies: {ball: {mass: 1, inertia: 1, at: [0, 0]}}
constraints: {v: {prismatic: [ground, ball], axis: [0, 1], range: [-0.5, 5]}}
forces: {s: {spring: v, stiffness: 1}}
initial: {v.displacement: 1}
integrate: {scheme: $1, tolerance: 1.0e-7, until: $2}
output: {every: 1, columns: [v.displacement]}
END
}
for scheme in dopri5 dop853 radau5; do
    spring $scheme 12 >"$work/spring.yaml"
    go "a range, $scheme" 0 -f ndjson <"$work/spring.yaml"
    near "a range, $scheme: when" "2.094395102,4.188790205,8.377580410,10.471975512" \
        "$(sed -n 's/.*"event","t":\([^,]*\),"kind":"range".*/\1/p' "$work/out" | tr '\n' ',' | sed 's/,$//')" 3e-6
done
for scheme in dopri5 dop853 radau9; do
    spring $scheme '{when: "v.displacement > 0.99 and v.displacement_rate < 0 and t > 1", latest: 20}' >"$work/spring.yaml"
    go "true for a seventh of a second, $scheme" 0 <"$work/spring.yaml"
    near "true for a seventh of a second, $scheme: when" "1,6.283185307" "1,${last%%,*}" 1e-5
done
