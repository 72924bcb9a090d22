/* response.c -- see response.h */
#include "multirate/response.h"

#include <math.h>
#include <string.h>

#include "engine/motion.h"
#include "la/dense.h"

/* ---- one minor step */

static void take_minor(struct minor *m, int n, int ns, struct arena *life)
{
    double **square[] = {&m->K, &m->C}, **fast[] = {&m->J, &m->S, &m->V, &m->spare};
    *m = (struct minor){.n = n, .ns = ns};
    for (int i = 0; i < 2; i++) *square[i] = TAKE_MATRIX(life, double, n, n);
    for (int i = 0; i < 4; i++) *fast[i] = TAKE_MATRIX(life, double, ns, ns);
    m->swap = TAKE(life, int, ns);
}

void minor_open(struct minor *m, const struct response *p, struct arena *life)
{
    take_minor(m, p->n, p->ns, life);
    m->Mss = p->Mss;
    m->A = p->A;
    m->D = p->D;
}

/* Y [rows x ns] := s X B, B = 1 + A, X with leading dimension ld. */
static void times_B(double *Y, double s, const double *X, const double *A, int rows, int ns, int ld)
{
    for (int j = 0; j < ns; j++)
        for (int i = 0; i < rows; i++) Y[i + j * rows] = s * X[i + j * ld];
    dense_gemm(Y, s, X, A, rows, ns, ns, rows, ld, ns);
}

/* J; inverted where fast coordinates are few. */
int minor_mass(struct minor *m)
{
    int ns = m->ns;
    for (int i = 0; i < ns * ns; i++) m->J[i] = m->S[i] + m->Mss[i];
    int pivot = factor_dense(m->J, m->swap, m->spare, &m->form, ns);
    if (pivot >= 0 || ns > FEW) return pivot;
    zero(m->spare, ns * ns);
    for (int i = 0; i < ns; i++) {
        m->spare[i * (ns + 1)] = 1;
        solve_dense(m->J, m->swap, m->form, m->spare + i * ns, ns);
    }
    return -1;
}

/* J and V (S11). */
int minor_factor(struct minor *m)
{
    int n = m->n, ns = m->ns;
    double h = m->h;
    for (int j = 0; j < ns; j++)
        for (int i = 0; i < ns; i++)
            m->V[i + j * ns] = h * h / 2 * (m->K[i + j * n] + m->D[i + j * ns]) + h * m->C[i + j * n];
    times_B(m->S, .5, m->V, m->A, ns, ns, ns);
    return minor_mass(m);
}

/* ---- what is frozen */

void response_open(struct response *p, const struct decouple *dec, struct arena *life)
{
    int n = dec->n, ns = dec->ns, nl = dec->nl;
    *p = (struct response){.n = n, .ns = ns, .nl = nl, .ml = dec->ml, .life = life};
    double **slow[] = {&p->F, &p->Gk, &p->MLL, &p->G, &p->spare}; /* the last three dense only */
    double **fast[] = {&p->A, &p->D, &p->Mss, &p->WFW};
    double **wide[] = {&p->X, &p->Y, &p->v, &p->dx, &p->dd};
    double **mixed[] = {&p->U, &p->GU, &p->V};
    double **pair[] = {&p->E, &p->T};
    for (int i = 0; i < (dec->structured ? 2 : 5); i++) *slow[i] = TAKE_MATRIX(life, double, nl, nl);
    for (int i = 0; i < 4; i++) *fast[i] = TAKE_MATRIX(life, double, ns, ns);
    for (int i = 0; i < 5; i++) *wide[i] = TAKE_MATRIX(life, double, 2 * ns, ns);
    for (int i = 0; i < 3; i++) *mixed[i] = TAKE_MATRIX(life, double, 2 * ns, nl);
    for (int i = 0; i < 2; i++) *pair[i] = TAKE_MATRIX(life, double, 4 * ns, ns);
    take_minor(&p->one, n, ns, life);
    p->one.Mss = p->Mss;
    p->one.A = p->A;
    p->one.D = p->D;
    p->FW = TAKE_MATRIX(life, double, nl, ns);
    p->Q = TAKE_MATRIX(life, double, p->ml, ns);
    p->d = TAKE(life, double, n);
    p->z = TAKE(life, double, n);
    p->s = TAKE(life, double, 2 * ns);
    p->swapG = TAKE(life, int, nl);
    p->swapT = TAKE(life, int, 2 * ns);
    if (dec->structured) p->GF = arena_take(life, 1, dec->ode->direct->factor_size);
}

