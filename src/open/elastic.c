/* elastic.c -- see elastic.h */
#include "open/elastic.h"

#include <string.h>

#include "la/vec3.h"
#include "system/ode2.h"

/* How far from the diagonal a matrix has numbers: 0 for the stiffness of modes. */
static int band_of(const double *A, int n)
{
    int band = 0;
    for (int j = 0; A && j < n; j++)
        for (int i = j + 1; i < n; i++)
            if ((A[i + n * j] != 0 || A[j + n * i] != 0) && i - j > band) band = i - j;
    return band;
}

void elastic_build(struct elastic *o, const struct model *m, struct arena *life)
{
    *o = (struct elastic){.body = TAKE(life, struct elastic_body, m->nbody)};
    for (int i = 1; i < m->nbody; i++) {
        const struct model_body *b = &m->body[i];
        if (!b->flex) continue;
        struct elastic_body *e = &o->body[o->n++];
        e->model = b;
        e->number = i;
        e->kernel = flex_kernel_build(b->flex, life);
        flex_shape_take(&e->shape, e->kernel, life);
        e->band_K = band_of(b->flex->K, b->nmode);
        e->band_D = band_of(b->flex->D, b->nmode);
        e->q = TAKE(life, double, b->nmode);
        e->q1 = TAKE(life, double, b->nmode);
        e->q2 = TAKE(life, double, b->nmode);
        e->Q = TAKE(life, double, b->nmode);
        e->K = TAKE_MATRIX(life, double, b->nmode, b->nmode);
        e->C = TAKE_MATRIX(life, double, b->nmode, b->nmode);
    }
}

static bool in_class(const struct model_body *b, enum rate cls)
{
    return cls & (b->fast ? FAST : SLOW);
}

/* x'A x of a body's coordinates, which stand at `at` in x. */
static double square(const double *A, const double *x, const int *at, int n, int band)
{
    double sum = 0;
    for (int j = 0; j < n; j++) {
        const int from = j > band ? j - band : 0, to = j + band < n ? j + band : n - 1;
        double Ax = 0;
        for (int i = from; i <= to; i++) Ax += A[i + n * j] * x[at[i]];
        sum += Ax * x[at[j]];
    }
    return sum;
}

double elastic_stored(const struct elastic *o, const double *q)
{
    double V = 0;
    for (int i = 0; i < o->n; i++) {
        const struct model_body *b = o->body[i].model;
        V += .5 * square(b->flex->K, q, b->mode_q, b->nmode, o->body[i].band_K);
    }
    return V;
}

double elastic_lost(const struct elastic *o, const double *v, enum rate cls)
{
    double lost = 0;
    for (int i = 0; i < o->n; i++) {
        const struct model_body *b = o->body[i].model;
        if (b->flex->D && in_class(b, cls)) lost += square(b->flex->D, v, b->mode_v, b->nmode, o->body[i].band_D);
    }
    return lost;
}

static void add(double *A, int n, const double *part, int band, const struct model_body *b, const int *slot)
{
    if (!A || !part) return;
    for (int j = 0; j < b->nmode; j++) {
        const int from = j > band ? j - band : 0, to = j + band < b->nmode ? j + band : b->nmode - 1;
        double *column = A + (size_t)n * (size_t)(slot ? slot[b->mode_v[j]] : b->mode_v[j]);
        for (int i = from; i <= to; i++) column[slot ? slot[b->mode_v[i]] : b->mode_v[i]] += part[i + b->nmode * j];
    }
}

void elastic_slopes(const struct elastic *o, double *K, double *C, int n, const int *slot, enum rate cls)
{
    for (const struct elastic_body *e = o->body; e < o->body + o->n; e++) {
        if (!in_class(e->model, cls)) continue;
        add(K, n, e->model->flex->K, e->band_K, e->model, slot);
        add(C, n, e->model->flex->D, e->band_D, e->model, slot);
    }
}

bool elastic_has_slots(const struct elastic *o, const int *slot)
{
    for (int i = 0; i < o->n; i++)
        for (int k = 0; k < o->body[i].model->nmode; k++)
            if (slot[o->body[i].model->mode_v[k]] < 0) return false;
    return true;
}

