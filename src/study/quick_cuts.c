/* quick_cuts.c -- which coordinates to take for fast, by what was seen of the motion; see quick.h */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "la/dense.h"
#include "model/model.h"
#include "study/quick.h"
#include "study/reference.h"
#include "system/system.h"

static const double GAIN = 1.2;  /* below which two rates are not worth while */
static const double APART = 3;   /* of steps, from which on two rates are thought of */
static const double OVER = 1.15; /* what a major step of two rates takes over its ideal */

/* A joint, or a mode of the body behind it. */
struct part {
    double e;
    int joint, mode; /* of the model; -1: the joint itself */
};

static int by_e(const void *a, const void *b)
{
    const struct part *x = a, *y = b;
    if (x->e != y->e) return x->e < y->e ? 1 : -1;
    const int apart = (x->joint > y->joint) - (x->joint < y->joint);
    return apart ? apart : (x->mode > y->mode) - (x->mode < y->mode);
}

/* The decoupled motion of what is not fast. */
struct slow {
    const struct quick *quick;
    struct sim *sim;
    bool masses;         /* M is known */
    bool recoils;        /* W is, of what is fast now */
    bool *fast;          /* [n] of the state's rates */
    double *M, *L, *W;   /* [n x n], [m x m] and [m x s] of what it is made of */
    int *slow, *quicker; /* [m], [s] places */
    int m, s;
    double *e; /* [n] of the rates of the state: what u is off by; of fast ones as they are */
};

static void open_slow(struct slow *o, const struct quick *quick, struct sim *sim, struct arena *scratch)
{
    struct ode2 *ode = sim->stepper.ode;
    struct trouble why;
    const int n = ode->n, most = n <= MOST_DENSE ? n : 0;
    *o = (struct slow){.quick = quick, .sim = sim};
    o->fast = TAKE(scratch, bool, n);
    o->M = TAKE(scratch, double, most *most);
    o->L = TAKE(scratch, double, most *most);
    o->W = TAKE(scratch, double, most *most);
    o->slow = TAKE(scratch, int, n);
    o->quicker = TAKE(scratch, int, n);
    o->e = TAKE(scratch, double, n);
    o->masses = most > 0 && ode->ops->mass(ode, o->M, sim->x.q, sim->x.t, ALL, &why) == OK;
}

/* W of what is slow, of the fast ones; false: there is none. */
static bool find_recoil(struct slow *o, int m, int s)
{
    const int n = o->quick->n;
    for (int k = 0; k < m; k++)
        for (int i = 0; i < m; i++) o->L[i + k * m] = o->M[o->slow[i] + o->slow[k] * n];
    if (dense_cholesky(o->L, m, m) >= 0) return false;
    for (int k = 0; k < s; k++) {
        for (int i = 0; i < m; i++) o->W[i + k * m] = o->M[o->slow[i] + o->quicker[k] * n];
        dense_cholesky_solve(o->L, o->W + k * m, m, m);
    }
    return true;
}

static double recoiled(const struct slow *o, const double *x, int i, int m, int s)
{
    double sum = x[o->slow[i]];
    for (int k = 0; k < s; k++) sum += o->W[i + k * m] * x[o->quicker[k]];
    return sum;
}

/* e of all, with what o->fast says taken out of the others. */
static void find_slow(struct slow *o)
{
    const struct quick *q = o->quick;
    const int taken = q->samples < QUICK_SAMPLES ? q->samples : QUICK_SAMPLES;
    int m = 0, s = 0;
    for (int i = 0; i < q->n; i++) {
        o->e[i] = quick_mean_off(q, o->sim, i);
        if (o->fast[i])
            o->quicker[s++] = i;
        else
            o->slow[m++] = i;
    }
    o->m = m;
    o->s = s;
    o->recoils = s > 0 && m > 0 && taken > 0 && o->masses && find_recoil(o, m, s);
    if (!o->recoils) return;
    for (int i = 0; i < m; i++) {
        double sum = 0, time = 0;
        for (int k = 0; k < taken; k++) {
            const struct quick_sample *at = &q->sample[k];
            sum += at->h * quick_off(q, o->sim, o->slow[i], recoiled(o, at->j, i, m, s), recoiled(o, at->k, i, m, s));
            time += at->h;
        }
        o->e[o->slow[i]] = sum / time;
    }
}

