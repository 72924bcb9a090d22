/* planar_mass.c -- M^ in the plane by composite bodies.
 *
 * A body and all that hangs on it, held stiff: mass m_c, first moment s_c and inertia j_c about the body's
 * centre.  The force and moment that start it with unit u_k' give column k: at its own joint and,
 * carried inwards, at every joint on the path.  Walker & Orin, J. Dyn. Syst. Meas. Control 104 (1982) 205. */
#include "tree/planar_flex.h"

/* Composite bodies, from the tips to the ground. */
static void compose(struct sweep *s, const struct roster *o)
{
    for (int i = 0; i < o->n; i++) {
        const struct link *l = &s->link[o->body[i]];
        struct part *x = &s->part[o->body[i]];
        x->cm = o->bears[i] ? l->mass : 0;
        x->cj = o->bears[i] ? l->inertia : 0;
        x->cs[0] = x->cs[1] = 0;
    }
    if (s->bend) planar_flex_compose(s, o);
    for (int i = o->n - 1; i >= 0; i--) {
        const struct part *x = &s->part[o->body[i]];
        struct part *p = &s->part[s->link[o->body[i]].parent];
        const double *d = x->arm;
        p->cm += x->cm;
        p->cs[0] += x->cs[0] + x->cm * d[0];
        p->cs[1] += x->cs[1] + x->cm * d[1];
        p->cj += x->cj + 2 * (d[0] * x->cs[0] + d[1] * x->cs[1]) + x->cm * (d[0] * d[0] + d[1] * d[1]);
    }
}

/* Force f[0..1] and moment f[2] about the centre that start the composite body x with unit rate of k. */
static inline void start(double *f, const struct part *x, const struct link *l, int k)
{
    double al = 0, a[2];
    if (planar_turns(l, k)) {
        al = l->turn;
        a[0] = -al * x->c_b[1];
        a[1] = al * x->c_b[0];
    } else {
        a[0] = x->e[k][0];
        a[1] = x->e[k][1];
    }
    f[0] = x->cm * a[0] - al * x->cs[1];
    f[1] = x->cm * a[1] + al * x->cs[0];
    f[2] = x->cj * al + x->cs[0] * a[1] - x->cs[1] * a[0];
}

static inline double row(const struct part *x, const struct link *l, int k, const double *f)
{
    if (planar_turns(l, k)) return l->turn * (f[2] + x->c_b[0] * f[1] - x->c_b[1] * f[0]);
    return x->e[k][0] * f[0] + x->e[k][1] * f[1];
}

/* Column and row `col` of M take x where they meet coordinate i. */
static inline void put(double *column, double *row, int n, int i, double x)
{
    column[i] = x;
    row[(size_t)n * (size_t)i] = x;
}

static void column(double *M, const struct sweep *s, int body, int k)
{
    double f[3];
    const int n = s->n, col = s->link[body].iv[k];
    double *down = M + (size_t)n * (size_t)col, *along = M + col;
    start(f, &s->part[body], &s->link[body], k);
    for (int i = body; i > 0; i = s->link[i].parent) {
        const struct part *x = &s->part[i];
        const struct link *l = &s->link[i];
        if (l->type == TURN)
            put(down, along, n, l->iv[0], l->turn * (f[2] + x->c_b[0] * f[1] - x->c_b[1] * f[0]));
        else
            for (int o = 0; o < (i == body ? k + 1 : l->nv); o++) put(down, along, n, l->iv[o], row(x, l, o, f));
        f[2] += x->arm[0] * f[1] - x->arm[1] * f[0];
    }
}

void planar_mass(struct sweep *s, double *M, const double *q, unsigned cls)
{
    const struct roster *o = &s->rosters.of[cls];
    roster_clear(o, M, s->n);
    if (q) planar_place(s, q, cls);
    s->part[0].cm = s->part[0].cj = s->part[0].cs[0] = s->part[0].cs[1] = 0;
    compose(s, o);
    if (s->bend) {
        planar_flex_columns(M, s, o);
        return;
    }
    for (int i = 0; i < o->n; i++)
        for (int k = 0; k < s->link[o->body[i]].nv; k++) column(M, s, o->body[i], k);
}
