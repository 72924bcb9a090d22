/* renewal.c -- see renewal.h */
#include "engine/renewal.h"

#include <math.h>

#include "base/scalar.h"

/* Half and twice of each: evaluations in the mean of the twelve decks of renewal.h, and the most of one, in percent. */
static const double MOST = 30;   /* iterations that a step is counted for; -0.2 and 0 (whip -2.5) */
static const double LEAST = .7;  /* halvings by which corrections fall, at least; 0 and 0 */
static const double HOPE = .005; /* of the iterations above one, a step; +0.3 and -0.4 (whip +6.0 and -5.0), but 0.95
                                  * and 1.06 times the matrices; without it +6.7 (whip +36) */
static const double FADES = .99; /* of what the step after a renewal took too much: some time it is looked at again */

void renewal_forget(struct renewal *o, double price)
{
    *o = (struct renewal){.price = price};
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
    return smaller(MOST, 1 + lg(first / tolerance) * (count - 1) / larger(LEAST, lg(fall)));
}

int renewal_due(struct renewal *o, double need, int fresh)
{
    if (fresh) {
        o->need = o->need > 0 ? (o->need + need) / 2 : need;
        o->wasted = 0;
        o->age = 0;
        o->young *= FADES;
        return o->young > o->price;
    }
    if (o->need == 0) o->need = need;
    if (o->age++ == 0) {
        o->young = smaller(o->once, need - o->need);
        o->once = need - o->need;
    }
    o->wasted = larger(0, o->wasted + need - o->need);
    o->need -= HOPE * (o->need - 1);
    return o->wasted > o->price;
}

void renewal_recall(struct renewal *o, struct recall *r)
{
    recall_within(r, "renewal");
    recall_one(r, "price", o->price);
    recall_one(r, "need", o->need);
    recall_one(r, "wasted", o->wasted);
    recall_one(r, "once", o->once);
    recall_one(r, "young", o->young);
    recall_one(r, "age", o->age);
    recall_without(r);
}
