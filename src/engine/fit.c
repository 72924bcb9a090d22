/* fit.c -- see fit.h */
#include "engine/fit.h"

void fits_recall(struct fit *o, struct recall *r, const char *name, int n, size_t stride)
{
    const size_t many = (size_t)n;
    recall_within(r, name);
    recall_doubles(r, "s11", &o->s11, many, stride);
    recall_doubles(r, "s12", &o->s12, many, stride);
    recall_doubles(r, "s22", &o->s22, many, stride);
    recall_doubles(r, "s01", &o->s01, many, stride);
    recall_doubles(r, "s02", &o->s02, many, stride);
    recall_doubles(r, "last", &o->last, many, stride);
    recall_doubles(r, "before", &o->before, many, stride);
    recall_ints(r, "terms", &o->terms, many, stride);
    recall_without(r);
}
