/* idle.c -- see idle.h */
#include "system/idle.h"

#include <math.h>
#include <string.h>

#include "la/dense.h"
#include "la/eigen.h"
#include "la/vec3.h"
#include "system/idle_parts.h"
#include "tree/sizes.h"

/* An axis about which a body has no inertia. */
struct spin {
    int body, group;
    double axis[3];       /* unit, body axes */
    double inertia, real; /* what is given to it; what it has, next to nothing [kg m2] */
    bool idle;
};

struct spins {
    const struct model *model;
    int n;
    struct spin *spin; /* [n] */
};

/* --- axes without inertia ----------------------------------------------------------------------- */

/* Principal moments [3] ascending and their axes, by column. */
static void principal(double *moment, double *axes, const double *J)
{
    double A[9] = {J[0], J[3], J[4], J[3], J[1], J[5], J[4], J[5], J[2]};
    eigen_symmetric(moment, axes, A, 3);
}

static void add_spin(struct spins *o, int body, const double *axis, double inertia, double real)
{
    struct spin *s = &o->spin[o->n++];
    *s = (struct spin){.body = body, .inertia = inertia, .real = real};
    v3_copy(s->axis, axis);
}

/* A thousandth of what the body has about its other axes, or of its mass at the mechanism's length: so large that
 * matrices stay good, so small that a force along the turn shows. */
static void spins_of_body(struct spins *o, int i, double length)
{
    static const double NOTHING = 1e-8, SHARE = 1e-3;
    const struct model_body *b = &o->model->body[i];
    const double far = b->mass * length * length;
    if (b->mass == 0) return; /* its centre may move, too */
    if (o->model->space == 2) {
        if (fabs(b->inertia[2]) <= NOTHING * far) add_spin(o, i, (double[]){0, 0, 1}, SHARE * far, b->inertia[2]);
        return;
    }
    double moment[3], axes[9];
    principal(moment, axes, b->inertia);
    const bool point = moment[2] <= NOTHING * far;
    if (!point && fabs(moment[2] - moment[1]) > 1e-6 * moment[2]) return; /* other turns would push this one */
    for (int k = 0; k < 3; k++)
        if (fabs(moment[k]) <= NOTHING * (point ? far : moment[2]))
            add_spin(o, i, axes + 3 * k, SHARE * (point ? far : moment[2]), moment[k]);
}

/* Friction at its surface turns it, however small it is against the mechanism. */
static bool rolls(const struct model *m, int body)
{
    const double *J = m->body[body].inertia;
    for (int i = 0; i < m->ncontact && J[0] + J[1] + J[2] > 0; i++) {
        const struct model_contact *c = &m->contact[i];
        if (c->across > 0 && (c->a.body == body || c->b.body == body)) return true;
    }
    return false;
}

static void spins_collect(struct spins *o, const struct model *m, struct arena *scratch)
{
    const double length = sizes_length(m);
    o->model = m;
    o->spin = TAKE(scratch, struct spin, 3 * m->nbody);
    for (int i = 1; i < m->nbody; i++)
        if (m->body[i].held && !rolls(m, i)) spins_of_body(o, i, length);
}

static void hold(const struct spins *o, bool all)
{
    for (int i = 0; i < o->n; i++) memset(o->model->body[o->spin[i].body].held, 0, 6 * sizeof(double));
    for (int i = 0; i < o->n; i++) {
        const struct spin *s = &o->spin[i];
        const double *e = s->axis;
        double *J = o->model->body[s->body].held;
        if (!all && !s->idle) continue;
        const double more = s->inertia - (all ? s->real : 0);
        for (int k = 0; k < 3; k++) J[k] += more * e[k] * e[k];
        J[3] += more * e[0] * e[1];
        J[4] += more * e[0] * e[2];
        J[5] += more * e[1] * e[2];
    }
}

/* --- which of them are idle --------------------------------------------------------------------- */

/* Is M^ singular, or all but singular, along some turn?  One solution, of all spins at once, tells. */
static bool suspected(const struct spins *o, struct system *s, const double *q, double t, struct arena *scratch)
{
    static const double NEARLY = 1e-4;
    struct inverse M;
    const int n = system_ode2(s)->n;
    double *b = TAKE(scratch, double, n), *x = TAKE(scratch, double, n);
    struct turn_axis *of = TAKE(scratch, struct turn_axis, o->n);
    for (int i = 0; i < o->n; i++) {
        const struct spin *p = &o->spin[i];
        of[i] = (struct turn_axis){p->body, p->axis, idle_scatter((unsigned)i) * sqrt(p->inertia)};
    }
    system_spin_row(s, b, q, t, of, o->n);
    if (!inverse_build(&M, system_ode2(s), q, t, scratch)) return true;
    memcpy(x, b, sizeof *x * (size_t)n);
    inverse_apply(&M, x);
    return !(idle_dot(b, x, n) <= o->n / NEARLY);
}

