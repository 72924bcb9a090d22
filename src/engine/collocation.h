/* collocation.h -- the Radau IIA methods: collocation at the zeros of
 *
 *     d^(s-1)/dx^(s-1) [x^(s-1) (x - 1)^s],
 *
 * of order 2 s - 1 and L-stable (Ehle 1969; Hairer & Wanner, Solving Ordinary Differential Equations II, IV.5, IV.8).  For
 * odd s the matrix A has one real eigenvalue and pairs of complex ones. */
#ifndef FMDSUB_ENGINE_COLLOCATION_H
#define FMDSUB_ENGINE_COLLOCATION_H

enum { COLLOCATION_STAGES = 5, COLLOCATION_MODES = (COLLOCATION_STAGES + 1) / 2 };

/* A right eigenvector t, A t = lambda t, and the row l of T^-1 that belongs to it: x = t (l . x) + ..., of a pair of
 * complex ones 2 Re(t (l . x)). */
struct collocation_mode {
    double re, im; /* lambda; im = 0: the real one */
    double tre[COLLOCATION_STAGES], tim[COLLOCATION_STAGES];
    double lre[COLLOCATION_STAGES], lim[COLLOCATION_STAGES];
};

struct collocation {
    int s;
    double c[COLLOCATION_STAGES];
    double A[COLLOCATION_STAGES][COLLOCATION_STAGES];
    double b[COLLOCATION_STAGES]; /* last row of A */
    int nmode;
    struct collocation_mode mode[COLLOCATION_MODES]; /* the real one first */
    /* Of the error: y1^ - y1 = h (lambda f(y0) + sum d_i f(Y_i)), lambda the real eigenvalue; of order s (IV.8, (8.18)). */
    double d[COLLOCATION_STAGES];
    /* Where the product of x and all x - c_j is largest, and over that its largest integral: h share times what the polynomial
     * through f at 0 and at the points is off by there is, to leading order, the most that its integral is off by. */
    double widest, share;
};

/* s: 3 or 5. */
void collocation_radau(struct collocation *o, int s);

/* w [s + 1]: w_0 f(0) + sum w_j f(c_(j-1)) is the integral to x of the polynomial through f at 0 and at the points.  To 1 it is
 * that of the method, w_0 = 0; on the way it is of order s + 1, without f(0) of order s. */
void collocation_along(const struct collocation *o, double *w, double x);

/* w [s + 1]: w_0 f(0) + sum w_j f(c_(j-1)) is that polynomial itself, at x. */
void collocation_slope(const struct collocation *o, double *w, double x);

/* w [s]: sum w_j f(c_j) is the polynomial through f at the s points c, at x. */
void collocation_through(const struct collocation *o, double *w, double x);

#endif
