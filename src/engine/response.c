/* response.c -- see response.h */
#include "engine/response.h"

#include <string.h>

#include "engine/motion.h"
#include "la/dense.h"

void response_open(struct response *p, int n, int ns, struct arena *life)
{
    int nl = n - ns;
    *p = (struct response){.n = n, .ns = ns, .nl = nl};
    double **square[] = {&p->M, &p->K, &p->C};
    double **slow[] = {&p->F, &p->G, &p->Grest, &p->Ge, &p->N, &p->T};
    double **fast[] = {&p->A, &p->D, &p->J, &p->S, &p->V, &p->spare};
    double **mixed[] = {&p->x, &p->v, &p->dx, &p->d, &p->X};
    for (int i = 0; i < 3; i++) *square[i] = TAKE(life, double, n *n);
    for (int i = 0; i < 6; i++) *slow[i] = TAKE(life, double, nl *nl);
    for (int i = 0; i < 6; i++) *fast[i] = TAKE(life, double, ns *ns);
    for (int i = 0; i < 5; i++) *mixed[i] = TAKE(life, double, 2 * ns * nl);
    p->WF = TAKE(life, double, ns *nl);
    p->Q = TAKE(life, double, nl *ns);
    p->swapJ = TAKE(life, int, ns);
    p->swapG = TAKE(life, int, nl);
    p->swapN = TAKE(life, int, nl);
}

/* Y [rows x ns] := s X B, B = 1 + A, X with leading dimension ld. */
static void times_B(const struct response *p, double *Y, double s, const double *X, int rows, int ld)
{
    for (int j = 0; j < p->ns; j++)
        for (int i = 0; i < rows; i++) Y[i + j * rows] = s * X[i + j * ld];
    dense_gemm(Y, s, X, p->A, rows, p->ns, p->ns, rows, ld, p->ns);
}

static int factor_J(struct response *p)
{
    int n = p->n, ns = p->ns;
    for (int j = 0; j < ns; j++)
        for (int i = 0; i < ns; i++) p->J[i + j * ns] = p->S[i + j * ns] + p->M[i + j * n];
    return factor_dense(p->J, p->swapJ, p->spare, &p->form, ns);
}

int response_factor(struct response *p)
{
    int n = p->n, ns = p->ns;
    double h = p->h;
    for (int j = 0; j < ns; j++)
        for (int i = 0; i < ns; i++)
            p->V[i + j * ns] = h * h / 2 * (p->K[i + j * n] + p->D[i + j * ns]) + h * p->C[i + j * n];
    times_B(p, p->S, .5, p->V, ns, ns);
    return factor_J(p);
}

void response_solve(const struct response *p, double *x)
{
    solve_dense(p->J, p->swapJ, p->form, x, p->ns);
}

/* One minor step of all columns: d for the driving c + f g held in p->d on entry. */
static void answer(struct response *p, int cols)
{
    int n = p->n, ns = p->ns;
    double h = p->h;
    dense_gemm(p->d, h, p->K, p->x, ns, ns, cols, ns, n, ns);
    dense_gemm(p->d, 1, p->V, p->v, ns, ns, cols, ns, ns, ns);
    for (int j = 0; j < cols; j++) response_solve(p, p->d + j * ns);
    for (int i = 0; i < ns * cols; i++) {
        p->d[i] = -p->d[i];
        p->dx[i] = h * (p->v[i] + p->d[i] / 2);
    }
    dense_gemm(p->dx, h / 2, p->A, p->d, ns, ns, cols, ns, ns, ns);
    for (int i = 0; i < ns * cols; i++) {
        p->X[i] += p->x[i] + p->dx[i] / 2;
        p->x[i] += p->dx[i];
        p->v[i] += p->d[i];
    }
}

/* x_n by (du, e) in p->x, the sums of the midpoints in p->X: columns of du first. */
static void columns(struct response *p)
{
    int n = p->n, ns = p->ns, nl = p->nl, cols = p->slow_slopes ? 2 * nl : nl;
    double h = p->h;
    const double *KSL = p->K + ns * n, *CSL = p->C + ns * n;
    zero(p->x, ns * cols);
    zero(p->v, ns * cols);
    zero(p->X, ns * cols);
    for (int k = 0; k < p->ratio; k++) {
        double f = (k + .5) / p->ratio;
        for (int j = 0; j < nl; j++)
            for (int i = 0; i < ns; i++) {
                p->d[i + j * ns] = h * f * p->H / 2 * KSL[i + j * n] + h / 2 * CSL[i + j * n];
                if (p->slow_slopes) p->d[i + (nl + j) * ns] = -h * p->WF[i + j * ns];
            }
        answer(p, cols);
    }
}

/* G_u into G, and G_e. */
static void slow_rows(struct response *p)
{
    int n = p->n, ns = p->ns, nl = p->nl;
    double H = p->H;
    const double *KLS = p->K + ns, *CLS = p->C + ns;
    for (int j = 0; j < nl; j++)
        for (int i = 0; i < nl; i++) {
            long at = (ns + i) + (long)(ns + j) * n;
            p->G[i + j * nl] = p->M[at] + H * H / 4 * p->K[at] + H / 2 * p->C[at];
            p->Ge[i + j * nl] = H * p->F[i + j * nl];
        }
    dense_gemm(p->G, p->h, KLS, p->X, nl, ns, nl, nl, n, ns);
    dense_gemm(p->G, 1, CLS, p->x, nl, ns, nl, nl, n, ns);
    if (!p->slow_slopes) return;
    dense_gemm(p->Ge, p->h, KLS, p->X + ns * nl, nl, ns, nl, nl, n, ns);
    dense_gemm(p->Ge, 1, CLS, p->x + ns * nl, nl, ns, nl, nl, n, ns);
}

