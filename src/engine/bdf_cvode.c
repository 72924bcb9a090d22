/* bdf_cvode.c -- what CVODE calls, and CVODE called; see bdf.c */
#include "engine/motion.h"
#include "engine/works.h"

#ifdef CVODE
#include <cvode/cvode_ls.h>

#include "base/scalar.h"
#include "engine/bdf.h"

/* ---- what CVODE calls: 0, above 0 where a shorter step may help, below 0 to end -------------------------------- */

static int told(struct bdf *x, enum status status)
{
    x->status = status;
    return status == OK ? 0 : status == E_NUMERIC ? 1 : -1;
}

static void place(struct bdf *x, double t, const double *u)
{
    for (int i = 0; i < x->n; i++) x->u[i] = u[i] - x->start[i];
    x->t = t;
    motion_onward(x->stepper->ode, x->q, x->base, x->u, 1, t, 0);
}

/* y' at t, y. */
enum status bdf_evaluate(struct bdf *x, double t, const double *y, double *rate)
{
    const struct ode2 *o = x->stepper->ode;
    const int n = x->n;
    double w[POWER_CHANNELS];
    place(x, t, y);
    motion_rate(o, rate, x->q, x->base, x->u, y + n, t);
    TRY(accel_solve(x->stepper->accel, rate + n, w, x->q, y + n, t, &x->why));
    copy(rate + 2 * n, w, x->channels);
    for (int i = 0; i < 2 * n + x->channels; i++)
        if (!isfinite(rate[i])) return trouble_set(&x->why, TROUBLE_NOT_FINITE, i % n, rate[i], t);
    return OK;
}

static int slopes(double t, N_Vector y, N_Vector rate, void *self)
{
    struct bdf *x = self;
    return told(x, bdf_evaluate(x, t, bdf_values(y), bdf_values(rate)));
}

/* Weights of errors; rms over the motion, and the works' besides. */
static int weigh(N_Vector y, N_Vector weights, void *self)
{
    static const double ROUND_OFF = 1e-13, ROUND_OFF_OF_WORKS = 1e-12;
    struct bdf *x = self;
    struct adaptive *m = x->motion;
    const int n = x->n, all = 2 * n + x->channels;
    const double share = larger(1. / ((double)x->steps + 10), ROUND_OFF / m->tolerance);
    const double of_motion = sqrt(all / (2. * n)) / share, *now = bdf_values(y);
    double *w = bdf_values(weights), done = 0;
    for (int i = 0; i < n; i++) {
        w[i] = of_motion / adaptive_scale_q(x->stepper, i);
        w[n + i] = of_motion / adaptive_scale_v(x->stepper, i);
    }
    for (int c = 0; c < x->channels; c++) done += fabs(now[2 * n + c] - x->y0[2 * n + c]);
    const double scale = works_scale(x->stepper, x->t1) + done;
    for (int c = 2 * n; c < all; c++)
        w[c] = scale > 0 ? sqrt(all) / (larger(share * m->tolerance, ROUND_OFF_OF_WORKS) * scale) : 0;
    return 0;
}

static enum status renew(struct bdf *x, double t, const double *y, const double *rate)
{
    place(x, t, y);
    const struct instant there = {.t = t, .q = x->q, .v = y + x->n, .a = rate + x->n, .ta = t, .tb = t};
    return stage_matrix_form(&x->matrix, &there, &x->why);
}

static int set_up(double t, N_Vector y, N_Vector rate, SUNMatrix shell, int kept, int *renewed, double gamma,
                  void *self, N_Vector a, N_Vector b, N_Vector c)
{
    struct bdf *x = self;
    enum status status = OK;
    (void)shell, (void)a, (void)b, (void)c;
    *renewed = !kept;
    if (!kept) status = renew(x, t, bdf_values(y), bdf_values(rate));
    if (status == OK) status = stage_matrix_factor(&x->matrix, gamma, t, &x->why);
    x->gamma = gamma;
    return told(x, status);
}

