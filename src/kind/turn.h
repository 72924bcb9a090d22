/* turn.h -- how one set of axes stands against another, by swing and twist.
 *
 * What takes the axes A to B is a twist psi about the axis z, then a swing by the shortest way from z_a to z_b, with
 * c = z_a x z_b, theta the angle of z_a and z_b, g = theta/sin theta:
 *
 *     psi = atan2(y_a.x_b - x_a.y_b, x_a.x_b + y_a.y_b) and whole turns,     swing vector g c
 *
 * Along axes a_i of A, b_i of B, m_i half a twist and half a swing from either, with W the relative angular velocity,
 *
 *     theta_i = g c.a_i,     theta_i' = W.(g (cos theta a_i - (z_b.a_i) z_a) + g1 (c.a_i) c)
 *     theta_i = g c.b_i,     theta_i' = W.(g (cos theta b_i - (z_a.b_i) z_b) + g1 (c.b_i) c)
 *     theta_i = g c.m_i,     theta_i' = W.(G m_i - G1 (c.m_i) c)
 *     psi' = W.(z_a + z_b)/(1 + cos theta)
 *
 * g1 = (1 - g cos theta)/sin^2 theta, G = (theta/2)/sin(theta/2), G1 = (G - 1)/sin^2 theta.  Only theta = pi is out of
 * reach.
 *
 * Swing and twist: Grassia, J. Graphics Tools 3 (1998) 29.  Axes half-way, so that the order of the bodies does not
 * matter: Masarati & Morandini, Multibody Syst. Dyn. 23 (2010) 361. */
#ifndef FMDSUB_KIND_TURN_H
#define FMDSUB_KIND_TURN_H

/* A and B by column in the world. */
struct turn {
    int x, y, z; /* columns: z that of twist */
    double A[9], B[9];
    double c[3], sine, cosine, theta, g, psi;
};

/* All else from A and B; psi with whole turns, next to `counted`. */
void turn_find(struct turn *o, int z, double counted);

/* The rows above, for an axis e of A, B (`own` is its z axis, `other` the other's) or in the middle, and that of psi. */
void turn_row_along(double *row, const struct turn *o, const double *e, const double *own, const double *other);
void turn_row_amid(double *row, const struct turn *o, const double *e);
void turn_row_twist(double *row, const struct turn *o);

/* Axes E, A or B, swung to the z axis of the other. */
void turn_swing_axes(double *D, const struct turn *o, const double *E, const double *to);

/* The axes M half a twist and half a swing from A. */
void turn_middle(double *M, const struct turn *o);

#endif