static void gather(struct elastic_body *o, const double *q, const double *v, const double *a)
{
    const struct model_body *b = o->model;
    for (int i = 0; i < b->nmode; i++) {
        o->q[i] = q[b->mode_q[i]];
        o->q1[i] = v[b->mode_v[i]];
        if (a) o->q2[i] = a[b->mode_v[i]];
    }
    flex_shape_at(&o->shape, o->kernel, o->q);
}

bool elastic_in_class(const struct elastic_body *o, enum rate cls)
{
    return in_class(o->model, cls);
}

/* By the kernel in space. */
static void slopes_in_space(struct elastic_body *o, const struct pose *frame, const double *gravity,
                            const struct instant *x)
{
    double up[3], a[3], w[3], al[3];
    gather(o, x->q, x->v, x->a);
    v3_diff(up, frame->a, gravity);
    m3_tmul(a, frame->R, up);
    m3_tmul(w, frame->R, frame->w);
    m3_tmul(al, frame->R, frame->al);
    flex_slopes(o->K, o->C, o->kernel, &o->shape, a, w, al, o->q1, o->q2);
}

void elastic_turning(struct elastic_body *o, double *K, double *C, int n, const int *slot, const struct sweep_ops *ops,
                     const struct sweep *s, const double *gravity, const struct instant *x)
{
    const struct model_body *b = o->model;
    const size_t bytes = sizeof *o->K * (size_t)(b->nmode * b->nmode);
    memset(o->K, 0, bytes);
    memset(o->C, 0, bytes);
    if (ops->bend_slopes) {
        ops->bend_slopes(s, o->K, o->C, o->number);
    } else {
        struct pose frame;
        ops->pose(s, &frame, o->number);
        slopes_in_space(o, &frame, gravity, x);
    }
    for (int j = 0; j < b->nmode; j++)
        for (int i = 0; i < b->nmode; i++) {
            const int at = slot[b->mode_v[i]] + n * slot[b->mode_v[j]];
            K[at] += o->K[i + b->nmode * j];
            C[at] += o->C[i + b->nmode * j];
        }
}

/* In the frame P and H about its origin; about the world's H + r x P. */
void elastic_momentum(double *p, double *L, struct elastic_body *o, const struct pose *frame, const double *q,
                      const double *v)
{
    double P[3], H[3], moving[3], turning[3], world[3];
    gather(o, q, v, NULL);
    m3_tmul(moving, frame->R, frame->v);
    m3_tmul(turning, frame->R, frame->w);
    flex_momentum(P, H, NULL, o->kernel, &o->shape, moving, turning, o->q1);
    m3_mul(world, frame->R, P);
    v3_add(p, world);
    v3_cross_add(L, frame->r, world);
    m3_mul_add(L, frame->R, H);
}

void elastic_centre(struct pose *frame, const struct elastic *o, int body, const double *q, const double *v,
                    const double *a)
{
    struct elastic_body *e = o->body;
    double u[3], w[3], acc[3], al[3], P[3], F[3], N[3], m;
    while (e->number != body) e++;
    m = e->model->mass;
    gather(e, q, v, a);
    m3_tmul(u, frame->R, frame->v);
    m3_tmul(w, frame->R, frame->w);
    flex_momentum(P, N, NULL, e->kernel, &e->shape, u, w, e->q1);
    if (a) {
        m3_tmul(acc, frame->R, frame->a);
        m3_tmul(al, frame->R, frame->al);
        flex_inertia(F, N, e->Q, e->kernel, &e->shape, acc, w, al, e->q, e->q1, e->q2, false);
        m3_mul(frame->a, frame->R, F);
        v3_scale(frame->a, 1 / m, frame->a);
    }
    m3_mul(frame->v, frame->R, P);
    v3_scale(frame->v, 1 / m, frame->v);
    m3_mul(u, frame->R, e->shape.h);
    v3_axpy(frame->r, 1 / m, u);
}