static int nonzero(const double *A, int rows, int cols, int ld)
{
    for (int j = 0; j < cols; j++)
        for (int i = 0; i < rows; i++)
            if (A[i + (long)j * ld] != 0) return 1;
    return 0;
}

/* X and Y: the minor steps driven by the unit ramps, then the unit constants. */
static void columns(struct response *p)
{
    const struct minor *m = &p->one;
    int n = p->n, ns = p->ns, cols = 2 * ns;
    double h = p->h, *d = p->dd;
    zero(p->X, ns * cols);
    zero(p->Y, ns * cols);
    zero(p->v, ns * cols);
    for (int k = 0; k < p->ratio; k++) {
        double f = (k + .5) / p->ratio;
        zero(d, ns * cols);
        for (int i = 0; i < ns; i++) {
            d[i + i * ns] = h * f;
            d[i + (ns + i) * ns] = h;
        }
        dense_gemm(d, h, m->K, p->X, ns, ns, cols, ns, n, ns);
        dense_gemm(d, 1, m->V, p->v, ns, ns, cols, ns, ns, ns);
        for (int j = 0; j < cols; j++) minor_solve(m, d + j * ns, ns);
        for (int i = 0; i < ns * cols; i++) p->dx[i] = h * (p->v[i] - d[i] / 2);
        dense_gemm(p->dx, -h / 2, p->A, d, ns, ns, cols, ns, ns, ns);
        for (int i = 0; i < ns * cols; i++) {
            p->Y[i] += p->X[i] + p->dx[i] / 2;
            p->X[i] += p->dx[i];
            p->v[i] -= d[i];
        }
    }
}

/* F W, W' F W. */
static void slow_recoil(struct response *p, const struct decouple *dec)
{
    int ns = p->ns, nl = p->nl;
    zero(p->FW, nl * ns);
    zero(p->WFW, ns * ns);
    if (!p->slow_slopes || !dec->reach) return;
    dense_gemm(p->FW, 1, p->F, dec->W, nl, dec->reach, ns, nl, nl, nl);
    dense_gemtm(p->WFW, 1, dec->W, p->FW, ns, dec->reach, ns, ns, nl, nl);
}

/* G - M_LL. */
static void slow_stiffness(struct response *p)
{
    int n = p->n, ns = p->ns, nl = p->nl, ml = p->ml;
    double H = p->H;
    const double *K = p->one.K + ns + (long)ns * n, *C = p->one.C + ns + (long)ns * n;
    for (int i = 0; i < nl * nl; i++) p->Gk[i] = H * H / 2 * p->F[i];
    for (int j = 0; j < ml; j++)
        for (int i = 0; i < ml; i++) p->Gk[i + j * nl] += H * H / 4 * K[i + (long)j * n] + H / 2 * C[i + (long)j * n];
    p->stiff = nonzero(p->Gk, nl, nl, nl);
    p->diagonal = 1;
    for (int j = 0; j < nl; j++) {
        p->diagonal &= !nonzero(p->Gk + j * nl, j, 1, nl) && !nonzero(p->Gk + j * nl + j + 1, nl - j - 1, 1, nl);
        p->d[ns + j] = p->Gk[j * (nl + 1)];
    }
    for (int i = 0; i < ns; i++) p->d[i] = INFINITY;
}

/* U, V and E. */
static void coupling(struct response *p, const struct decouple *dec)
{
    int n = p->n, ns = p->ns, nl = p->nl, ml = p->ml, cols = 2 * ns;
    const double *KSL = p->one.K + (long)ns * n, *CSL = p->one.C + (long)ns * n;
    columns(p);
    zero(p->U, nl * cols);
    dense_gemm(p->U, p->h, p->one.K + ns, p->Y, ml, ns, cols, nl, n, ns);
    dense_gemm(p->U, 1, p->one.C + ns, p->X, ml, ns, cols, nl, n, ns);
    dense_gemm(p->U, -p->H, p->FW, p->X, nl, ns, cols, nl, nl, ns);
    zero(p->V, nl * cols);
    for (int i = 0; i < ns; i++)
        for (int j = 0; j < ml; j++) {
            p->V[j + i * nl] = p->H / 2 * KSL[i + (long)j * n];
            p->V[j + (ns + i) * nl] = CSL[i + (long)j * n] / 2;
        }
    if (p->slow_slopes) dense_gemtm(p->V + nl * ns, -p->H / 2, p->F, dec->W, nl, dec->reach, ns, nl, nl, nl);
    zero(p->E, cols * cols);
    for (int i = 0; i < cols; i++) p->E[i * (cols + 1)] = 1;
    dense_gemm(p->E + ns, -1, p->WFW, p->X, ns, ns, cols, cols, ns, ns);
}

