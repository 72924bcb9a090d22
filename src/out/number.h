/* number.h -- a double as text.
 *
 * number_write gives the shortest text that reads back to the same double, and of all such texts
 * the one nearest to it (Schubfach: R. Giulietti, "The Schubfach way to render doubles", 2020).
 * Plain for 1e-5 <= |x| < 1e17, else with an exponent; a whole number has no point:
 *
 *     0.1   -2.5   3   123456789   0.00001   1e-6   2.5e-7   1e+17   -0   5e-324
 *
 * Valid in JSON, C, YAML 1.2 and every CSV reader met so far; no locale enters. */
#ifndef FMDSUB_OUT_NUMBER_H
#define FMDSUB_OUT_NUMBER_H

enum { NUMBER_MOST = 27 }; /* bytes that a number may take while it is written */

/* Writes x, without a 0 after it; returns its length, 0 where x is not finite and has no text.  -0 keeps its sign.  All of
 * NUMBER_MOST bytes may be written. */
int number_write(char *to, double x);

/* So x [n], a comma behind each, nothing for one that is not finite; returns the end.  No more than n (NUMBER_MOST + 1)
 * bytes. */
char *number_list(char *to, const double *x, int n);

/* The same form of a finite number for people: rounded to `digits` (1..17) significant digits, last zeros dropped. */
int number_round(char *to, double x, int digits);

#endif
