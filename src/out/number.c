/* number.c -- shortest text of a double by Schubfach; see number.h
 *
 * x = c 2^q.  The reals that read back as x are those between its neighbours' midpoints,
 * R = [cl, cr] 2^(q-2) with cl = 4c - 2 (4c - 1 above a power of two), cr = 4c + 2, the ends
 * included when c is even (round half to even).  With k = floor(log10 |R|) there are at least one
 * and at most ten multiples of 10^k in R, and at most one of 10^(k+1): if there is one of the latter
 * it is the answer, else the nearer of the two multiples of 10^k around x that lie in R.
 *
 * The products 4c 2^(q-2) 10^-k need only be known up to "below, at, above" a multiple of 1/4:
 * rounding them to odd keeps that, and 128 bits of 10^-k are enough for every double (proved there).
 * The constants 1262611/2^22 = log10 2, 524031/2^22 = -log10 3/4 and
 * 1741647/2^19 = log2 10 give exact floors over the range of q and k used here.
 */
#include "out/number.h"

#include <assert.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "out/pow10.h"

__extension__ typedef unsigned __int128 wide;

struct decimal {
    uint64_t digits; /* below 10^17 */
    int exponent;    /* x = digits 10^exponent */
};

/* g c 2^-128 rounded to odd: the last bit is set when anything was cut off.  g is less than one unit
 * above the true power: an exact product leaves 0 or 1 in the low word, any other more. */
static uint64_t times(const uint64_t g[2], uint64_t c)
{
    wide low = (wide)g[1] * c;
    wide high = (wide)g[0] * c + (uint64_t)(low >> 64);
    return (uint64_t)(high >> 64) | ((uint64_t)high > 1);
}

/* c 2^q, c > 0; narrow: the neighbour below is half as far away as the one above. */
static struct decimal shortest(uint64_t c, int q, bool narrow)
{
    int k = (q * 1262611 - (narrow ? 524031 : 0)) >> 22;
    int h = q + ((-k * 1741647) >> 19) + 1;
    const uint64_t *g = pow10_table[-k - POW10_FIRST];
    uint64_t open = c & 1;
    uint64_t lower = times(g, (4 * c - 2 + narrow) << h) + open;
    uint64_t v = times(g, 4 * c << h); /* 4 x 10^-k */
    uint64_t upper = times(g, (4 * c + 2) << h) - open;

    uint64_t s = v / 4, tens = s / 10;
    bool below = lower <= 40 * tens, above = 40 * tens + 40 <= upper;
    if (below != above) return (struct decimal){tens + above, k + 1};
    below = lower <= 4 * s;
    above = 4 * s + 4 <= upper;
    if (below != above) return (struct decimal){s + above, k};
    uint64_t middle = 4 * s + 2;
    return (struct decimal){s + (v > middle || (v == middle && (s & 1))), k};
}

static struct decimal decimal(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    uint64_t fraction = bits & ((UINT64_C(1) << 52) - 1);
    int e = (int)(bits >> 52 & 0x7ff);
    if (e == 0) return shortest(fraction, -1074, false);
    uint64_t c = fraction | UINT64_C(1) << 52;
    int q = e - 1075;
    if (q <= 0 && q > -53 && (c & ((UINT64_C(1) << -q) - 1)) == 0) return (struct decimal){c >> -q, 0};
    return shortest(c, q, fraction == 0 && e > 1);
}

static const char pairs[201] = "00010203040506070809101112131415161718192021222324252627282930313233343536373839"
                               "40414243444546474849505152535455565758596061626364656667686970717273747576777879"
                               "8081828384858687888990919293949596979899";

/* The digits of u to the left of end; returns where they start. */
static char *put_digits(char *end, uint64_t u)
{
    if (u >= 100000000) {
        uint32_t low = (uint32_t)(u % 100000000);
        u /= 100000000;
        memcpy(end - 2, pairs + 2 * (low % 100), 2);
        memcpy(end - 4, pairs + 2 * (low / 100 % 100), 2);
        memcpy(end - 6, pairs + 2 * (low / 10000 % 100), 2);
        memcpy(end - 8, pairs + 2 * (low / 1000000), 2);
        end -= 8;
    }
    uint32_t rest = (uint32_t)u;
    for (; rest >= 100; rest /= 100) memcpy(end -= 2, pairs + 2 * (rest % 100), 2);
    if (rest < 10) {
        *--end = (char)('0' + rest);
        return end;
    }
    return memcpy(end - 2, pairs + 2 * rest, 2);
}

static char *put(char *to, const char *from, int n)
{
    memcpy(to, from, (size_t)n);
    return to + n;
}

static char *put_zeros(char *to, int n)
{
    memset(to, '0', (size_t)n);
    return to + n;
}

/* d[0].d[1]...d[n-1] times 10^e */
static char *put_decimal(char *to, const char *d, int n, int e)
{
    if (e < -5 || e >= 17) {
        *to++ = d[0];
        if (n > 1) *to++ = '.';
        to = put(to, d + 1, n - 1);
        *to++ = 'e';
        *to++ = e < 0 ? '-' : '+';
        char text[4], *end = text + sizeof text, *from = put_digits(end, (uint64_t)(e < 0 ? -e : e));
        return put(to, from, (int)(end - from));
    }
    if (e < 0) return put(put_zeros(put(to, "0.", 2), -e - 1), d, n);
    if (n <= e + 1) return put_zeros(put(to, d, n), e + 1 - n);
    to = put(to, d, e + 1);
    *to++ = '.';
    return put(to, d + e + 1, n - e - 1);
}

static int significant(const char *d, int n)
{
    while (n > 1 && d[n - 1] == '0') n--;
    return n;
}

/* Sign and zero, the same for both forms: returns where the digits go, NULL when x is zero. */
static char *put_sign(char *to, int *length, double x)
{
    assert(isfinite(x));
    *length = 0;
    if (signbit(x)) to[(*length)++] = '-';
    if (x != 0) return to + *length;
    to[(*length)++] = '0';
    return NULL;
}

int number_write(char *to, double x)
{
    int length;
    char *place = put_sign(to, &length, x);
    if (!place) return length;
    struct decimal d = decimal(fabs(x));
    char text[20], *end = text + sizeof text, *from = put_digits(end, d.digits);
    int n = (int)(end - from);
    return (int)(put_decimal(place, from, significant(from, n), n - 1 + d.exponent) - to);
}

/* printf rounds correctly from the exact value; only its digits and its exponent are taken, so that
 * the decimal point of a locale does not matter. */
int number_round(char *to, double x, int digits)
{
    assert(digits >= 1 && digits <= 17);
    int length;
    char *place = put_sign(to, &length, x);
    if (!place) return length;
    char text[64], d[17];
    snprintf(text, sizeof text, "%.*e", digits - 1, fabs(x));
    int n = 0, e = 0;
    const char *c = text;
    for (; *c != 'e'; c++)
        if (*c >= '0' && *c <= '9') d[n++] = *c;
    sscanf(c + 1, "%d", &e);
    return (int)(put_decimal(place, d, significant(d, n), e) - to);
}
