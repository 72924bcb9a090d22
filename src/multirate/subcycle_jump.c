/* subcycle_jump.c -- how the force phi on the fast coordinates (forecast.h) jumps from one major step to the next.
 *
 * The fast rows are P' r, where P, du/n and r_s are those of the major step, and x begins at zero with it: all of
 * these change at once.  Had the last minor steps, of accelerations a_k and slow rows r_k,L of the fast bodies, been
 * in the present major step, their phi would have been more by
 *
 *     J_k = (share_last - share)/h - (M_s W)' (du - du_last)/(n h) - K_SS x_n,last - K_SL H w_last + B_k,
 *     B_k = dW' r_k,L + (M_s W)' dW a_k + dM_SS a_k,   dW = W - W_last,  dM_SS = M_SS - M_SS,last,
 *     share = -W' r_s/n - W' M_s W sum d/n
 *
 * which takes no evaluation.  The differences of phi jump by those of B_k. */
#include "la/dense.h"
#include "multirate/subcycle_parts.h"

void subcycle_last_open(struct subcycle *c, struct arena *life)
{
    struct last_step *o = &c->last;
    o->W = TAKE_MATRIX(life, double, c->nl, c->ns);
    o->Mss = TAKE_MATRIX(life, double, c->ns, c->ns);
    o->share = TAKE(life, double, c->ns);
    o->x = TAKE(life, double, c->ns);
    o->y = TAKE(life, double, c->nl);
    o->a = TAKE_MATRIX(life, double, c->ns, JUMP_TERMS);
    o->rows = TAKE_MATRIX(life, double, c->dec.ml, JUMP_TERMS);
    o->jump = TAKE_MATRIX(life, double, c->ns, JUMP_TERMS);
}

/* The part of the slow bodies in the fast rows that does not depend on d_k. */
static void share_of(const struct subcycle *c, double *share)
{
    copy(share, c->cs, c->ns);
    if (c->dec.reach) gemv_few(share, -1, c->dec.WMW, c->dmean, c->ns, c->ns, c->ns);
}

void subcycle_last_keep(struct subcycle *c)
{
    struct last_step *o = &c->last;
    const int ns = c->ns, ml = c->dec.ml;
    copy(o->W, c->dec.W, c->nl * ns);
    copy(o->Mss, c->dec.Mss, ns * ns);
    copy(o->x, c->xn, ns);
    for (int i = 0; i < c->nl; i++) o->y[i] = c->H * c->w[i];
    o->terms = c->ratio < JUMP_TERMS ? c->ratio : JUMP_TERMS;
    for (int m = 0; m < o->terms; m++) {
        const long k = c->ratio - 1 - m;
        for (int i = 0; i < ns; i++) o->a[i + m * ns] = c->d[i + k * ns] / c->h;
        copy(o->rows + m * ml, c->coarse.rows + k * ml, ml);
    }
    share_of(c, o->share);
    o->h = c->h;
}

/* jump [ns] -= (M_s W)' (du - du_last)/(n h). */
INTO static inline void slow_jump(int ns, const struct subcycle *c, double *restrict jump, const double *restrict MsW,
                                  const double *restrict du, const double *restrict last)
{
    const int ml = c->dec.ml;
    const double per = 1 / c->h;
    for (int j = 0; j < ml; j++) {
        const double s = per * (du[j] / c->ratio - c->h * last[j]);
        for (int i = 0; i < ns; i++) jump[i] -= MsW[j + (long)i * ml] * s;
    }
}

/* J_k without B_k. */
static void constant_jump(struct subcycle *c, double *jump)
{
    const struct last_step *o = &c->last;
    const int ns = c->ns, ml = c->dec.ml;
    const double *K = c->resp.one.K, per = 1 / c->h;
    share_of(c, jump);
    for (int i = 0; i < ns; i++) jump[i] = per * (o->share[i] - jump[i]);
    if (c->dec.reach) BY_FEW(slow_jump, ns, c, jump, c->dec.MsW, c->du, c->forecast.ay);
    gemv_few(jump, -1, K, o->x, ns, ns, c->n);
    if (c->resp.drives) dense_gemv(jump, -1, K + (long)ns * c->n, o->y, ns, ml, c->n);
}

/* b [ns] := B_k of the minor step before the last one by m. */
INTO static inline void moving_jump(int ns, const struct subcycle *c, double *restrict b, const double *restrict a,
                                    const double *restrict rows)
{
    const struct last_step *o = &c->last;
    const double *W = c->dec.W, *was = o->W, *MsW = c->dec.MsW, *Mss = c->dec.Mss;
    const int nl = c->nl, ml = c->dec.ml;
    for (int i = 0; i < ns; i++) b[i] = 0;
    for (int j = 0; j < ml && c->dec.reach; j++, W++, was++, MsW++) {
        double s = 0;
        for (int i = 0; i < ns; i++) s += (W[(long)i * nl] - was[(long)i * nl]) * a[i];
        for (int i = 0; i < ns; i++) b[i] += (W[(long)i * nl] - was[(long)i * nl]) * rows[j] + MsW[(long)i * ml] * s;
    }
    for (int j = 0; j < ns; j++)
        for (int i = 0; i < ns; i++) b[i] += (Mss[i + j * ns] - o->Mss[i + j * ns]) * a[j];
}

static void moving_jumps(struct subcycle *c, double *B)
{
    const struct last_step *o = &c->last;
    const int ns = c->ns;
    for (int m = 0; m < o->terms; m++) BY_FEW(moving_jump, ns, c, B + m * ns, o->a + m * ns, o->rows + m * c->dec.ml);
}

const double *subcycle_jump(struct subcycle *c)
{
    const struct last_step *o = &c->last;
    const int ns = c->ns;
    double *B = o->jump, *first = B + ns, *second = B + 2 * ns;
    if (o->h != c->h || c->forecast.differences == 0) return NULL;
    moving_jumps(c, B);
    for (int i = 0; i < ns; i++) {
        second[i] = o->terms > 2 ? B[i] - 2 * first[i] + second[i] : 0;
        first[i] = o->terms > 1 ? B[i] - first[i] : 0;
    }
    constant_jump(c, c->s1);
    for (int i = 0; i < ns; i++) B[i] += c->s1[i];
    return B;
}

void subcycle_last_recall(struct subcycle *c, struct recall *r)
{
    struct last_step *o = &c->last;
    recall_within(r, "last");
    recall_one(r, "h", o->h);
    recall_list(r, "W", o->W, c->nl * c->ns);
    recall_list(r, "Mss", o->Mss, c->ns * c->ns);
    recall_list(r, "share", o->share, c->ns);
    recall_list(r, "x", o->x, c->ns);
    recall_list(r, "y", o->y, c->nl);
    recall_one(r, "terms", o->terms);
    recall_list(r, "a", o->a, c->ns * JUMP_TERMS);
    recall_list(r, "rows", o->rows, c->dec.ml * JUMP_TERMS);
    recall_without(r);
}