/* Squares of the third and of the fourth derivative of coordinate i of the slow or of the fast ones. */
static void squares(double *third, double *fourth, const struct slow *o, int i, bool fast)
{
    const struct quick *q = o->quick;
    const int taken = q->samples < QUICK_SAMPLES ? q->samples : QUICK_SAMPLES;
    double time = 0;
    *third = *fourth = 0;
    for (int n = 0; n < taken; n++) {
        const struct quick_sample *at = &q->sample[n];
        const bool plain = fast || !o->recoils;
        const int place = fast ? o->quicker[i] : o->slow[i];
        const double j = plain ? at->j[place] : recoiled(o, at->j, i, o->m, o->s);
        const double k = plain ? at->k[place] : recoiled(o, at->k, i, o->m, o->s);
        time += at->h;
        *third += at->h * j * j;
        *fourth += at->h * k * k;
    }
    *third /= time;
    *fourth /= time;
}

/* Of a vibration five midpoint steps in one leave .00093 z^4 of a radian where one leaves z^2/12, z = omega h; none of one
 * that is smaller than what may be missed: of usual changes, and of usual changes a second where none are faster.  What
 * stands on stiff bearings is not asked to be followed in its own velocities. */
static double fourth_of(const struct slow *o, int i, bool fast)
{
    static const double PART = .0112, SMALL = .25;
    const int place = fast ? o->quicker[i] : o->slow[i];
    const struct stepper *s = &o->sim->stepper;
    double j2, k2;
    squares(&j2, &k2, o, i, fast);
    if (!(j2 > 0 && k2 > 0)) return 0;
    const double w = sqrt(k2 / j2), v = sqrt(j2) / (w * w);
    const double small = SMALL * s->options.tolerance * ode2_usual(s->ode, place);
    const bool seen = v > small * fmax(1, o->quick->top[place]) || v / w > small;
    return seen ? PART * w * w * o->e[place] : 0;
}

static void find_fourth(const struct slow *o, double *e)
{
    e[0] = e[1] = 0;
    if (o->quick->samples == 0) return;
    for (int i = 0; i < o->s; i++) e[0] = fmax(e[0], fourth_of(o, i, true));
    for (int i = 0; i < o->m; i++) e[1] = fmax(e[1], fourth_of(o, i, false));
}

static double largest(const double *e, const int *iv, int n)
{
    double most = -1; /* all of them follow others */
    for (int k = 0; k < n; k++) most = fmax(most, e[iv[k]]);
    return most;
}

/* Modes of higher frequency are as fast as those of lower. */
static void raise_modes(struct part *part, int n, const struct flex_body *flex)
{
    const double *hertz = flex ? flex->hertz : NULL;
    for (int i = 0; i < n; i++)
        for (int k = 0; k < n; k++) {
            const bool lower = hertz ? hertz[part[k].mode] < hertz[part[i].mode] : k < i;
            if (lower) part[i].e = fmax(part[i].e, part[k].e);
        }
}

/* All that move on their own, by what they are off by, the quickest first. */
static int find_parts(struct part *part, const struct slow *o, struct arena *scratch)
{
    const struct model *m = o->sim->model;
    double *e = TAKE(scratch, double, m->n);
    int n = 0;
    for (int i = 0; i < m->n; i++) e[i] = -1;
    for (int i = 0; i < o->quick->n; i++) e[system_place(o->sim->system, i)] = o->e[i];
    for (int i = 0; i < m->njoint; i++) {
        const struct model_body *b = &m->body[m->joint[i].child];
        const double own = largest(e, m->joint[i].iv, m->joint[i].nv);
        const int first = n + (own >= 0);
        if (own >= 0) part[n++] = (struct part){own, i, -1};
        for (int k = 0; k < b->nmode; k++)
            if (e[b->mode_v[k]] >= 0) part[n++] = (struct part){e[b->mode_v[k]], i, k};
        raise_modes(part + first, n - first, b->flex);
    }
    qsort(part, (size_t)n, sizeof *part, by_e);
    return n;
}

/* Of the bodies, by what an evaluation of them takes, those that the first n parts move. */
static double share_of(const struct part *part, int n, const struct model *m, bool *moved)
{
    static const double A_MODE = 2;
    double all = 0, some = 0;
    memset(moved, 0, sizeof *moved * (size_t)m->nbody);
    for (int i = 0; i < n; i++) moved[m->joint[part[i].joint].child] = true;
    for (int i = 1; i < m->nbody; i++) { /* parents come first */
        const double weight = m->body[i].at_node ? 0 : 1 + A_MODE * m->body[i].nmode;
        moved[i] |= m->body[i].parent >= 0 && moved[m->body[i].parent];
        all += weight;
        some += moved[i] ? weight : 0;
    }
    return all > 0 ? some / all : 1;
}

static void keep_best(struct quick_cut *cut, int *n, struct quick_cut one)
{
    int at = *n;
    while (at > 0 && cut[at - 1].gain < one.gain) at--;
    if (at >= QUICK_CUTS) return;
    if (*n < QUICK_CUTS) ++*n;
    memmove(cut + at + 1, cut + at, sizeof *cut * (size_t)(*n - 1 - at));
    cut[at] = one;
}

