/* cone.h -- impulses of contacts that push, and rub within a cone.
 *
 * With rates u = u0 + W p along the rows of all contacts, find p such that of each
 *
 *     0 <= u_n,  p_n >= 0,  one of them 0;
 *     u_t = 0 where |p_t| < mu p_n, else p_t = -mu p_n u_t / |u_t|;
 *
 * by projected Gauss-Seidel, contact by contact (Moreau; Jean, Comput. Methods Appl. Mech. Eng. 177 (1999) 235), and where
 * that is slow by Newton's method.  W may be
 * singular: then the rates are unique and the impulses one choice of many.  A normal row whose W is 0 keeps its p_n, which is
 * given; a row across whose W is 0 slides as u0 has it. */
#ifndef FMDSUB_ENGINE_CONE_H
#define FMDSUB_ENGINE_CONE_H

#include <stdbool.h>

#include "base/arena.h"

struct cone {
    int row;         /* its first row, the normal one */
    int across;      /* rows behind it: 0, 1 or 2 */
    double mu;       /* of its friction */
    double preload;  /* impulse of friction that no push makes */
    bool held;       /* all its rates, where it slides the normal one, are to be 0, whatever that takes */
    bool sticks;     /* friction has no bound */
    bool slides;     /* it slides along slide [across], unit: p_t = -mu p_n slide */
    double slide[2]; /* */
};

struct cone_work {
    double *A; /* [rows x rows] */
    double *u, *r, *dp, *from, *centre, *kept;
    double off;
    bool slopes;
    int *swap;
};
void cone_open(struct cone_work *o, int rows, struct arena *life);

/* p [rows]: from where they are; W [rows x rows] by column.  size: of rates, for what is 0; rough: round-off of u0, to which
 * rows of more points than hold a body contradict each other.  false: they do not settle. */
bool cone_solve(double *p, const double *W, const double *u0, const struct cone *cone, int n, int rows, double size,
                double rough, struct cone_work *work);

#endif
