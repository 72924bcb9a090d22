/* response.h -- how the minor steps of a major one answer to its slow unknowns, linearized.
 *
 * In the variables of the step, q = q0 + P (y, x) with P = [1 -W; 0 1], slow first, a change of the slow
 * unknown du (w = u0 + du/2, y_k = k h w) and of the slow bodies' displacement e = H w - W x_n changes the
 * minor steps by dd_k:
 *
 *     J dd_k = - { h (f_k p + c) + h K_SS x + V v },   p = (H/2) K_SL du,   c = C_SL du/2 - W' F e
 *     x += h (v + B dd_k / 2),   v += dd_k,   f_k = (k + 1/2)/n
 *     J = M_SS + (h^2/4) (K_SS + D) B + (h/2) C_SS B,    V = (h^2/2) (K_SS + D) + h C_SS                    (S11)
 *
 * K, C: slopes of the fast class as P' K P; M_SS = P' M^ P; D = K_SS A and B = 1 + A of the damping of
 * high frequencies.  The slow class stands once, at the average of the ends: its rows change by F e,
 * F = K_s / 2 + C_s / H, in all minor steps alike.  Then the slow rows, summed over the step, change by
 *
 *     { M_LL + (H^2/4) K_LL + (H/2) C_LL } du + H F e + h K_LS sum (x + dx_k/2) + C_LS x_n.
 *
 * The minor steps answer to a ramp p and a constant c alone: x_n = X s, the sum of midpoints is Y s,
 * s = (p, c).  With e = rho + (H/2) du - W x_n, rho = -W dx_n what the minor steps moved it by on their own,
 *
 *     G du + U s = -(R + H F rho)
 *     E s = V du - (0, W' F rho)                                                                            (S12)
 *
 *     G = M_LL + (H^2/4) K_LL + (H/2) C_LL + (H^2/2) F,   U = h K_LS Y + (C_LS - H F W) X,
 *     E = 1 - (0, W' F W X),                              V = ((H/2) K_SL, C_SL/2 - (H/2) W' F),
 *
 * a system of 2 ns equations (E + V G^-1 U) s = ..., and G as structured as M_LL where slow stiffness and
 * damping are along coordinates. */
#ifndef FMDSUB_MULTIRATE_RESPONSE_H
#define FMDSUB_MULTIRATE_RESPONSE_H

#include "base/arena.h"
#include "base/status.h"
#include "engine/matrix.h"
#include "multirate/decouple.h"

/* One minor step's matrix. */
struct minor {
    int n, ns;
    double h;
    double *K, *C;             /* [n x n] transformed slopes of the fast class */
    const double *Mss, *A, *D; /* [ns x ns] */
    double *J, *S, *V, *spare; /* [ns x ns]; S = J - M_SS */
    int *swap;
    enum matrix_form form;
};

struct response {
    struct minor one;
    struct arena *life;
    int n, ns, nl, ml, ratio; /* ml: slow coordinates that the fast class knows */
    double h, H;
    double *A, *D;       /* [ns x ns] */
    double *Mss;         /* [ns x ns] as in J */
    double *MLL;         /* [nl x nl] as in G; dense only: it, G and spare are taken when they first serve */
    double *F;           /* [nl x nl] */
    double *FW;          /* [nl x ns] */
    double *WFW;         /* [ns x ns] */
    double *Gk;          /* [nl x nl] G - M_LL */
    double *d;           /* [n] its diagonal; infinite in S */
    int damps;           /* A and D are not zero */
    int slow_slopes;     /* F is not zero */
    int stiff;           /* G differs from M_LL */
    int diagonal;        /* G - M_LL is diagonal */
    int couples;         /* springs or dampers of the fast class couple fast and slow rows */
    int drives;          /* U or V is not zero: `couples`, or fast coordinates move bodies that slow springs hold */
    double *G;           /* [nl x nl] factored; dense only */
    int formed;          /* it is so, for MLL */
    void *GF;            /* the owner's factor of G */
    double *Q;           /* [ml x ns] d(slow rows)/d(d_k) of one minor step: ((h^2/4) K_LS + (h/2) C_LS) B */
    double *X, *Y;       /* [ns x 2 ns] */
    double *U, *GU;      /* [nl x 2 ns] U, G^-1 U */
    double *V;           /* [nl x 2 ns] transposed */
    double *E, *T;       /* [2 ns x 2 ns]; T = E + V G^-1 U, factored */
    double *v, *dx, *dd; /* [ns x 2 ns] scratch */
    double *z, *s;       /* [n], [2 ns] scratch */
    double *spare;       /* [nl x nl] */
    int *swapG, *swapT;
    enum matrix_form form; /* of G */
};

/* Takes memory for what only the dense way reads.  E_LIMIT: there is none. */
enum status response_need(struct response *p, double t, struct trouble *why);

/* The frozen matrices, and the masses that they are for: base/recall.h. */
void response_recall(struct response *p, const struct decouple *dec, struct recall *r);

/* A and D are p's. */
void response_open(struct response *p, const struct decouple *dec, struct arena *life);
/* Another matrix of a minor step, with its own slopes, for the same masses and damping. */
void minor_open(struct minor *m, const struct response *p, struct arena *life);

/* J and V from K, C (S11); J again for another M_SS.  Return -1, or the column in which J has no pivot. */
int minor_factor(struct minor *m);
int minor_mass(struct minor *m);
/* x [ns] := J^-1 x; ns is m's. */
INTO static inline void minor_solve(const struct minor *m, double *x, int ns)
{
    double b[FEW];
    if (ns > FEW) {
        solve_dense(m->J, m->swap, m->form, x, ns);
        return;
    }
    for (int i = 0; i < ns; i++) b[i] = x[i], x[i] = 0;
    gemv_few(x, 1, m->spare, b, ns, ns, ns);
}

/* Everything that does not depend on M_LL, from K, C (transformed) and F; after minor_factor. */
void response_freeze(struct response *p, const struct decouple *dec);
/* Copies the masses of dec, if they have changed so that an iteration feels it (damping: at all): returns whether they have. */
int response_masses(struct response *p, const struct decouple *dec);
/* Is G factored by itself?  Else it is M_LL as dec has factored it. */
bool response_factors(const struct response *p, const struct decouple *dec);
/* So it is, and has not been yet: W has become zero. */
static inline bool response_lacks(const struct response *p, const struct decouple *dec)
{
    return !dec->structured && response_factors(p, dec) && !p->formed;
}
/* G and what follows from it; q, t: where dec stands.  E_NUMERIC with TROUBLE_SINGULAR when the owner's
 * structure does not allow it: dec has to go dense. */
enum status response_slow(struct response *p, struct decouple *dec, const double *q, double t, struct trouble *why);

/* A residual of the fast rows, sum of x_m f_k^m. */
struct powers {
    const double *x; /* [ns x terms] */
    int terms;       /* 2 or 3 */
};

/* d_k [ns x ratio] := the linear answer of the minor steps to this residual, from displacements x and velocities v [ns] at the
 * start (overwritten).  add: it is added to d_k. */
void response_run(const struct response *p, double *d, const struct powers *rest, double *x, double *v, double *scratch,
                  int add);

/* Du [nl] := the correction of the slow unknown for slow rows R [nl] and a change dxn [ns] of x_n (S12); rest [ns x 2]:
 * its effect on the fast rows, constant and linear in f_k, for response_run(). */
void response_correct(struct response *p, struct decouple *dec, double *Du, double *rest, const double *R,
                      const double *dxn);

#endif
