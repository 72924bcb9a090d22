/* unilateral.h -- the parameters of a spring that only pushes: for who makes one without a deck's keys. */
#ifndef FMDSUB_KIND_UNILATERAL_H
#define FMDSUB_KIND_UNILATERAL_H

enum { UNILATERAL_ABOVE, UNILATERAL_BELOW };

struct unilateral {
    double k;    /* [N/m^n] or [N m/rad^n] */
    double from; /* where it begins [m] or [rad] */
    double c;    /* [N s/m] or [N m s/rad] */
    double loss; /* of the push, per rate [s/m] or [s/rad] */
    int side;    /* UNILATERAL_... */
    int root;    /* 1: n is 1.5; 0: 1 */
};

/* The whole push of the spring and its damper at s, s' = v; 0 where it is open [N]. */
double unilateral_push(const struct unilateral *p, double s, double v);
/* Of the spring alone: its energy [J], how fast its push grows with depth [N/m], its mean push from s0 to s1 and minus twice
 * the change of that with s1, as in kind/force.h. */
double unilateral_energy(const struct unilateral *p, double s);
double unilateral_slope(const struct unilateral *p, double s);
double unilateral_mean_push(double *ks, const struct unilateral *p, double s0, double s1);

/* The same where it is free to pull, and beyond where it begins the damper alone; *at_once: the damper's part [N]. */
double unilateral_whole(double *at_once, const struct unilateral *p, double s, double v);

/* How fast the whole push grows with the rate of the depth, as long as it does not pull [N s/m]. */
double unilateral_resistance(const struct unilateral *p, double s);
/* The loss of one that leaves at e times the speed v at which it came, 0 < e <= 1, of any exponent. */
double unilateral_loss(double e, double v);

#endif
