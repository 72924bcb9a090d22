/* turned.c -- see turned.h */
#include "la/turned.h"

#include <math.h>

void turned_far(double x, double *s, double *c)
{
    sincos(x, s, c);
}
