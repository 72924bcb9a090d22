/* renewal.c -- see renewal.h */
#include "engine/renewal.h"

#include <math.h>

static const double MOST = 30;     /* iterations that a step is counted for */
static const double LEAST = .7;    /* halvings by which corrections fall, at least */
static const double PATIENCE = 64; /* at most */
static const double HOPE = .005;   /* of the iterations above one, a step */

void renewal_forget(struct renewal *o, double price)
{
    *o = (struct renewal){.price = price, .patience = 1};
}

static double lg(double x)
{
    int e;
    double m = frexp(x, &e);
    return e + 2 * (m - 1);
}

double renewal_need(double first, double tolerance, double fall, int count)
{
    if (count < 2 || first <= tolerance) return 1;
    return fmin(MOST, 1 + lg(first / tolerance) * (count - 1) / fmax(LEAST, lg(fall)));
}

/* Has it brought back its price over the life of the matrix before? */
static void judge(struct renewal *o, double need)
{
    if (o->waited == 0) return;
    const int paid = (o->lately - need) * o->waited > o->price;
    o->patience = paid ? fmax(1, o->patience / 2) : fmin(PATIENCE, o->patience * 2);
}

int renewal_due(struct renewal *o, double need, int fresh)
{
    if (fresh) {
        judge(o, need);
        o->lately = need;
        o->waited = 0;
        o->need = o->need > 0 ? (o->need + need) / 2 : need;
        o->wasted = 0;
        return 0;
    }
    if (o->need == 0) o->need = need;
    o->waited++;
    o->lately += (need - o->lately) / 2;
    o->wasted = fmax(0, o->wasted + need - o->need);
    o->need -= HOPE * (o->need - 1);
    return o->wasted > o->price * o->patience;
}
