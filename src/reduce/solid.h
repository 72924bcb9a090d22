/* solid.h -- strains in solid elements: tetrahedra of 4 and 10 nodes, hexahedra of 20. */
#ifndef FMDSUB_REDUCE_SOLID_H
#define FMDSUB_REDUCE_SOLID_H

#include <stdbool.h>

enum { SOLID_MOST = 20, SOLID_POINTS = 8 };

bool solid_known(int nodes);
/* Integration points, as many as corners (4, 8); of 4 nodes all are alike. */
int solid_points(int nodes);

/* g [9] = du_a/dx_b, by column b, at integration point p; x, u [3 x nodes].  Returns the Jacobian's determinant. */
double solid_gradient(double *g, int nodes, int p, const double *x, const double *u);

/* What a point counts in an integral over the element, times the determinant. */
double solid_weight(int nodes);

/* w [points]: a field that is linear between the integration points has at local node `at` the value sum w_p f_p. */
void solid_weights(double *w, int nodes, int at);

#endif
