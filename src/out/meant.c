/* meant.c -- see meant.h */
#include "out/meant.h"

#include <ctype.h>
#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include "out/number.h"

/* Numbers up to here, and powers of ten up to 22, are doubles themselves. */
static const double MOST_DIGITS = 1e15;
enum { MOST_POWER = 22 };

/* x = p/q: what p/q is more than the double. */
static double missed(double x, double p, double q)
{
    return fma(-x, q, p) / q;
}

/* x > 0 as a decimal p/q, q a power of ten; false: it takes more digits. */
static bool decimal(double *p, double *q, double x)
{
    char text[NUMBER_MOST + 1];
    int behind = 0, power = 0;
    bool point = false;
    *p = 0;
    text[number_write(text, x)] = 0;
    for (const char *c = text; *c; c++) {
        if (*c == 'e') {
            power = atoi(c + 1);
            break;
        }
        if (*c == '.') point = true;
        if (!isdigit((unsigned char)*c)) continue;
        *p = 10 * *p + (*c - '0');
        if (*p >= MOST_DIGITS) return false;
        behind += point;
    }
    power -= behind;
    if (abs(power) > MOST_POWER) return false;
    *q = 1;
    for (int i = 0; i < abs(power); i++) *q *= 10;
    return power <= 0 || *q == 1; /* whole numbers are what they are */
}

/* x > 0 as a fraction of whole numbers so small that this is no accident. */
static bool fraction(double *p, double *q, double x)
{
    static const double SMALL = 1e8; /* p q */
    double rest = x, p0 = 1, q0 = 0;
    *p = floor(x);
    *q = 1;
    while (*p * *q < SMALL && *p / *q != x) {
        rest = 1 / (rest - floor(rest));
        if (!(rest < SMALL)) return false;
        const double a = floor(rest), p1 = a * *p + p0, q1 = a * *q + q0;
        p0 = *p;
        q0 = *q;
        *p = p1;
        *q = q1;
    }
    return *p / *q == x && *p * *q < SMALL;
}

struct meant meant_by(double x)
{
    const double size = fabs(x), sign = x < 0 ? -1 : 1;
    double p, q;
    if (!(size > 0 && size < INFINITY) || !(decimal(&p, &q, size) || fraction(&p, &q, size)))
        return (struct meant){x, 0, x, 1};
    return (struct meant){x, sign * missed(size, p, q), sign * p, q};
}

double meant_sum(const struct meant *a, double n, const struct meant *b)
{
    const double y = n * b->x, y_rest = fma(n, b->x, -y) + n * b->rest;
    const double sum = a->x + y, part = sum - a->x, sum_rest = (a->x - (sum - part)) + (y - part);
    return sum + (sum_rest + (y_rest + a->rest));
}
