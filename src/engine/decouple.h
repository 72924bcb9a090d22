/* decouple.h -- slow and fast coordinates without common inertia.
 *
 *     W = M_LL^-1 M_LS,   P = [1 -W; 0 1] (slow first),   v = P (u, v_S)
 *
 * makes P' M^ P = diag(M_LL, M_SS - M_SL W): the fast part sits on its free, recoiling base.  In memory
 * S = [0,ns) comes first. */
#ifndef FMDSUB_ENGINE_DECOUPLE_H
#define FMDSUB_ENGINE_DECOUPLE_H

#include "base/arena.h"

struct decouple {
    int n, ns, nl;
    int coupled; /* W is not zero */
    double *M;   /* [n x n] M^, filled by the caller */
    double *W;   /* [nl x ns] */
    double *Mss; /* [ns x ns] M_SS - M_SL W */
    double *L;   /* [nl x nl] Cholesky factor of M_LL */
};

void decouple_open(struct decouple *p, int n, int ns, struct arena *life);
/* W and Mss from M.  -1, or the coordinate whose M_LL pivot fails. */
int decouple_factor(struct decouple *p);
/* out [n] = P (y, x). */
void decouple_out(const struct decouple *p, double *out, const double *y, const double *x);
/* rs [ns] := the fast rows of P' r. */
void decouple_fast(const struct decouple *p, double *rs, const double *r);
/* K [n x n] := P' K P. */
void decouple_slopes(const struct decouple *p, double *K);

#endif
