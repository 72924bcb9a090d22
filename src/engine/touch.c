/* touch.c -- see touch.h: what all its parts share, the start, records */
#include "engine/touch.h"

#include <math.h>

#include "base/scalar.h"
#include "engine/motion.h"
#include "engine/touch_parts.h"

/* ---- memory ---- */

static void open_rows(struct touch_rows *o, int rows, int n, struct arena *life)
{
    o->G = TAKE_MATRIX(life, double, rows, n);
    o->b = TAKE(life, double, rows);
}

static void open_saved(struct touch_saved *o, const struct ode2 *ode, struct arena *life)
{
    const int m = ode->contact->m;
    single_open(&o->at, ode, life);
    o->closed = TAKE(life, int, m);
    o->which = TAKE(life, int, m);
    o->pushed = TAKE(life, int, m);
    o->other = TAKE(life, int, m);
    o->is_other = TAKE(life, int, m);
    o->state = TAKE(life, int, m);
    o->impacts = TAKE(life, long, m);
    o->impulse = TAKE(life, double, m);
    o->way = TAKE(life, double, 2 * m);
    o->p = TAKE(life, double, ode->contact->nrow);
}

/* Displacements of different units are weighed by their usual sizes. */
static void weigh(struct touch *o)
{
    for (int i = 0; i < o->ode->n; i++) {
        const double size = ode2_usual(o->ode, i);
        o->weight[i] = size > 0 ? 1 / (size * size) : 1;
    }
}

static void open_gaps(struct touch *o, struct arena *life)
{
    struct nearby *gaps[] = {&o->g, &o->g0, &o->g1};
    for (int i = 0; i < 3; i++) nearby_open(gaps[i], o->c->m, life);
    for (int i = 0; i <= TOUCH_PARTS; i++) nearby_open(&o->among[i], o->c->m, life);
    o->seen.q = TAKE(life, double, o->ode->nq);
    o->seen.reach = NAN;
}

struct touch *touch_open(struct stepper *s, struct arena *life)
{
    struct touch *o = TAKE(life, struct touch, 1);
    const struct ode2 *ode = s->ode;
    const int m = ode->contact->m, rows = ode->contact->nrow, n = ode->n;
    int **whole[] = {&o->first, &o->closed, &o->which, &o->pushed, &o->state, &o->contact, &o->turns, &o->forced};
    double **of_rows[] = {&o->p, &o->u, &o->u1, &o->l, &o->last};
    double **of_n[] = {&o->v1, &o->vm, &o->a, &o->dx, &o->r, &o->y, &o->vf, &o->weight};
    double **of_m[] = {&o->size, &o->e, &o->impulse};
    o->ode = ode;
    o->c = ode->contact;
    o->stepper = s;
    for (size_t i = 0; i < sizeof whole / sizeof *whole; i++) *whole[i] = TAKE(life, int, m);
    for (size_t i = 0; i < sizeof of_rows / sizeof *of_rows; i++) *of_rows[i] = TAKE(life, double, rows);
    for (size_t i = 0; i < sizeof of_n / sizeof *of_n; i++) *of_n[i] = TAKE(life, double, n);
    for (size_t i = 0; i < sizeof of_m / sizeof *of_m; i++) *of_m[i] = TAKE(life, double, m);
    open_gaps(o, life);
    o->impacts = TAKE(life, long, m);
    o->way = TAKE(life, double, 2 * m);
    o->heads = TAKE(life, double, 2 * m);
    o->held = TAKE(life, double, rows);
    o->N = TAKE(life, double, m);
    o->off = TAKE(life, double, m);
    o->was = TAKE(life, double, m);
    o->f = TAKE(life, double, rows);
    o->shown = TAKE(life, struct touch_state, m);
    o->cone = TAKE(life, struct cone, m);
    o->q = TAKE(life, double, ode->nq);
    o->q1 = TAKE(life, double, ode->nq);
    o->X = TAKE_MATRIX(life, double, n, rows);
    o->W = TAKE_MATRIX(life, double, rows, rows);
    open_rows(&o->middle, rows, n, life);
    open_rows(&o->end, rows, n, life);
    cone_open(&o->work, rows, life);
    matrix_open(&o->J, ode, &s->effort, life);
    matrix_open(&o->M, ode, &s->effort, life);
    path_open(&o->path, ode, life);
    open_saved(&o->start, ode, life);
    open_saved(&o->part, ode, life);
    for (int i = 1; i < m; i++) o->first[i] = o->first[i - 1] + 1 + o->c->of[i - 1].across;
    for (int i = 0; i < m; i++) o->size[i] = o->c->of[i].size;
    for (int i = 0; i < m; i++) o->longest = larger(o->longest, larger(1, o->size[i]));
    weigh(o);
    return o;
}

