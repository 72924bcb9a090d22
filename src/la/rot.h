/* rot.h -- rotations: matrices, unit quaternions, the Cayley map, rotation vectors.
 *
 * A matrix R [9] by column and a quaternion q = (w, x, y, z) take body axes to world axes; -q is the
 * same rotation as q.  A body turning with angular velocity w in its own axes obeys
 *
 *     R' = R [w]x,     q' = q * (0, w)/2.
 *
 * The Cayley map takes a vector phi to the rotation about phi by the angle 2 atan(|phi|/2):
 *
 *     cay(phi) = (I - [phi]x/2)^-1 (I + [phi]x/2),     quaternion (1, phi/2) / sqrt(1 + |phi|^2/4).
 *
 * Rotations of half a turn and more are out of its reach.  Sources: Bottasso & Borri 1998 (Cayley),
 * Shepperd 1978 (quaternion of a matrix), Bortz 1971 (rate of the rotation vector). */
#ifndef FMDSUB_LA_ROT_H
#define FMDSUB_LA_ROT_H

/* ---- quaternions ---- */

/* o = a * b; o may be a or b. */
void quat_mul(double *o, const double *a, const double *b);
void quat_matrix(double *R, const double *q);
/* Unit quaternion with w >= 0. */
void quat_of_matrix(double *q, const double *R);

/* ---- increments, body axes ---- */

/* q = cay(phi). */
void quat_cay(double *q, const double *phi);
/* q1 = q0 * (the fraction s of cay(phi), about the same axis), normalised; q1 may be q0. */
void quat_move(double *q1, const double *q0, const double *phi, double s);
/* phi with q1 = +-q0 cay(phi); infinite at half a turn. */
void quat_diff(double *phi, const double *q1, const double *q0);
/* The rate of phi where R = R0 cay(phi) turns with w in body axes:
 * phi' = (I + [phi]x/2 + phi phi'/4) w. */
void cay_rate(double *rate, const double *phi, const double *w);

/* ---- rotation vectors: axis times angle, angle in [0, pi] ---- */

void matrix_of_vector(double *R, const double *phi);
void vector_of_quat(double *phi, const double *q);
void vector_of_matrix(double *phi, const double *R);
/* T [9]: phi' = T w, w in the axes of the turning body; |phi| < 2 pi.  In base axes it is T'. */
void vector_rate(double *T, const double *phi);

/* ---- one angle ---- */

/* x and whole turns, nearest to `to` [rad]. */
double angle_near(double x, double to);

/* ---- three angles ----
 *
 * The last is taken first and the others from what it leaves, so that the three always make up R.  Where the axes of
 * first and last fall together (sin or cos of the middle one is 0), R tells one turn only: the last is then 0, near
 * there what round-off makes of it, and the first is all the rest. */

/* Tait-Bryan, z-y'-x'': R = Rz(yaw) Ry(pitch) Rx(roll); pitch in [-pi/2, pi/2], yaw and roll in [-pi, pi]. */
void tait_bryan_of_matrix(double *yaw_pitch_roll, const double *R);
/* Euler, z-x'-z'': R = Rz(e1) Rx(e2) Rz(e3); e2 in [0, pi], e1 and e3 in [-pi, pi]. */
void euler_of_matrix(double *e, const double *R);

/* ---- orientation from axes ---- */

/* R with column i along u and column j (not i) in the half plane of u and v, towards v.  0: u is zero or v
 * is parallel to it (to 1e-9); R is then untouched. */
int matrix_of_axes(double *R, int i, const double *u, int j, const double *v);

#endif
