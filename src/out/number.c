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

#include "base/inline.h"
#include "out/pow10.h"

__extension__ typedef unsigned __int128 wide;

struct decimal {
    uint64_t digits; /* below 10^17 */
    int exponent;    /* x = digits 10^exponent */
};

/* g c 2^-128 rounded to odd: the last bit is set when anything was cut off.  g is less than one unit
 * above the true power: an exact product leaves 0 or 1 in the low word, any other more. */
INTO static inline uint64_t times(const uint64_t g[2], uint64_t c)
{
    wide low = (wide)g[1] * c;
    wide high = (wide)g[0] * c + (uint64_t)(low >> 64);
    return (uint64_t)(high >> 64) | ((uint64_t)high > 1);
}

/* c 2^q, c > 0; narrow: the neighbour below is half as far away as the one above. */
INTO static inline struct decimal shortest(uint64_t c, int q, bool narrow)
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

INTO static inline struct decimal decimal(double x)
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

#define TENS(n) n, 10 * (n), 100 * (n), 1000 * (n)
static const uint64_t tens[] = {TENS(UINT64_C(1)),           TENS(UINT64_C(10000)),
                                TENS(UINT64_C(100000000)),   TENS(UINT64_C(1000000000000)),
                                UINT64_C(10000000000000000), UINT64_C(100000000000000000)};

/* How many digits 0 < u < 10^17 has: 1233/2^12 is a little less than log10 2. */
static int length_of(uint64_t u)
{
    const int n = (64 - __builtin_clzll(u)) * 1233 >> 12;
    return n + (u >= tens[n]);
}

/* The eight digits of u < 10^8, the first in the lowest byte: halves, quarters and eighths side by side in one word.  The
 * quotients are exact for what is below 10^4 and below 100. */
INTO static inline uint64_t eight_digits(uint64_t u)
{
    const uint64_t high = u / 10000, four = high | (u - 10000 * high) << 32;
    const uint64_t hundreds = (four * 10486 >> 20) & UINT64_C(0x0000007f0000007f);
    const uint64_t two = hundreds | (four - 100 * hundreds) << 16;
    const uint64_t ten = (two * 103 >> 10) & UINT64_C(0x000f000f000f000f);
    return ten | (two - 10 * ten) << 8;
}

static void put_eight(char *to, uint64_t digits)
{
    uint64_t text = digits + UINT64_C(0x3030303030303030);
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    text = __builtin_bswap64(text);
#endif
    memcpy(to, &text, sizeof text);
}

/* 17 digits d[0].d[1]... times 10^e of a number, the last zeros among them; n without these. */
struct digits {
    uint64_t middle, last; /* eight each */
    char first;
    int n, e;
};

INTO static inline struct digits digits_of(struct decimal x)
{
    const int n = length_of(x.digits);
    const uint64_t u = x.digits * tens[17 - n], first = u / tens[16], rest = u - first * tens[16];
    const uint64_t middle = rest / tens[8];
    struct digits o = {eight_digits(middle), eight_digits(rest - middle * tens[8]), (char)('0' + first), 1,
                       n - 1 + x.exponent};
    if (o.last)
        o.n = 17 - __builtin_clzll(o.last) / 8;
    else if (o.middle)
        o.n = 9 - __builtin_clzll(o.middle) / 8;
    return o;
}

static void put_17(char *to, const struct digits *d)
{
    to[0] = d->first;
    put_eight(to + 1, d->middle);
    put_eight(to + 9, d->last);
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

static char *put_exponent(char *to, int e)
{
    if (e >= 100) *to++ = (char)('0' + e / 100);
    if (e >= 10) *to++ = (char)('0' + e / 10 % 10);
    *to++ = (char)('0' + e % 10);
    return to;
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
        return put_exponent(to, e < 0 ? -e : e);
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

/* As put_decimal(), all 17 digits at once where they belong; up to 24 bytes are written, whatever the length. */
static char *put_shortest(char *to, const struct digits *d)
{
    const int n = d->n, e = d->e;
    if (e >= 0 && e < 17) {
        put_17(to + 1, d);
        for (int i = 0; i <= e; i++) to[i] = to[i + 1];
        if (n <= e + 1) return to + e + 1;
        to[e + 1] = '.';
        return to + n + 1;
    }
    if (e < 0 && e >= -5) {
        memcpy(to, "0.00000", 7);
        put_17(to + 1 - e, d);
        return to + 1 - e + n;
    }
    put_17(to + 1, d);
    to[0] = to[1];
    to[1] = '.';
    to += n > 1 ? n + 1 : 1;
    *to++ = 'e';
    *to++ = e < 0 ? '-' : '+';
    return put_exponent(to, e < 0 ? -e : e);
}

int number_write(char *to, double x)
{
    int length;
    char *place = put_sign(to, &length, x);
    if (!place) return length;
    const struct digits d = digits_of(decimal(fabs(x)));
    return (int)(put_shortest(place, &d) - to);
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