/* ---- rates of those that are looked at, what pushes there ---- */

void touch_note(struct touch *o, struct touch_event e)
{
    if (o->nevent < MOST_EVENTS)
        o->event[o->nevent++] = e;
    else
        o->lost_events++;
}

void touch_rates(const struct touch *o, double *u, const struct touch_rows *R, const double *v)
{
    for (int i = 0; i < o->rows; i++) u[i] = dot(R->G + i * o->ode->n, v, o->ode->n) + R->b[i];
}

enum status touch_look(struct touch *o, double *u, struct touch_rows *R, const struct state *x, struct trouble *why)
{
    TRY(o->c->rows(o->c, R->G, R->b, o->contact, o->n, x->q, x->t, why));
    touch_rates(o, u, R, x->v);
    return OK;
}

double touch_slip(const double *u, const struct cone *c)
{
    return c->across ? hypot(u[c->row + 1], c->across > 1 ? u[c->row + 2] : 0) : 0;
}

bool touch_sticks(const struct touch *o, const double *u, const struct cone *c)
{
    return c->across && touch_slip(u, c) <= TOUCH_AT_REST * o->top;
}

void touch_compliance(struct touch *o, const struct matrix *F, const double *G, const double *G1)
{
    const int n = o->ode->n, rows = o->rows;
    for (int j = 0; j < rows; j++) {
        double *X = o->X + j * n;
        copy(X, G + j * n, n);
        matrix_solve(F, X);
        for (int i = 0; i < rows; i++) o->W[i + j * rows] = dot(G1 + i * n, X, n);
    }
}

enum status touch_mass(struct touch *o, const struct state *x, struct trouble *why)
{
    const struct instant at = {.t = x->t, .q = x->q, .v = x->v, .ta = x->t, .tb = x->t};
    TRY(matrix_factor(&o->M, 0, 0, &at, why));
    touch_compliance(o, &o->M, o->end.G, o->end.G);
    return OK;
}

/* Friction of a joint is by its force, and its force by its friction: where going to and fro does not settle soon, it is
 * gone a share of the way, or further than it (Aitken's rule for vectors: Irons & Tuck, Int. J. Numer. Methods Eng. 1 (1969) 275). */
static void mend(struct touch *o, int count)
{
    static const double SOON = .3, LEAST = .02, MOST = 10;
    double to = 0, all = 0, now = 0, last = 0;
    for (int k = 0; k < o->n; k++) {
        const int i = o->contact[k];
        if (!o->c->of[i].joint) continue;
        const double d = o->off[i] - o->was[i];
        to += o->was[i] * d;
        all += d * d;
        now += o->off[i] * o->off[i];
        last += o->was[i] * o->was[i];
    }
    if (count < 2)
        o->share = 1;
    else if (now > SOON * SOON * last && all > 0)
        o->share = smaller(MOST, larger(LEAST, -o->share * to / all));
}

enum status touch_press(struct touch *o, const struct instant *x, double h, int count, struct trouble *why)
{
    if (!o->c->bound) return OK;
    touch_spread(o, o->f);
    for (int i = 0; i < o->c->nrow; i++) o->f[i] /= h;
    TRY(o->c->bound(o->c, o->off, o->contact, o->n, x, o->f, why));
    for (int k = 0; k < o->n; k++) {
        const int i = o->contact[k];
        if (count == 0) o->N[i] = o->off[i];
        o->off[i] -= o->N[i];
    }
    mend(o, count);
    for (int k = 0; k < o->n; k++) {
        const int i = o->contact[k];
        if (!o->c->of[i].joint) continue;
        o->N[i] = larger(0, o->N[i] + o->share * o->off[i]);
        o->was[i] = o->off[i];
        o->l[o->cone[k].row] = h * o->N[i];
    }
    return OK;
}

double touch_taken(const struct touch *o)
{
    double sum = 0;
    for (int i = 0; i < o->rows; i++) sum -= .5 * o->l[i] * (o->u[i] + o->u1[i]);
    return sum;
}

void touch_kick(const struct touch *o, double *v, const double *p)
{
    const int n = o->ode->n;
    for (int j = 0; j < o->rows; j++)
        for (int i = 0; i < n; i++) v[i] += o->X[i + j * n] * p[j];
}

void touch_strike(struct touch *o, const double *q, double *v, double t)
{
    static const double ROUND_OFF = 1e-13;
    struct stepper *s = o->stepper;
    const double before = o->ode->kinetic ? o->ode->kinetic(o->ode, q, v, t) : 0, loss = touch_taken(o),
                 along = dot(o->l, o->end.b, o->rows);
    touch_kick(o, v, o->l);
    s->struck += loss;
    s->work[POWER_DRIVE] -= along;
    /* Drives hold what they move against what is struck beside it, too. */
    const double behind = o->ode->kinetic ? o->ode->kinetic(o->ode, q, v, t) : 0, more = behind - before + loss + along;
    const double all = behind + before; /* 0: not known */
    if (all > 0 && fabs(more) > ROUND_OFF * (all + fabs(loss))) s->work[POWER_DRIVE] += more;
}

