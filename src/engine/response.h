/* response.h -- how the minor steps of a major one answer to its slow unknowns, linearized.
 *
 * In the variables of the step, q = q0 + P (y, x) with P = [I -W; 0 I], slow first, a change of the
 * slow unknown du (w = u0 + du/2, y_k = k h w) and of the slow bodies' displacement e = H w - W x_n
 * changes the minor steps by dd_k:
 *
 *     J dd_k = - { h f_k (H/2) K_SL du + (h/2) C_SL du - h W' F e + h K_SS x + V v }
 *     x += h (v + B dd_k / 2),   v += dd_k,   f_k = (k + 1/2)/n
 *     J = M_SS + (h^2/4) (K_SS + D) B + (h/2) C_SS B,    V = (h^2/2) (K_SS + D) + h C_SS
 *
 * K, C: slopes of the fast class as P' K P; M_SS = P' M^ P; D = K_SS A and B = 1 + A of the damping of
 * high frequencies.  The slow class stands once, at the average of the ends: its rows change by F e,
 * F = K_s / 2 + C_s / H, in all minor steps alike.  Then the slow rows, summed over the step, change by
 *
 *     G_u du + G_e e = [ M_LL + (H^2/4) K_LL + (H/2) C_LL ] du + H F e
 *                    + h K_LS sum (x + dx_k/2) + C_LS x_n
 *
 * and e itself is e = rho + (H/2) du - W x_n, rho what the minor steps moved it by on their own; x_n is
 * linear in du and e, so  e = N (rho + T' du),  N = (1 + W X_e)^-1,  T' = H/2 - W X_u. */
#ifndef FMDSUB_ENGINE_RESPONSE_H
#define FMDSUB_ENGINE_RESPONSE_H

#include "base/arena.h"
#include "base/status.h"
#include "engine/matrix.h"

struct response {
    int n, ns, nl, ratio;
    double h, H;
    int slow_slopes;            /* F is not zero */
    double *M, *K, *C;          /* [n x n] transformed: M^ whole, K and C of the fast class; S first */
    double *F;                  /* [nl x nl] */
    double *WF;                 /* [ns x nl] W' F */
    double *A, *D;              /* [ns x ns] */
    double *J, *S, *V, *spare;  /* [ns x ns]; S = J - M_SS */
    double *Q;                  /* [nl x ns] d(slow rows)/d(d_k) of one minor step: ((h^2/4) K_LS + (h/2) C_LS) B */
    double *G;                  /* [nl x nl] slow rows by du, e eliminated; factored */
    double *Grest;              /* [nl x nl] G - M_LL */
    double *Ge;                 /* [nl x nl] G_e N */
    double *N;                  /* [nl x nl] 1 + W X_e, factored */
    double *T;                  /* [nl x nl] N T' */
    double *x, *v, *dx, *d, *X; /* [ns x 2 nl] scratch of the recursion; X: sum of midpoints */
    int *swapJ, *swapG, *swapN;
    enum matrix_form form; /* of J */
};

void response_open(struct response *p, int n, int ns, struct arena *life);

/* J and V of K, C [n x n] given in p; W only through them.  -1, or the column without a pivot. */
int response_factor(struct response *p);
/* Everything else: call after response_factor.  W [nl x ns].  -1, or a column without a pivot. */
int response_slow(struct response *p, const double *W);

/* J and G for the masses as they are now, Mss [ns x ns] and M_LL in M [n x n]; all else stays as it was
 * frozen.  -1, or a column without a pivot. */
int response_masses(struct response *p, int *factored, const double *Mss, const double *M);

/* d_k [ns x ratio] := (add: +=) the answer to constant part c [ns] and linear part g [ns] (times f_k) of
 * the fast rows, from offsets x, v [ns] (overwritten). */
void response_run(const struct response *p, double *d, const double *c, const double *g, double *x, double *v,
                  double *scratch, int add);

/* x := J^-1 x. */
void response_solve(const struct response *p, double *x);

/* Du, De [nl]: corrections of the slow unknowns for slow rows R [nl] and rho [nl]. */
void response_slow_solve(const struct response *p, double *Du, double *De, const double *R, const double *rho);

#endif