static int solve(SUNLinearSolver solver, SUNMatrix shell, N_Vector to, N_Vector from, double tolerance)
{
    struct bdf *x = solver->content;
    const struct ode2 *o = x->stepper->ode;
    const int n = x->n;
    double *dx = bdf_values(to), *b = bdf_values(from);
    (void)shell, (void)tolerance;
    stage_matrix_error(&x->matrix, x->x, b, b + n);
    motion_rate(o, dx, x->q, x->base, x->u, x->x, x->t);
    for (int i = 0; i < n; i++) dx[i] = b[i] + x->gamma * dx[i];
    copy(dx + n, x->x, n);
    copy(dx + 2 * n, b + 2 * n, x->channels);
    return 0;
}

static SUNLinearSolver_Type direct(SUNLinearSolver solver)
{
    (void)solver;
    return SUNLINEARSOLVER_DIRECT;
}

static SUNMatrix_ID custom(SUNMatrix shell)
{
    (void)shell;
    return SUNMATRIX_CUSTOM;
}

/* What it would print is told by the run in its own words. */
static void silent(int code, const char *module, const char *function, char *message, void *self)
{
    (void)code, (void)module, (void)function, (void)message, (void)self;
}

/* ---- set-up ---------------------------------------------------------------------------------------------------- */

static void release(void *self)
{
    struct bdf *x = self;
    if (x->cvode) CVodeFree(&x->cvode);
    if (x->solver) SUNLinSolFreeEmpty(x->solver);
    if (x->shell) SUNMatFreeEmpty(x->shell);
    if (x->scratch) N_VDestroy(x->scratch);
    if (x->y) N_VDestroy(x->y);
    if (x->context) SUNContext_Free(&x->context);
}

/* N_VClone() does not look whether there was memory. */
static N_Vector clone(N_Vector y)
{
    return there_or_end(N_VClone_Serial(y));
}

/* Are all of CVODE's objects there? */
static bool open_all(struct bdf *x)
{
    const int all = 2 * x->n + x->channels;
    if (SUNContext_Create(NULL, &x->context) != 0) return false;
    x->y = N_VNew_Serial(all, x->context);
    x->scratch = N_VNew_Serial(all, x->context);
    x->shell = SUNMatNewEmpty(x->context);
    x->solver = SUNLinSolNewEmpty(x->context);
    x->cvode = CVodeCreate(CV_BDF, x->context);
    if (!x->y || !x->scratch || !x->shell || !x->solver || !x->cvode) return false;
    x->y->ops->nvclone = clone;
    x->shell->ops->getid = custom;
    x->solver->ops->gettype = direct;
    x->solver->ops->solve = solve;
    x->solver->content = x;
    zero(bdf_values(x->y), all);
    CVodeSetErrHandlerFn(x->cvode, silent, NULL);
    return CVodeInit(x->cvode, slopes, 0, x->y) == 0 && CVodeSetUserData(x->cvode, x) == 0 &&
           CVodeWFtolerances(x->cvode, weigh) == 0 && CVodeSetLinearSolver(x->cvode, x->solver, x->shell) == 0 &&
           CVodeSetLinSysFn(x->cvode, set_up) == 0 && CVodeSetMaxOrd(x->cvode, x->stepper->options.most_order) == 0;
}

void bdf_open(struct bdf *x, struct arena *life)
{
    arena_defer(life, release, x);
    (void)there_or_end(open_all(x) ? x : NULL);
}

/* ---- called ---------------------------------------------------------------------------------------------------- */

/* Work since the last look. */
static void count(struct bdf *x)
{
    struct effort *e = &x->stepper->effort;
    long iterations = 0, tests = 0, solves = 0;
    (void)CVodeGetNumNonlinSolvIters(x->cvode, &iterations);
    (void)CVodeGetNumErrTestFails(x->cvode, &tests);
    (void)CVodeGetNumStepSolveFails(x->cvode, &solves);
    e->sweeps += iterations - x->iterations;
    e->rejected += tests - x->tests + solves - x->solves;
    x->iterations = iterations;
    x->tests = tests;
    x->solves = solves;
}

enum status bdf_step(struct bdf *x, double *end, double t, double h, struct trouble *why)
{
    x->status = OK;
    (void)CVodeSetStopTime(x->cvode, t + h);
    const int flag = CVode(x->cvode, t + h, x->y, end, CV_ONE_STEP);
    count(x);
    if (flag >= 0) return OK;
    x->begun = false;
    if (x->status == OK) return trouble_set(why, TROUBLE_DIVERGED, -1, INFINITY, t + h);
    *why = x->why;
    return x->status;
}

#endif
