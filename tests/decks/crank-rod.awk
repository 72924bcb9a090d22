# crank-rod.awk -- the flexible rod of Simeon's slider-crank as a reduced body, in closed form:
#
#     awk -f tests/decks/crank-rod.awk >tests/decks/crank-rod.json
#     awk -v testset=1 -f tests/decks/crank-rod.awk >tests/decks/crank-rod-testset.json
#
# A rod from x = 0 to l with mass m, in the frame of its chord: lateral displacement q1 sin(pi s) + q2 sin(2 pi s),
# axial 4 s (1 - s) q3 + s (2 s - 1) q4, s = x/l.  With the centre of mass at s = 1/2 and X = x - l/2:
#
#     int phi:         axial 2/3, 1/6; lateral 2/pi, 0                                             [m]
#     int X phi:       axial 0, 1/12; lateral 0, -1/(2 pi)                                         [m l]
#     int phi_i phi_j: axial [8 1; 1 2]/15; lateral 1/2 each; sine with axial 4 s(1-s): 16/pi^3, 0,
#                      with s(2s-1): 1/pi - 8/pi^3, 1/(2 pi)                                       [m]
#     K:               E A/l [16 -8; -8 7]/3, E I pi^4/(2 l^3) and 16 times that
#
# The test set has int phi phi of the axial shapes without 1/15, and its pi is 3.1415927; testset=1 gives that rod.  The moment of inertia about
# the crank's end is 0.0045339259 as printed there.  No rotary inertia of bending, no geometric stiffness.  The pin
# stands in the chord, whose turn is that of the frame, so it does not turn in it: a pin bears no moment.
function put(key, x, n,    i)
{
    printf ",\n \"%s\": [", key
    for (i = 0; i < n; i++) printf "%s%s", i ? ", " : "", num(x[i] + 0)
    printf "]"
    delete x
}
function num(x) { return x == 0 ? "0" : sprintf("%.17g", x) }
function pair(i, j, a, b, value) # int phi_ia phi_jb, a and b 1 ... 3, i and j 1 ... n
{
    ff[a - 1 + 3 * (b - 1) + 9 * (i - 1 + n * (j - 1))] = value
    ff[b - 1 + 3 * (a - 1) + 9 * (j - 1 + n * (i - 1))] = value
}
function node(name, x, phi, psi,    u, S)
{
    printf "  {\"name\": \"%s\", \"x\": [%s, 0, 0], \"phi\": [%s],\n   \"psi\": [%s]", name, num(x), phi, psi
    if (stiff) {
        u = x / l + .5
        S[0] = -(pi / l) ^ 2 * (u * l / 2 + l / (4 * pi) * sin(2 * pi * u))
        S[15] = -(2 * pi / l) ^ 2 * (u * l / 2 + l / (8 * pi) * sin(4 * pi * u))
        S[3] = S[12] = -pi / l * (sin(3 * pi * u) / 3 + sin(pi * u))
        put("S", S, 3 * n * n)
    }
    printf "}"
}
BEGIN {
    pi = testset ? 3.1415927 : atan2(0, -1); n = 4; l = .3; b = .008; E = 2e11; m = .151104; J = .0045339259; A = b * b; I = A * A / 12
    scale = testset ? 1 : 1 / 15
    printf "{\"fmdsub_flex\": 1, \"modes\": %d, \"reference\": 0,\n \"comment\": \"%s\",\n", n, \
        "connecting rod of Simeon's slider-crank, four shapes; made by crank-rod.awk"
    printf " \"at\": [%s, 0, 0],\n \"mass\": %s", num(l / 2), num(m)
    xx[0] = J - m * l * l / 4; put("xx", xx, 9)
    put("rot", rot, 9)
    f[1] = 2 / pi * m; f[6] = 2 / 3 * m; f[9] = m / 6; put("f", f, 3 * n)
    xf[3 + 9 * 1] = -m * l / (2 * pi); xf[0 + 9 * 3] = m * l / 12; put("xf", xf, 9 * n)
    pair(1, 1, 2, 2, m / 2); pair(2, 2, 2, 2, m / 2)
    pair(3, 3, 1, 1, 8 * scale * m); pair(3, 4, 1, 1, scale * m); pair(4, 4, 1, 1, 2 * scale * m)
    pair(1, 3, 2, 1, 16 / pi ^ 3 * m); pair(1, 4, 2, 1, (1 / pi - 8 / pi ^ 3) * m); pair(2, 4, 2, 1, -m / (2 * pi))
    put("ff", ff, 9 * n * n)
    if (stiff) {
        s2[0] = -m * (pi / l) ^ 2 * l / 4; s2[15] = 4 * s2[0]                      # int x/2 = l2/4, the sines have no mean
        s2[3] = s2[12] = -m * pi / l * (2 / (9 * pi) + 2 / pi)
        put("s", s2, 3 * n * n)
        xs[0] = -m * (pi / l) ^ 2 * l * l * (1 / 24 - 1 / (8 * pi ^ 2))
        xs[45] = -m * (2 * pi / l) ^ 2 * l * l * (1 / 24 - 1 / (32 * pi ^ 2))
        put("xs", xs, 9 * n * n)
    }
    put("rpsi", rpsi, 3 * n)
    put("ppsi", ppsi, n * n)
    k = E * I * pi ^ 4 / (2 * l ^ 3); K[0] = k; K[5] = 16 * k
    k = E * A / (3 * l); K[10] = 16 * k; K[15] = 7 * k; K[11] = K[14] = -8 * k; put("K", K, n * n)
    printf ",\n \"nodes\": [\n"
    zero = "0, 0, 0"
    node("pin", -l / 2, zero ", " zero ", " zero ", " zero, zero ", " zero ", " zero ", " zero); print ","
    node("middle", 0, "0, 1, 0, " zero ", 1, 0, 0, 0, 0, 0", "0, 0, 0, 0, 0, " num(-2 * pi / l) ", " zero ", " zero)
    print ","
    node("wrist", l / 2, zero ", " zero ", " zero ", 1, 0, 0", "0, 0, " num(-pi / l) ", 0, 0, " num(2 * pi / l) ", " zero ", " zero)
    print "],\n \"stresses\": []}"
}