/* e eliminated: N, T, and G = G_u + G_e T. */
static int eliminate(struct response *p, const double *W)
{
    int ns = p->ns, nl = p->nl;
    zero(p->N, nl * nl);
    zero(p->T, nl * nl);
    for (int i = 0; i < nl; i++) {
        p->N[i * (nl + 1)] = 1;
        p->T[i * (nl + 1)] = p->H / 2;
    }
    dense_gemm(p->T, -1, W, p->x, nl, ns, nl, nl, nl, ns);
    if (p->slow_slopes) dense_gemm(p->N, 1, W, p->x + ns * nl, nl, ns, nl, nl, nl, ns);
    int pivot = dense_lu(p->N, p->swapN, nl, nl);
    if (pivot >= 0) return pivot;
    dense_lu_solves(p->N, p->swapN, p->T, nl, nl, nl, nl);
    if (p->slow_slopes) dense_gemm(p->G, 1, p->Ge, p->T, nl, nl, nl, nl, nl, nl);
    for (int j = 0; j < nl; j++)
        for (int i = 0; i < nl; i++) p->Grest[i + j * nl] = p->G[i + j * nl] - p->M[(ns + i) + (long)(ns + j) * p->n];
    return dense_lu(p->G, p->swapG, nl, nl);
}

int response_slow(struct response *p, const double *W)
{
    int n = p->n, ns = p->ns, nl = p->nl;
    zero(p->WF, ns * nl);
    p->slow_slopes = 0;
    for (int i = 0; i < nl * nl; i++) p->slow_slopes |= p->F[i] != 0;
    if (p->slow_slopes) dense_gemtm(p->WF, 1, W, p->F, ns, nl, nl, ns, nl, nl);
    columns(p);
    slow_rows(p);
    times_B(p, p->Q, p->h * p->h / 4, p->K + ns, nl, n);
    for (int j = 0; j < ns; j++)
        for (int i = 0; i < nl; i++) p->Q[i + j * nl] += p->h / 2 * p->C[ns + i + j * n];
    dense_gemm(p->Q, p->h / 2, p->C + ns, p->A, nl, ns, ns, nl, n, ns);
    return eliminate(p, W);
}

static int differs(const double *A, const double *B, int rows, int cols, int lda, int ldb)
{
    for (int j = 0; j < cols; j++)
        if (memcmp(A + (long)j * lda, B + (long)j * ldb, (size_t)rows * sizeof *A)) return 1;
    return 0;
}

int response_masses(struct response *p, int *factored, const double *Mss, const double *M)
{
    int n = p->n, ns = p->ns, nl = p->nl;
    const double *MLL = M + ns + ns * n;
    *factored = differs(Mss, p->M, ns, ns, ns, n) || differs(MLL, p->M + ns + ns * n, nl, nl, n, n);
    if (!*factored) return -1;
    dense_copy(p->M, Mss, ns, ns, n, ns);
    dense_copy(p->M + ns + ns * n, MLL, nl, nl, n, n);
    int pivot = factor_J(p);
    if (pivot >= 0) return pivot;
    for (int j = 0; j < nl; j++)
        for (int i = 0; i < nl; i++) p->G[i + j * nl] = p->Grest[i + j * nl] + MLL[i + (long)j * n];
    return dense_lu(p->G, p->swapG, nl, nl);
}

void response_run(const struct response *p, double *d, const double *c, const double *g, double *x, double *v,
                  double *s, int add)
{
    int n = p->n, ns = p->ns;
    double h = p->h;
    for (int k = 0; k < p->ratio; k++, d += ns) {
        double f = (k + .5) / p->ratio;
        for (int i = 0; i < ns; i++) s[i] = -c[i] - f * g[i];
        dense_gemv(s, -h, p->K, x, ns, ns, n);
        dense_gemv(s, -1, p->V, v, ns, ns, ns);
        response_solve(p, s);
        for (int i = 0; i < ns; i++) x[i] += h * (v[i] + s[i] / 2);
        dense_gemv(x, h / 2, p->A, s, ns, ns, ns);
        for (int i = 0; i < ns; i++) {
            v[i] += s[i];
            d[i] = add ? d[i] + s[i] : s[i];
        }
    }
}

void response_slow_solve(const struct response *p, double *Du, double *De, const double *R, const double *rho)
{
    int nl = p->nl;
    copy(De, rho, nl);
    dense_lu_solve(p->N, p->swapN, De, nl, nl);
    for (int i = 0; i < nl; i++) Du[i] = -R[i];
    if (p->slow_slopes) dense_gemv(Du, -1, p->Ge, De, nl, nl, nl);
    dense_lu_solve(p->G, p->swapG, Du, nl, nl);
    dense_gemv(De, 1, p->T, Du, nl, nl, nl);
}
