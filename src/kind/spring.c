/* spring.c -- see spring.h */
#include "kind/spring.h"

#include <math.h>

#define ALONG "N/m or N m/rad"
#define RATE "N s/m or N m s/rad"

/* f = preload - k (s - rest) - cubic (s - rest)^3 - c v */
static void spring_law(struct law *o, const void *par, double s, double v, double t)
{
    const struct spring *p = par;
    (void)t;
    double x = s - p->rest;
    o->f = p->preload - p->k * x - p->c * v;
    o->ks = p->k;
    o->kv = p->c;
    if (p->cubic != 0) {
        o->f -= p->cubic * x * x * x;
        o->ks += 3 * p->cubic * x * x;
    }
}

/* V with -dV/ds = f at rate 0 and V(rest) = 0. */
static double spring_stored(const void *par, double s)
{
    const struct spring *p = par;
    double x = s - p->rest;
    return x * ((.5 * p->k + .25 * p->cubic * x * x) * x - p->preload);
}

/* With x0, x1 counted from rest: f = preload - (k + cubic (x0^2 + x1^2)/2) (x0 + x1)/2. */
static void spring_mean(struct law *o, const void *par, double s0, double s1)
{
    const struct spring *p = par;
    const double x0 = s0 - p->rest, x1 = s1 - p->rest;
    o->f = p->preload - .5 * (p->k + .5 * p->cubic * (x0 * x0 + x1 * x1)) * (x0 + x1);
    o->ks = p->k + .5 * p->cubic * (x0 * x0 + 2 * x0 * x1 + 3 * x1 * x1);
}

static double spring_dissipative(const void *par, double s, double v, double t)
{
    const struct spring *p = par;
    (void)s, (void)t;
    return -p->c * v;
}

static bool spring_affine(struct affine *o, const void *par)
{
    const struct spring *p = par;
    *o = (struct affine){p->k, p->c, p->rest, p->preload};
    return p->cubic == 0;
}

static void damper_law(struct law *o, const void *par, double s, double v, double t)
{
    const struct spring *p = par;
    (void)s, (void)t;
    *o = (struct law){-p->c * v, 0, p->c};
}

static bool damper_affine(struct affine *o, const void *par)
{
    const struct spring *p = par;
    *o = (struct affine){.c = p->c};
    return true;
}

static const struct key spring_keys[] = {
    PARAM_REAL(struct spring, k, "stiffness", ALONG, 0, INFINITY, KEY_REQUIRED | KEY_BELOW, NULL,
               "force per elongation"),
    PARAM_REAL(struct spring, c, "damping", RATE, 0, INFINITY, KEY_BELOW, "0", "force per rate of elongation"),
    PARAM_REAL(struct spring, rest, "rest", "m or rad", -INFINITY, INFINITY, KEY_ABOVE | KEY_BELOW | KEY_DRAWN, NULL,
               "where stiffness gives no force; default: 0, between two points their distance when drawn"),
    PARAM_REAL(struct spring, preload, "preload", "N or N m", -INFINITY, INFINITY, KEY_ABOVE | KEY_BELOW, "0",
               "force at rest, positive when it drives the measure upwards"),
    PARAM_REAL(struct spring, cubic, "cubic", "N/m3 or N m/rad3", 0, INFINITY, KEY_BELOW, "0",
               "force per elongation cubed"),
    KEYS_END};

static const struct key damper_keys[] = {
    PARAM_REAL(struct spring, c, "damping", RATE, 0, INFINITY, KEY_REQUIRED | KEY_BELOW, NULL, "force per rate"),
    KEYS_END};

const struct force_kind force_spring = {.name = "spring",
                                        .brief = "spring, with damping, preload and a cubic part",
                                        .keys = spring_keys,
                                        .size = sizeof(struct spring),
                                        .law = spring_law,
                                        .stored = spring_stored,
                                        .mean = spring_mean,
                                        .dissipative = spring_dissipative,
                                        .affine = spring_affine};

const struct force_kind force_damper = {.name = "damper",
                                        .brief = "viscous damper",
                                        .keys = damper_keys,
                                        .size = sizeof(struct spring),
                                        .law = damper_law,
                                        .dissipative = spring_dissipative,
                                        .affine = damper_affine};