void response_freeze(struct response *p, const struct decouple *dec)
{
    int n = p->n, ns = p->ns, nl = p->nl, ml = p->ml;
    const struct minor *m = &p->one;
    p->slow_slopes = nonzero(p->F, nl, nl, nl);
    slow_recoil(p, dec);
    slow_stiffness(p);
    p->couples = nonzero(m->K + ns, ml, ns, n) || nonzero(m->K + (long)ns * n, ns, ml, n) ||
                 nonzero(m->C + ns, ml, ns, n) || nonzero(m->C + (long)ns * n, ns, ml, n);
    p->drives = p->couples || nonzero(p->FW, nl, ns, nl);
    if (!p->drives) return;
    coupling(p, dec);
    times_B(p->Q, p->h * p->h / 4, m->K + ns, p->A, ml, ns, n);
    for (int j = 0; j < ns; j++)
        for (int i = 0; i < ml; i++) p->Q[i + j * ml] += p->h / 2 * m->C[ns + i + j * n];
    dense_gemm(p->Q, p->h / 2, m->C + ns, p->A, ml, ns, ns, ml, n, ns);
}

/* ---- what follows the masses */

/* Is A, positive and symmetric, another than B, by so much that the iteration would feel it?  Beside the diagonal. */
static int differs(const double *A, const double *B, int n, int lda, int ldb, double little)
{
    for (int j = 0; j < n; j++)
        for (int i = 0; i <= j; i++) {
            const double a = A[i + (long)j * lda], d = a - B[i + (long)j * ldb];
            if (!(d * d <= little * little * A[i + (long)i * lda] * A[j + (long)j * lda])) return 1;
        }
    return 0;
}

/* M_LL [nl x nl], leading dimension n. */
static const double *slow_mass(const struct response *p, const struct decouple *dec)
{
    return dec->M + p->ns + (long)p->ns * p->n;
}

int response_masses(struct response *p, const struct decouple *dec)
{
    static const double LITTLE = 1e-5; /* what other terms leave of an iteration's corrections is more */
    const int n = p->n, ns = p->ns, nl = p->nl, own = response_factors(p, dec);
    const double little = p->damps ? 0 : LITTLE; /* the damping is of the masses as they are */
    const int changed = dec->structured || response_lacks(p, dec) || differs(dec->Mss, p->Mss, ns, ns, ns, little) ||
                        (own && differs(slow_mass(p, dec), p->MLL, nl, n, nl, little));
    if (changed) copy(p->Mss, dec->Mss, ns * ns);
    return changed;
}

enum status response_need(struct response *p, double t, struct trouble *why)
{
    const int nl = p->nl;
    TRY(matrix_need(&p->G, nl, nl, p->life, t, why));
    TRY(matrix_need(&p->spare, nl, nl, p->life, t, why));
    return matrix_need(&p->MLL, nl, nl, p->life, t, why);
}

bool response_factors(const struct response *p, const struct decouple *dec)
{
    return p->stiff || (!dec->structured && (p->drives || dec->reach == 0));
}

/* x [nl] := G^-1 x. */
static void slow_solve(struct response *p, struct decouple *dec, double *x)
{
    if (!response_factors(p, dec)) {
        decouple_slow(dec, x);
    } else if (!dec->structured) {
        solve_dense(p->G, p->swapG, p->form, x, p->nl);
    } else {
        zero(p->z, p->ns);
        copy(p->z + p->ns, x, p->nl);
        dec->ode->direct->solve(dec->ode, p->GF, p->z);
        copy(x, p->z + p->ns, p->nl);
    }
}

