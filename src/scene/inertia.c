/* inertia.c -- the inertia tensor of a body, and whether any body can have it */
#include "scene/build.h"

/* Half the trace minus the tensor is the integral of x x' dm: it must not be negative, which is the rule that
 * no principal moment exceeds the sum of the other two.  Leading minors, with room for round-off. */
static bool inertia_possible(const double *J)
{
    double half = (J[0] + J[1] + J[2]) / 2, slack = 1e-12 * half;
    double a = half - J[0] + slack, d = half - J[1] + slack, f = half - J[2] + slack, bb = -J[3], c = -J[4], e = -J[5];
    double minor = a * d - bb * bb, minor2 = a * f - c * c, minor3 = d * f - e * e;
    double det = a * (d * f - e * e) - bb * (bb * f - c * e) + c * (bb * e - c * d);
    double tiny = 1e-12 * half * half;
    return a >= 0 && d >= 0 && f >= 0 && minor >= -tiny && minor2 >= -tiny && minor3 >= -tiny && det >= -tiny * half;
}

/* Taken as it is, with a warning. */
static int let_pass(struct builder *b, const struct node *n, const char *what)
{
    diag_warn(b->diags, n, AT_VALUE, "W-inertia", "%s: no body has this inertia, and it is taken as it is", what);
    return 0;
}

int read_inertia(struct builder *b, double *J, const struct node *n, bool check, const char *what)
{
    for (int i = 0; i < 6; i++) J[i] = 0;
    if (b->scene->space == 2) {
        if (read_number(&J[2], n, NULL, &b->reader)) return 1;
        if (J[2] >= 0) return 0;
        if (!check) return let_pass(b, n, what);
        diag_error(b->diags, n, AT_VALUE, "E-range", "%s: inertia %g is negative", what, J[2]);
        return 1;
    }
    int six = n->type == NODE_LIST && n->count == 6;
    if (n->type == NODE_LIST && n->count != 3 && !six) {
        diag_error(b->diags, n, AT_VALUE, "E-count",
                   "%s: expected [xx, yy, zz] or [xx, yy, zz, xy, xz, yz], found %d numbers", what, n->count);
        return 1;
    }
    if (read_vector(J, six ? 6 : 3, n, what, &b->reader)) return 1;
    if (inertia_possible(J)) return 0;
    if (!check) return let_pass(b, n, what);
    diag_error(b->diags, n, AT_VALUE, "E-inertia", "%s: no body has this inertia", what);
    diag_hint(b->diags,
              "no principal moment may be negative or exceed the sum of the other two; 'inertia_check: false' "
              "takes it all the same");
    return 1;
}
