/* response_recall.c -- what response.h keeps frozen from step to step. */
#include "multirate/response.h"

static void minor_recall(struct minor *m, struct recall *r)
{
    const int n = m->n, ns = m->ns;
    recall_within(r, "minor");
    recall_one(r, "h", m->h);
    recall_list(r, "K", m->K, (size_t)n * (size_t)n);
    recall_list(r, "C", m->C, (size_t)n * (size_t)n);
    recall_list(r, "J", m->J, ns * ns);
    recall_list(r, "S", m->S, ns * ns);
    recall_list(r, "V", m->V, ns * ns);
    recall_list(r, "inverse", m->spare, ns * ns);
    recall_list(r, "swap", m->swap, ns);
    form_recall(&m->form, r);
    recall_without(r);
}

/* What is there where M_LL is formed. */
static void dense_recall(struct response *p, struct recall *r)
{
    const size_t nl = (size_t)p->nl;
    if (!p->G) return;
    recall_list(r, "MLL", p->MLL, nl * nl);
    recall_list(r, "G", p->G, nl * nl);
    recall_one(r, "formed", p->formed);
    recall_list(r, "swapG", p->swapG, nl);
    form_recall(&p->form, r);
}

static void coupling_recall(struct response *p, struct recall *r)
{
    const size_t ns = (size_t)p->ns, nl = (size_t)p->nl, ml = (size_t)p->ml, cols = 2 * ns;
    recall_list(r, "Q", p->Q, ml * ns);
    recall_list(r, "X", p->X, ns * cols);
    recall_list(r, "Y", p->Y, ns * cols);
    recall_list(r, "U", p->U, nl * cols);
    recall_list(r, "GU", p->GU, nl * cols);
    recall_list(r, "V", p->V, nl * cols);
    recall_list(r, "E", p->E, cols * cols);
    recall_list(r, "T", p->T, cols * cols);
    recall_list(r, "swapT", p->swapT, cols);
}

void response_recall(struct response *p, const struct decouple *dec, struct recall *r)
{
    const size_t n = (size_t)p->n, ns = (size_t)p->ns, nl = (size_t)p->nl;
    recall_within(r, "response");
    recall_one(r, "h", p->h);
    recall_one(r, "H", p->H);
    recall_one(r, "ratio", p->ratio);
    recall_list(r, "A", p->A, ns * ns);
    recall_list(r, "D", p->D, ns * ns);
    recall_list(r, "Mss", p->Mss, ns * ns);
    recall_list(r, "F", p->F, nl * nl);
    recall_list(r, "FW", p->FW, nl * ns);
    recall_list(r, "WFW", p->WFW, ns * ns);
    recall_list(r, "Gk", p->Gk, nl * nl);
    recall_list(r, "d", p->d, n);
    recall_one(r, "slow_slopes", p->slow_slopes);
    recall_one(r, "stiff", p->stiff);
    recall_one(r, "diagonal", p->diagonal);
    recall_one(r, "couples", p->couples);
    recall_one(r, "drives", p->drives);
    minor_recall(&p->one, r);
    dense_recall(p, r);
    if (dec->structured && dec->there && p->stiff) {
        const size_t factor = dec->ode->direct->factor_size / sizeof(double);
        recall_list(r, "factor", (double *)p->GF, factor);
    }
    if (p->drives) coupling_recall(p, r);
    recall_without(r);
}