/* Spins whose bodies hang together get one number: M^ has nothing between those of two. */
static int group(struct spins *o, struct arena *scratch)
{
    const struct model *m = o->model;
    int *of = TAKE(scratch, int, m->nbody), *number = TAKE(scratch, int, m->nbody), n = 0;
    for (int i = 0; i < m->nbody; i++) of[i] = i > 0 && m->body[i].parent > 0 ? of[m->body[i].parent] : i;
    for (int l = 0; l < m->nloop; l++) {
        const int a = of[m->loop[l].first], b = of[m->loop[l].second];
        for (int i = 1; a > 0 && b > 0 && a != b && i < m->nbody; i++)
            if (of[i] == b) of[i] = a;
    }
    for (int i = 0; i < o->n; i++) {
        int *k = &number[of[o->spin[i].body]];
        if (*k == 0) *k = ++n;
        o->spin[i].group = *k - 1;
    }
    return n;
}

/* B = L L' of m spins, pivots largest first: *rank of them; the rest is nothing.  at [m]: which spin stands where. */
static void eliminate(double *B, int *at, int *rank, int m)
{
    static const double NOTHING = 1e-9;
    for (*rank = 0; *rank < m; ++*rank) {
        int k = *rank, p = k;
        for (int i = k; i < m; i++)
            if (B[at[i] * (m + 1)] > B[at[p] * (m + 1)]) p = i;
        if (!(B[at[p] * (m + 1)] > NOTHING)) return;
        const int to = at[p];
        at[p] = at[k];
        at[k] = to;
        const double root = sqrt(B[to * (m + 1)]);
        for (int i = k + 1; i < m; i++) B[at[i] + m * to] /= root;
        B[to * (m + 1)] = root;
        for (int j = k + 1; j < m; j++)
            for (int i = k + 1; i < m; i++) B[at[i] + m * at[j]] -= B[at[i] + m * to] * B[at[j] + m * to];
    }
}

/* u [m]: the null vector of B in which spin `lead` is 1 and no other idle one turns. */
static void null_vector(double *u, const double *B, const int *at, int rank, int lead, int m)
{
    memset(u, 0, sizeof *u * (size_t)m);
    u[lead] = 1;
    for (int k = rank - 1; k >= 0; k--) {
        double sum = -B[lead + m * at[k]];
        for (int i = k + 1; i < rank; i++) sum -= B[at[i] + m * at[k]] * u[at[i]];
        u[at[k]] = sum / B[at[k] * (m + 1)];
    }
}

/* A point mass with one idle turn: about the axis that it has in it. */
static void aim(struct spin **of, int lead, const double *u, int m)
{
    double w[3] = {0, 0, 0};
    for (int i = 0; i < m; i++) {
        if (of[i]->body != of[lead]->body) continue;
        if (i != lead && of[i]->idle) return;
        v3_axpy(w, u[i] / sqrt(of[i]->inertia), of[i]->axis);
    }
    v3_scale(of[lead]->axis, 1 / v3_norm(w), w);
}

static void decide_group(struct spin **of, int m, struct system *s, const struct inverse *M, const double *q, double t,
                         struct arena *scratch)
{
    const int n = M->ode->n;
    double *S = TAKE_MATRIX(scratch, double, n, m), *x = TAKE(scratch, double, n),
           *B = TAKE_MATRIX(scratch, double, m, m);
    int *at = TAKE(scratch, int, m), rank;
    for (int i = 0; i < m; i++) {
        at[i] = i;
        system_spin_row(s, S + (size_t)i * (size_t)n, q, t, &(struct turn_axis){of[i]->body, of[i]->axis, 1}, 1);
    }
    for (int i = 0; i < m; i++) {
        memcpy(x, S + (size_t)i * (size_t)n, sizeof *x * (size_t)n);
        inverse_apply(M, x);
        for (int j = 0; j < m; j++)
            B[j + m * i] = (i == j) - sqrt(of[i]->inertia * of[j]->inertia) * idle_dot(S + (size_t)j * (size_t)n, x, n);
    }
    eliminate(B, at, &rank, m);
    for (int i = rank; i < m; i++) of[at[i]]->idle = true;
    for (int i = rank; i < m; i++) {
        null_vector(x = TAKE(scratch, double, m), B, at, rank, at[i], m);
        aim(of, at[i], x, m);
    }
}