void touch_grow(struct touch *o, const double *v)
{
    for (int i = 0; i < o->ode->n; i++) o->top = larger(o->top, fabs(v[i]));
}

/* ---- the start ---- */

/* Closes what touches and does not move along its gap. */
static enum status close_drawn(struct touch *o, const struct state *x, double h, struct trouble *why)
{
    touch_grow(o, x->v);
    for (int i = 0; i < o->ode->n; i++) o->top = larger(o->top, h * fabs(x->a[i]));
    int n = 0;
    for (int k = 0; k < o->g.n; k++) {
        const int i = o->g.which[k];
        if (o->g.gap[i] <= TOUCH_DRAWN * o->size[i]) o->contact[n++] = i;
    }
    touch_choose(o, n);
    if (o->n == 0) return OK;
    TRY(touch_look(o, o->u, &o->end, x, why));
    for (int k = 0; k < o->n; k++) {
        const struct cone *c = &o->cone[k];
        const int i = o->contact[k];
        o->closed[i] = fabs(o->u[c->row]) <= TOUCH_AT_REST * o->top;
        if (o->closed[i]) touch_set_slip(o, i, o->u, c);
    }
    touch_keep_closed(o);
    return OK;
}

enum status touch_begin(struct touch *o, int *deepest, double *overlap, const struct state *x, double h,
                        struct trouble *why)
{
    *overlap = 0;
    *deepest = -1;
    o->usual = h;
    TRY(touch_gaps(o, x, INFINITY, why));
    for (int i = 0; i < o->c->m; i++) {
        const double g = o->g.gap[i];
        if (g < -TOUCH_DRAWN * o->size[i] && (*deepest < 0 || g < *overlap)) *overlap = o->g.gap[*deepest = i];
    }
    if (*deepest >= 0) return OK;
    TRY(close_drawn(o, x, h, why));
    return o->ode->n == 0 ? touch_driven_at(o, x, why) : OK;
}

/* ---- for records ---- */

const struct touch_state *touch_state(const struct touch *o, int i)
{
    struct touch_state *s = &o->shown[i];
    *s = (struct touch_state){.state = o->state[i], .impulse = o->impulse[i], .impacts = o->impacts[i]};
    for (int j = 0; j <= o->c->of[i].across && o->took > 0; j++) s->force[j] = o->p[o->first[i] + j] / o->took;
    return s;
}

int touch_events(const struct touch *o, const struct touch_event **list)
{
    *list = o->event;
    return o->nevent;
}

void touch_clear(struct touch *o)
{
    o->nevent = o->lost_events = 0;
}

long touch_impacts(const struct touch *o)
{
    return o->all;
}

long touch_lowered(const struct touch *o)
{
    return o->lowered;
}

bool touch_pushed(const struct touch *o)
{
    for (int i = 0; i < o->c->m; i++)
        if (o->impulse[i] != 0) return true;
    return false;
}

bool touch_rubs(const struct touch *o)
{
    for (int i = 0; i < o->c->m; i++)
        if (o->impulse[i] != 0 && !o->c->of[i].joint) return false;
    return touch_pushed(o);
}

void touch_recall(struct touch *o, struct recall *r)
{
    recall_within(r, "touch");
    recall_one(r, "begun", o->begun);
    recall_list(r, "closed", o->closed, o->c->m);
    o->nclosed = 0;
    o->npushed = o->c->m;
    for (int i = 0; i < o->c->m; i++) {
        touch_change(o, o->pushed[i] = i);
        if (o->closed[i]) o->which[o->nclosed++] = i;
    }
    recall_list(r, "state", o->state, o->c->m);
    recall_list(r, "way", o->way, 2 * o->c->m);
    recall_list(r, "p", o->p, o->c->nrow);
    recall_one(r, "took", o->took);
    recall_one(r, "hfactor", o->hfactor);
    recall_list(r, "impulse", o->impulse, o->c->m);
    recall_list(r, "impacts", o->impacts, o->c->m);
    recall_one(r, "all", o->all);
    recall_one(r, "lowered", o->lowered);
    recall_one(r, "top", o->top);
    recall_one(r, "usual", o->usual);
    recall_list(r, "size", o->size, o->c->m);
    recall_list(r, "weight", o->weight, o->ode->n); /* usual sizes are those of the start */
    (void)matrix_recall(&o->J, r);
    recall_without(r);
}