/* G for M_LL as it is now. */
static enum status factor_dense_slow(struct response *p, struct decouple *dec, double t, struct trouble *why)
{
    const int nl = p->nl;
    if (!p->MLL) TRY(response_need(p, t, why));
    dense_copy(p->MLL, slow_mass(p, dec), nl, nl, nl, p->n);
    for (int i = 0; i < nl * nl; i++) p->G[i] = p->Gk[i] + p->MLL[i];
    const int pivot = factor_dense(p->G, p->swapG, p->spare, &p->form, nl);
    p->formed = pivot < 0;
    return pivot < 0 ? OK : trouble_set(why, TROUBLE_SINGULAR, pivot, 0, t);
}

static enum status factor_slow(struct response *p, struct decouple *dec, const double *q, double t, struct trouble *why)
{
    p->formed = 0;
    if (dec->structured && !p->diagonal) return trouble_set(why, TROUBLE_SINGULAR, -1, 0, t);
    if (!response_factors(p, dec)) return OK;
    return dec->structured ? dec->ode->direct->stiffen(dec->ode, p->GF, p->d, q, t, dec->lags ? LIMBS : ALL, why)
                           : factor_dense_slow(p, dec, t, why);
}

/* G, T = E + V G^-1 U (S12), factored. */
enum status response_slow(struct response *p, struct decouple *dec, const double *q, double t, struct trouble *why)
{
    int nl = p->nl, cols = 2 * p->ns;
    TRY(factor_slow(p, dec, q, t, why));
    if (!p->drives) return OK;
    copy(p->GU, p->U, nl * cols);
    for (int j = 0; j < cols; j++) slow_solve(p, dec, p->GU + (long)j * nl);
    copy(p->T, p->E, cols * cols);
    dense_gemtm(p->T, 1, p->V, p->GU, cols, nl, cols, cols, nl, nl);
    int pivot = dense_lu(p->T, p->swapT, cols, cols);
    return pivot < 0 ? OK : trouble_set(why, TROUBLE_SINGULAR, pivot, 0, t);
}

/* ---- answers */

/* What response_run() goes through: the residual, where x and v stand, what has room for one step. */
struct run {
    const double *rest;
    double *x, *v, *s;
    int add;
};

INTO static inline void run(int ns, int terms, const struct response *p, double *restrict d, const struct run *o)
{
    const struct minor *m = &p->one;
    const double *restrict rest = o->rest, h = p->h;
    double *restrict x = o->x, *restrict v = o->v, *restrict s = o->s;
    for (int k = 0; k < p->ratio; k++, d += ns) {
        const double f = (k + .5) / p->ratio;
        for (int i = 0; i < ns; i++) {
            const double linear = rest[i] + f * rest[i + ns];
            s[i] = -(terms > 2 ? linear + f * f * rest[i + 2 * ns] : linear);
        }
        gemv_few(s, -h, m->K, x, ns, ns, p->n);
        gemv_few(s, -1, m->V, v, ns, ns, ns);
        minor_solve(m, s, ns);
        for (int i = 0; i < ns; i++) {
            x[i] += h * (v[i] + s[i] / 2);
            v[i] += s[i];
            d[i] = o->add ? d[i] + s[i] : s[i];
        }
        if (p->damps) dense_gemv(x, h / 2, p->A, s, ns, ns, ns);
    }
}

void response_run(const struct response *p, double *d, const struct powers *rest, double *x, double *v, double *scratch,
                  int add)
{
    const struct run o = {rest->x, x, v, scratch, add};
    if (rest->terms > 2)
        BY_FEW(run, p->ns, 3, p, d, &o);
    else
        BY_FEW(run, p->ns, 2, p, d, &o);
}

void response_correct(struct response *p, struct decouple *dec, double *Du, double *rest, const double *R,
                      const double *dxn)
{
    int ns = p->ns, nl = p->nl, cols = 2 * ns;
    copy(Du, R, nl);
    if (p->slow_slopes) dense_gemv(Du, -p->H, p->FW, dxn, nl, ns, nl);
    slow_solve(p, dec, Du);
    zero(p->s, cols);
    if (p->drives) {
        dense_gemtv(p->s, -1, p->V, Du, nl, cols, nl);
        dense_gemv(p->s + ns, 1, p->WFW, dxn, ns, ns, ns);
        dense_lu_solve(p->T, p->swapT, p->s, cols, cols);
        dense_gemv(Du, 1, p->GU, p->s, nl, cols, nl);
    }
    for (int i = 0; i < nl; i++) Du[i] = -Du[i];
    for (int i = 0; i < ns; i++) {
        rest[i] = p->h * p->s[ns + i];
        rest[ns + i] = p->h * p->s[i];
    }
}
