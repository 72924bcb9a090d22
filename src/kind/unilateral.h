/* unilateral.h -- the parameters of a spring that only pushes: for who makes one without a deck's keys. */
#ifndef FMDSUB_KIND_UNILATERAL_H
#define FMDSUB_KIND_UNILATERAL_H

enum { UNILATERAL_ABOVE, UNILATERAL_BELOW };

struct unilateral {
    double k;    /* [N/m^n] or [N m/rad^n] */
    double from; /* where it begins [m] or [rad] */
    double c;    /* [N s/m] or [N m s/rad] */
    int side;    /* UNILATERAL_... */
    int root;    /* 1: n is 1.5; 0: 1 */
};

/* The whole push of the spring and its damper at s, s' = v; 0 where it is open [N]. */
double unilateral_push(const struct unilateral *p, double s, double v);

#endif
