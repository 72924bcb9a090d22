/* predict.c -- see predict.h */
#include "engine/predict.h"

#include <math.h>
#include <string.h>

#include "engine/motion.h"

/* Other values of each: evaluations in the mean of the twelve decks of predict.h, and the most of one, in percent. */
static const double FADE = .8;   /* weight of the misses before; .6: +0.1 (cantilever +0.5), .9: -0.1 (crank -1.1) */
static const double WORTH = 1.5; /* square of what the drift must make the worst miss smaller by; 3: +0.3 (crank +3.3),
                                  * 1: -1.0 (axle -8.8) for a product and a solution in each step */
enum {
    TRIED = 8, /* steps until that is judged; half: 0 (crank +0.2), twice: 0 (axle -0.4) */
    REST = 32  /* and steps that it is not asked for, then; half: -0.4 (axle -3.7), twice: -0.1 (axle -2.9) */
};

void predict_open(struct predict *p, int n, struct arena *life)
{
    *p = (struct predict){.n = n};
    p->course = TAKE(life, struct course, n);
    p->drift = TAKE(life, double, n);
    p->v = TAKE(life, double, n);
}

void predict_forget(struct predict *p)
{
    memset(p->course, 0, sizeof *p->course * (size_t)p->n);
    p->h = 0;
    p->seen = p->rest = 0;
}

void predict_recall(struct predict *p, struct recall *r)
{
    recall_within(r, "predict");
    fits_recall(&p->course->plain, r, "plain", p->n, sizeof *p->course);
    fits_recall(&p->course->model, r, "model", p->n, sizeof *p->course);
    recall_each(r, "miss_plain", p->course, miss_plain, p->n);
    recall_each(r, "miss_model", p->course, miss_model, p->n);
    recall_one(r, "seen", p->seen);
    recall_one(r, "rest", p->rest);
    recall_one(r, "h", p->h);
    recall_without(r);
}

/* The drift, unless it rests: after that the past of g is a past no more. */
static int ask(struct predict *p, struct broyden *J, double h, const double *a0)
{
    if (p->rest > 0) {
        if (--p->rest > 0) return 0;
        for (int i = 0; i < p->n; i++) {
            p->course[i].model = (struct fit){0};
            p->course[i].miss_model = p->course[i].miss_plain = 0;
        }
    }
    return J && broyden_drift(J, p->drift, h, p->v, a0);
}

void predict_make(struct predict *p, double *a1, struct broyden *J, double h, const double *v0, const double *a0,
                  double ahead)
{
    double s = p->h > 0 ? h / p->h : 0;
    for (int i = 0; i < p->n; i++) p->v[i] = v0[i] + ahead * a0[i];
    p->modelled = ask(p, J, h, a0);
    for (int i = 0; i < p->n; i++) {
        struct course *c = &p->course[i];
        double da = c->foreseen_plain = s * fit_next(&c->plain);
        if (p->modelled) {
            c->foreseen_model = s * fit_next(&c->model) - p->drift[i];
            if (c->miss_model < c->miss_plain) da = c->foreseen_model;
        }
        a1[i] = a0[i] + da;
    }
}

double predict_error(const struct predict *p, double h, const double *per)
{
    double worst = 0, s = p->h > 0 ? h / p->h : 0;
    for (int i = 0; i < p->n; i++) {
        double e = fabs(p->course[i].plain.last) * per[i];
        if (e > worst) worst = e;
    }
    return fabs(h / 12 * s) * worst;
}

static double faded(double sum, double miss)
{
    return FADE * sum + miss * miss;
}

void predict_keep(struct predict *p, const double *a1, const double *a0, double h, const double *per)
{
    double plain = 0, best = 0;
    for (int i = 0; i < p->n; i++) {
        struct course *c = &p->course[i];
        double da = a1[i] - a0[i], unit = per[i] * per[i];
        fit_learn(&c->plain, da);
        if (!p->modelled) continue;
        fit_learn(&c->model, da + p->drift[i]);
        c->miss_plain = faded(c->miss_plain, da - c->foreseen_plain);
        c->miss_model = faded(c->miss_model, da - c->foreseen_model);
        double miss = c->miss_model < c->miss_plain ? c->miss_model : c->miss_plain;
        if (unit * c->miss_plain > plain) plain = unit * c->miss_plain;
        if (unit * miss > best) best = unit * miss;
    }
    p->h = h;
    p->seen = p->modelled ? p->seen + 1 : 0;
    if (p->seen >= TRIED && plain < WORTH * best) p->rest = REST;
}
