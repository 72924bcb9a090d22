/* predict.c -- see predict.h */
#include "engine/predict.h"

#include <math.h>

#include "base/scalar.h"
#include "engine/motion.h"
#include "la/wide.h"

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
    double **list[] = {&p->drift, &p->v, &p->da, &p->as_plain, &p->as_model, &p->miss_plain, &p->miss_model};
    *p = (struct predict){.n = n, .room = fit_room(n)};
    fit_row_open(&p->plain, n, life);
    fit_row_open(&p->model, n, life);
    for (size_t k = 0; k < sizeof list / sizeof *list; k++) *list[k] = TAKE(life, double, p->room);
}

static void forget_model(struct predict *p)
{
    fit_row_forget(&p->model);
    zero(p->miss_plain, p->room);
    zero(p->miss_model, p->room);
}

void predict_forget(struct predict *p)
{
    fit_row_forget(&p->plain);
    forget_model(p);
    p->h = 0;
    p->seen = p->rest = 0;
}

void predict_recall(struct predict *p, struct recall *r)
{
    recall_within(r, "predict");
    fit_row_recall(&p->plain, r, "plain", p->n);
    fit_row_recall(&p->model, r, "model", p->n);
    recall_list(r, "miss_plain", p->miss_plain, p->n);
    recall_list(r, "miss_model", p->miss_model, p->n);
    recall_one(r, "seen", p->seen);
    recall_one(r, "rest", p->rest);
    recall_one(r, "h", p->h);
    recall_without(r);
}

/* The drift, unless it rests: after that the past of g is a past no more. */
static int ask(struct predict *p, struct broyden *J, double h, const double *v0, const double *a0, double ahead)
{
    if (p->rest > 0) {
        if (--p->rest > 0) return 0;
        forget_model(p);
    }
    if (!J || J->J.nlive == 0) return 0;
    for (int i = 0; i < p->n; i++) p->v[i] = v0[i] + ahead * a0[i];
    return broyden_drift(J, p->drift, h, p->v, a0);
}

/* The model's and, of each coordinate, the one that has been closer. */
WIDE static void closer(double *restrict da, double *restrict model, const double *restrict plain,
                        const double *restrict drift, const double *restrict miss_plain,
                        const double *restrict miss_model, double s, int n)
{
    for (int i = 0; i < n; i++) {
        model[i] = s * model[i] - drift[i];
        da[i] = miss_model[i] < miss_plain[i] ? model[i] : plain[i];
    }
}

void predict_make(struct predict *p, double *a1, struct broyden *J, double h, const double *v0, const double *a0,
                  double ahead)
{
    const double s = p->h > 0 ? h / p->h : 0;
    p->modelled = ask(p, J, h, v0, a0, ahead);
    fit_row_next(&p->plain, p->as_plain);
    for (int i = 0; i < p->n; i++) p->da[i] = p->as_plain[i] *= s;
    if (p->modelled) {
        fit_row_next(&p->model, p->as_model);
        closer(p->da, p->as_model, p->as_plain, p->drift, p->miss_plain, p->miss_model, s, p->room);
    }
    for (int i = 0; i < p->n; i++) a1[i] = a0[i] + p->da[i];
}

double predict_error(const struct predict *p, double h, const double *per)
{
    double worst = 0, s = p->h > 0 ? h / p->h : 0;
    for (int i = 0; i < p->n; i++) {
        double e = fabs(p->plain.last[i]) * per[i];
        if (e > worst) worst = e;
    }
    return fabs(h / 12 * s) * worst;
}

/* FADE miss + (da - said)^2 of both, and g = da + drift into `drift`. */
WIDE static void miss(double *restrict miss_plain, double *restrict miss_model, double *restrict drift,
                      const double *restrict da, const double *restrict plain, const double *restrict model, int n)
{
    for (int i = 0; i < n; i++) {
        const double a = da[i] - plain[i], b = da[i] - model[i];
        miss_plain[i] = FADE * miss_plain[i] + a * a;
        miss_model[i] = FADE * miss_model[i] + b * b;
        drift[i] = da[i] + drift[i];
    }
}

/* Is what the model saves of the worst miss too little? */
static bool saves_little(const struct predict *p, const double *per)
{
    double plain = 0, best = 0;
    for (int i = 0; i < p->n; i++) {
        const double unit = per[i] * per[i], x = unit * p->miss_plain[i], y = unit * p->miss_model[i];
        plain = larger(plain, x);
        best = larger(best, smaller(x, y));
    }
    return plain < WORTH * best;
}

void predict_keep(struct predict *p, const double *a1, const double *a0, double h, const double *per)
{
    for (int i = 0; i < p->n; i++) p->da[i] = a1[i] - a0[i];
    fit_row_learn(&p->plain, p->da);
    if (p->modelled) {
        miss(p->miss_plain, p->miss_model, p->drift, p->da, p->as_plain, p->as_model, p->room);
        fit_row_learn(&p->model, p->drift);
    }
    p->h = h;
    p->seen = p->modelled ? p->seen + 1 : 0;
    if (p->seen >= TRIED && saves_little(p, per)) p->rest = REST;
}
