/* decouple.c -- see decouple.h */
#include "engine/decouple.h"

#include "engine/motion.h"
#include "la/dense.h"

void decouple_open(struct decouple *p, int n, int ns, struct arena *life)
{
    int nl = n - ns;
    *p = (struct decouple){.n = n, .ns = ns, .nl = nl};
    p->M = TAKE(life, double, n *n);
    p->W = TAKE(life, double, nl *ns);
    p->Mss = TAKE(life, double, ns *ns);
    p->L = TAKE(life, double, nl *nl);
}

int decouple_factor(struct decouple *p)
{
    int n = p->n, ns = p->ns, nl = p->nl;
    dense_copy(p->Mss, p->M, ns, ns, ns, n);
    dense_copy(p->W, p->M + ns, nl, ns, nl, n);
    p->coupled = 0;
    for (int i = 0; i < nl * ns; i++) p->coupled |= p->W[i] != 0;
    if (!p->coupled) return -1;
    dense_copy(p->L, p->M + ns + ns * n, nl, nl, nl, n);
    int pivot = dense_cholesky(p->L, nl, nl);
    if (pivot >= 0) return ns + pivot;
    dense_cholesky_solves(p->L, p->W, nl, nl, ns, nl);
    dense_gemtm(p->Mss, -1, p->M + ns, p->W, ns, nl, ns, ns, n, nl);
    return -1;
}

void decouple_out(const struct decouple *p, double *out, const double *y, const double *x)
{
    copy(out, x, p->ns);
    copy(out + p->ns, y, p->nl);
    if (p->coupled) dense_gemv(out + p->ns, -1, p->W, x, p->nl, p->ns, p->nl);
}

void decouple_fast(const struct decouple *p, double *rs, const double *r)
{
    copy(rs, r, p->ns);
    if (p->coupled) dense_gemtv(rs, -1, p->W, r + p->ns, p->nl, p->ns, p->nl);
}

void decouple_slopes(const struct decouple *p, double *K)
{
    int n = p->n, ns = p->ns, nl = p->nl;
    if (!p->coupled) return;
    dense_gemm(K, -1, K + ns * n, p->W, n, nl, ns, n, n, nl);
    dense_gemtm(K, -1, p->W, K + ns, ns, nl, n, n, nl, n);
}
