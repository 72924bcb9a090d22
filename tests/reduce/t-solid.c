/* t-solid.c -- solid elements: in an affine image of the unit element a field that the shape functions hold exactly has, at
 * every node, the gradient of the polynomial; its integration points weigh the volume. */
#include "reduce/bar.h"
#include "reduce/solid.h"

/* Corners of the unit elements; the nodes between two of them follow in CalculiX' order. */
static const double tet[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
static const double hex[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                 {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
static const int tet_mid[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
static const int hex_mid[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                   {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};

/* x = F xi + (3, -1, 2); det F = 2 * 1.5 * 0.8 + ... is computed where it is needed. */
static const double F[3][3] = {{2, .3, -.1}, {.2, 1.5, .4}, {-.3, .1, .8}};

static void place(double *x, const double *xi)
{
    static const double origin[3] = {3, -1, 2};
    for (int a = 0; a < 3; a++) x[a] = origin[a] + F[a][0] * xi[0] + F[a][1] * xi[1] + F[a][2] * xi[2];
}

static void nodes_of(double *x, int nodes)
{
    const int corners = nodes == 20 ? 8 : 4;
    for (int i = 0; i < nodes; i++) {
        double xi[3];
        const int *ends = i < corners ? NULL : corners == 8 ? hex_mid[i - 8] : tet_mid[i - 4];
        for (int a = 0; a < 3; a++)
            xi[a] = corners == 8 ? (ends ? (hex[ends[0]][a] + hex[ends[1]][a]) / 2 : hex[i][a])
                                 : (ends ? (tet[ends[0]][a] + tet[ends[1]][a]) / 2 : tet[i][a]);
        place(x + 3 * i, xi);
    }
}

/* u_a = A_ab x_b + (square ? c_a (x_0^2 + 2 x_0 x_1 - x_1 x_2 + 3 x_2^2) : 0), and du_a/dx_b. */
static const double A[3][3] = {{.1, .7, -.2}, {.4, -.3, .5}, {-.6, .2, .9}}, C[3] = {.3, -.5, .2};

static void field(double *u, const double *x, bool square)
{
    const double s = square ? x[0] * x[0] + 2 * x[0] * x[1] - x[1] * x[2] + 3 * x[2] * x[2] : 0;
    for (int a = 0; a < 3; a++) u[a] = A[a][0] * x[0] + A[a][1] * x[1] + A[a][2] * x[2] + C[a] * s;
}

static double slope(const double *x, int a, int b, bool square)
{
    const double s[3] = {2 * x[0] + 2 * x[1], 2 * x[0] - x[2], -x[1] + 6 * x[2]};
    return A[a][b] + (square ? C[a] * s[b] : 0);
}

static void element(int nodes, bool square, double volume)
{
    double x[60], u[60], g[SOLID_POINTS][9], weighed = 0;
    const int points = solid_points(nodes);
    assert_true(solid_known(nodes));
    nodes_of(x, nodes);
    for (int i = 0; i < nodes; i++) field(u + 3 * i, x + 3 * i, square);
    for (int p = 0; p < points; p++) weighed += solid_weight(nodes) * solid_gradient(g[p], nodes, p, x, u);
    close_to(weighed, volume, 1e-12 * volume, "the volume");
    for (int i = 0; i < nodes; i++) {
        double w[SOLID_POINTS] = {0}, all = 0;
        solid_weights(w, nodes, i);
        for (int p = 0; p < points; p++) all += w[p];
        close_to(all, 1, 1e-12, "weights of a constant");
        for (int b = 0; b < 3; b++)
            for (int a = 0; a < 3; a++) {
                double sum = 0;
                for (int p = 0; p < points; p++) sum += w[p] * g[p][a + 3 * b];
                close_to(sum, slope(x + 3 * i, a, b, square), 1e-11, "the gradient at a node");
            }
    }
}

static void test_elements(void **state)
{
    const double det = F[0][0] * (F[1][1] * F[2][2] - F[1][2] * F[2][1]) -
                       F[0][1] * (F[1][0] * F[2][2] - F[1][2] * F[2][0]) +
                       F[0][2] * (F[1][0] * F[2][1] - F[1][1] * F[2][0]);
    (void)state;
    element(4, false, det / 6);
    element(10, false, det / 6);
    element(10, true, det / 6);
    element(20, false, 8 * det);
    element(20, true, 8 * det);
    assert_false(solid_known(8));
    assert_false(solid_known(15));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_elements)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