/* With M^ + S' J S of all spins. */
static void decide(struct spins *o, struct system *s, const double *q, double t, struct arena *scratch)
{
    enum { MOST = 20000000 }; /* numbers and solutions */
    struct inverse M;
    const int ngroup = group(o, scratch);
    if ((double)o->n * system_ode2(s)->n > MOST || !inverse_build(&M, system_ode2(s), q, t, scratch)) return;
    struct spin **of = TAKE(scratch, struct spin *, o->n);
    for (int g = 0; g < ngroup; g++) {
        int m = 0;
        const struct arena_mark mark = arena_mark(scratch);
        for (int i = 0; i < o->n; i++)
            if (o->spin[i].group == g) of[m++] = &o->spin[i];
        decide_group(of, m, s, &M, q, t, scratch);
        arena_rewind(scratch, mark);
    }
}

/* Does the deck say how fast the joint of the body moves at the start? */
static bool is_given(const struct model *m, int body)
{
    const struct model_joint *j = &m->joint[m->body[body].joint];
    bool any = false;
    for (int k = 0; k < j->nv; k++) any |= m->v0[j->iv[k]] != 0;
    return any;
}

static void keep(struct idle *o, const struct spins *spins, struct arena *life)
{
    o->turn = TAKE(life, struct idle_turn, spins->n);
    o->n = 0;
    for (int i = 0; i < spins->n; i++) {
        const struct spin *s = &spins->spin[i];
        if (!s->idle) continue;
        struct idle_turn *turn = &o->turn[o->n++];
        *turn = (struct idle_turn){
            .body = s->body, .inertia = s->inertia, .real = s->real, .given = is_given(spins->model, s->body)};
        v3_copy(turn->axis, s->axis);
    }
}

/* Of those with an inertia of next to nothing, the ones that something sets going are what the deck says. */
static void release(struct spins *spins, struct idle *o, double t1, struct arena *scratch)
{
    const struct model *m = spins->model;
    struct report report = {0};
    bool *pushed = TAKE(scratch, bool, o->n);
    struct system *s = system_build(m, scratch);
    double *q = TAKE(scratch, double, m->nq), *v = TAKE(scratch, double, m->n);
    if (system_start(s, q, v, &report) != OK) return;
    idle_still(o, s, q, v, m->t0);
    idle_pushed(pushed, o, s, q, m->t0, t1);
    for (int i = 0, k = 0; i < spins->n; i++) {
        if (!spins->spin[i].idle) continue;
        const struct idle_turn *turn = &o->turn[k];
        const bool started = turn->given && fabs(turn->dropped) > 1e-9; /* [rad/s], as sim/idle.c tells it */
        if (turn->real > 0 && (started || pushed[k])) spins->spin[i].idle = false;
        k++;
    }
}

static void find(struct idle *o, struct spins *spins, double t1, struct arena *life, struct arena *scratch)
{
    const struct model *m = spins->model;
    struct report report = {0};
    double *q = TAKE(scratch, double, m->nq), *v = TAKE(scratch, double, m->n);
    hold(spins, true);
    struct system *s = system_build(m, scratch);
    if (system_start(s, q, v, &report) == OK) decide(spins, s, q, m->t0, scratch);
    hold(spins, false);
    keep(o, spins, life);
    if (o->n == 0) return;
    release(spins, o, t1, scratch);
    hold(spins, false);
    keep(o, spins, life);
}

void idle_find(struct idle *o, struct system *s, const struct model *m, double t1, struct arena *life)
{
    struct arena *scratch = arena_open();
    struct spins spins = {0};
    struct report report = {0};
    double *q = TAKE(scratch, double, m->nq), *v = TAKE(scratch, double, m->n);
    *o = (struct idle){.model = m};
    if (system_start(s, q, v, &report) == OK) spins_collect(&spins, m, scratch);
    if (spins.n > 0 && suspected(&spins, s, q, m->t0, scratch)) find(o, &spins, t1, life, scratch);
    arena_close(scratch);
}
