/* solid.c -- shape functions: complete quadratic tetrahedron, serendipity hexahedron (Zienkiewicz & Taylor); see
 * solid.h */
#include "reduce/solid.h"

#include <math.h>
#include <string.h>

#include "la/vec3.h"

static const double corner[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                    {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
/* Nodes between corners. */
static const int hex_edge[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                    {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
static const int tet_edge[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};

/* Four points of degree two: one coordinate near, three far. */
static const double near = 0.58541019662496845446, far = 0.13819660112501051518;

bool solid_known(int nodes)
{
    return nodes == 4 || nodes == 10 || nodes == 20;
}

int solid_points(int nodes)
{
    return nodes == 20 ? 8 : 4;
}

static void hex_place(double *c, int i)
{
    for (int a = 0; a < 3; a++)
        c[a] = i < 8 ? corner[i][a] : (corner[hex_edge[i - 8][0]][a] + corner[hex_edge[i - 8][1]][a]) / 2;
}

/* dN/dr [3 x 20]: corner (1+a)(1+b)(1+c)(a+b+c-2)/8 with a = r r_i ...; between (1-r2)(1+b)(1+c)/4. */
static void hex_slopes(double *d, const double *r)
{
    for (int i = 0; i < 20; i++) {
        double c[3], f[3];
        hex_place(c, i);
        for (int a = 0; a < 3; a++) f[a] = c[a] == 0 ? 1 - r[a] * r[a] : 1 + r[a] * c[a];
        double all = r[0] * c[0] + r[1] * c[1] + r[2] * c[2] - 2;
        for (int a = 0; a < 3; a++) {
            double others = f[(a + 1) % 3] * f[(a + 2) % 3];
            if (i < 8)
                d[3 * i + a] = c[a] * others * (all + f[a]) / 8;
            else
                d[3 * i + a] = (c[a] == 0 ? -2 * r[a] : c[a]) * others / 4;
        }
    }
}

/* dN/dL_k - dN/dL_0 [3 x nodes] at volume coordinates L [4]. */
static void tet_slopes(double *d, int nodes, const double *L)
{
    static const double dL[4][3] = {{-1, -1, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int i = 0; i < 4; i++)
        for (int a = 0; a < 3; a++) d[3 * i + a] = nodes == 4 ? dL[i][a] : (4 * L[i] - 1) * dL[i][a];
    for (int e = 0; nodes == 10 && e < 6; e++) {
        int i = tet_edge[e][0], j = tet_edge[e][1];
        for (int a = 0; a < 3; a++) d[3 * (4 + e) + a] = 4 * (L[i] * dL[j][a] + L[j] * dL[i][a]);
    }
}

static void slopes(double *d, int nodes, int p)
{
    if (nodes == 20) {
        double r[3];
        v3_scale(r, 1 / sqrt(3), corner[p]);
        hex_slopes(d, r);
        return;
    }
    double L[4] = {far, far, far, far};
    L[p] = near;
    tet_slopes(d, nodes, L);
}

/* O = J^-1; returns det J. */
static double inverse(double *O, const double *J)
{
    double c0[3], c1[3], c2[3];
    v3_cross(c0, J + 3, J + 6);
    v3_cross(c1, J + 6, J);
    v3_cross(c2, J, J + 3);
    double det = v3_dot(J, c0);
    for (int a = 0; a < 3; a++) {
        O[3 * a] = c0[a] / det;
        O[1 + 3 * a] = c1[a] / det;
        O[2 + 3 * a] = c2[a] / det;
    }
    return det;
}

double solid_gradient(double *g, int nodes, int p, const double *x, const double *u)
{
    double d[3 * SOLID_MOST], J[9] = {0}, U[9] = {0}, back[9];
    slopes(d, nodes, p);
    for (int i = 0; i < nodes; i++)
        for (int b = 0; b < 3; b++) {
            v3_axpy(J + 3 * b, d[3 * i + b], x + 3 * i);
            v3_axpy(U + 3 * b, d[3 * i + b], u + 3 * i);
        }
    double det = inverse(back, J);
    m3_mulm(g, U, back);
    return det;
}

double solid_weight(int nodes)
{
    return nodes == 20 ? 1 : 1.0 / 24;
}

static void corner_weights(double *w, int nodes, int at)
{
    if (nodes == 4) {
        for (int p = 0; p < 4; p++) w[p] += 0.25;
    } else if (nodes == 10) {
        for (int p = 0; p < 4; p++) w[p] += ((p == at) - far) / (near - far);
    } else
        for (int p = 0; p < 8; p++) {
            double product = 1;
            for (int a = 0; a < 3; a++) product *= (1 + sqrt(3) * corner[p][a] * corner[at][a]) / 2;
            w[p] += product;
        }
}

void solid_weights(double *w, int nodes, int at)
{
    int corners = nodes == 20 ? 8 : 4, points = solid_points(nodes);
    for (int p = 0; p < points; p++) w[p] = 0;
    if (at < corners) {
        corner_weights(w, nodes, at);
        return;
    }
    const int *ends = nodes == 20 ? hex_edge[at - 8] : tet_edge[at - 4];
    corner_weights(w, nodes, ends[0]);
    corner_weights(w, nodes, ends[1]);
    for (int p = 0; p < points; p++) w[p] /= 2;
}
