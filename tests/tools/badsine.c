/* badsine.c -- a library of mathematics whose sine is off by a millionth, to be put before the C library's (LD_PRELOAD). */
#include <dlfcn.h>
#include <math.h>

double sin(double x)
{
    static double (*right)(double);
    if (!right) *(void **)&right = dlsym(RTLD_NEXT, "sin");
    return right(x) * (1 + 1e-6);
}

void sincos(double x, double *s, double *c)
{
    static void (*right)(double, double *, double *);
    if (!right) *(void **)&right = dlsym(RTLD_NEXT, "sincos");
    right(x, s, c);
    *s *= 1 + 1e-6;
}