static double gain_of(double share, double apart)
{
    return 1 / (OVER * (share + (1 - share) / apart));
}

/* The parts by their names in the deck; false: one has none. */
static bool name_parts(struct quick_cut *cut, const struct part *part, const struct sim *sim, struct arena *life)
{
    const struct model *m = sim->model;
    const struct scene *scene = sim->scene;
    cut->fast = TAKE(life, struct scene_choice, cut->n);
    for (int i = 0; i < cut->n; i++) {
        struct scene_choice *c = &cut->fast[i];
        const struct model_joint *j = &m->joint[part[i].joint];
        const char *name = part[i].mode < 0 ? j->name : m->body[j->child].name;
        *c = (struct scene_choice){scene->integrate.node, -1, part[i].mode, 0};
        if (part[i].mode < 0) c->joint = scene_find_joint(scene, name, strlen(name));
        if (part[i].mode >= 0) c->body = scene_find_body(scene, name, strlen(name));
        if (part[i].mode < 0 ? c->joint < 0 : c->body < 0) return false;
    }
    return true;
}

static bool same_part(const struct part *a, const struct part *b)
{
    return a->joint == b->joint && a->mode == b->mode;
}

/* Is the state's rate i of the part? */
static bool is_of(const struct part *part, const struct sim *sim, int i)
{
    const struct model *m = sim->model;
    const struct model_joint *j = &m->joint[part->joint];
    const int place = system_place(sim->system, i);
    if (part->mode >= 0) return m->body[j->child].mode_v[part->mode] == place;
    for (int k = 0; k < j->nv; k++)
        if (j->iv[k] == place) return true;
    return false;
}

/* The quickest of all that is not among the first n goes there; false: all are. */
static bool take_next(struct part *taken, int n, struct slow *o, struct part *all, struct arena *scratch)
{
    const int count = find_parts(all, o, scratch);
    int found = 0;
    for (int k = 0; found < count && k < n; k++)
        if (same_part(&all[found], &taken[k])) k = -1, found++;
    if (found == count) return false;
    taken[n] = all[found];
    for (int i = 0; i < o->quick->n; i++) o->fast[i] |= is_of(&taken[n], o->sim, i);
    return true;
}

int quick_cuts(struct quick_cut *cut, const struct quick *o, struct sim *sim, struct arena *life)
{
    enum { MOST_PARTS = 24 };
    struct arena *scratch = arena_open();
    struct quick_cut best[QUICK_CUTS + 1];
    struct part taken[MOST_PARTS], *all = TAKE(scratch, struct part, sim->model->njoint + sim->model->n);
    bool *moved = TAKE(scratch, bool, sim->model->nbody);
    struct slow slow;
    int found = 0, named = 0;
    double rest, top = 0;
    open_slow(&slow, o, sim, scratch);
    find_slow(&slow);
    for (int n = 0; n < MOST_PARTS && take_next(taken, n, &slow, all, scratch); n++) {
        find_slow(&slow);
        top = fmax(top, taken[n].e);
        rest = -1; /* of what is left, the fast ones taken out; there is nothing */
        for (int i = 0; i < o->n; i++)
            if (!slow.fast[i]) rest = fmax(rest, slow.e[i]);
        if (rest < 0) break;
        struct quick_cut one = {.n = n + 1, .apart = sqrt(top / fmax(rest, 1e-6 * top))};
        if (!(top > 0) || one.apart < APART) continue;
        one.share = share_of(taken, n + 1, sim->model, moved);
        one.gain = gain_of(one.share, one.apart);
        if (one.gain >= GAIN) find_fourth(&slow, one.fourth), keep_best(best, &found, one);
    }
    for (int i = 0; i < found; i++)
        if (name_parts(&best[i], taken, sim, life)) cut[named++] = best[i];
    arena_close(scratch);
    return named;
}

double quick_apart(const struct quick *o, struct sim *sim, double *fourth)
{
    struct arena *scratch = arena_open();
    struct slow slow;
    double fast = 0, rest = 0;
    open_slow(&slow, o, sim, scratch);
    for (int i = 0; i < sim->stepper.ode->ns; i++) slow.fast[i] = true;
    find_slow(&slow);
    for (int i = 0; i < o->n; i++)
        if (slow.fast[i])
            fast = fmax(fast, slow.e[i]);
        else
            rest = fmax(rest, slow.e[i]);
    if (fourth) find_fourth(&slow, fourth);
    arena_close(scratch);
    return rest > 0 ? sqrt(fast / rest) : 1e3;
}
