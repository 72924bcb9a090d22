/* number.c -- shortest text of a double by Schubfach; see number.h
 *
 * x = c 2^q.  The reals that read back as x are those between its neighbours' midpoints,
 * R = [cl, cr] 2^(q-2) with cl = 4c - 2 (4c - 1 above a power of two), cr = 4c + 2, the ends
 * included when c is even (round half to even).  With k = floor(log10 |R|) there are at least one
 * and at most ten multiples of 10^k in R, and at most one of 10^(k+1): if there is one of the latter
 * it is the answer, else the nearer of the two multiples of 10^k around x that lie in R.
 *
 * The products 4c 2^(q-2) 10^-k need only be known up to "below, at, above" a whole number, and 128 bits of 10^-k are
 * enough for that with every double (proved there): the largest whole number up to a product, or less than it, is all that
 * is asked, of its ends as they belong to R or do not, of the middle as its half goes to the even side.
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
    uint64_t digits; /* 10^15 to 10^17 */
    int exponent;    /* x = digits 10^exponent */
};

/* g c 2^-64, the last bits cut off.  g is less than one unit above the true power: an exact product leaves 0 or 1 in the
 * low word, any other more. */
INTO static inline wide times(const uint64_t g[2], uint64_t c)
{
    const wide low = (wide)g[1] * c;
    return (wide)g[0] * c + (uint64_t)(low >> 64);
}

/* The largest whole number up to such a product 2^-64; `less`: that is less than it. */
INTO static inline uint64_t whole(wide product, uint64_t less)
{
    return (uint64_t)(product >> 64) - ((uint64_t)product < 2 * less);
}

static const uint64_t E8 = 100000000, E16 = 10000000000000000;

/* c 2^q, c > 0; narrow: the neighbour below is half as far away as the one above, and the nearest multiple of 10^k need
 * not lie in R, where that is the lower one.  Of up to 17 digits. */
INTO static inline struct decimal shortest(uint64_t c, long q, bool narrow)
{
    const long k = (q * 1262611 - (narrow ? 524031 : 0)) >> 22;
    const int h = (int)(q + ((-k * 1741647) >> 19) + 1);
    const uint64_t *g = pow10_table[-k - POW10_FIRST];
    const uint64_t odd = c & 1, at = 4 * c << h, half = UINT64_C(2) << h;
    const wide v = times(g, at); /* 4 x 10^-k */
    const uint64_t outside = whole(times(g, at - (half >> narrow)), !odd);
    const uint64_t inside = whole(times(g, at + half), odd);

    const uint64_t s = (uint64_t)(v >> 66), tens = s / 10;
    const bool below = outside < 40 * tens, above = 40 * tens + 40 <= inside;
    if (below | above) return (struct decimal){10 * (tens + above), (int)k};
    if (narrow && outside >= 4 * s) return (struct decimal){s + 1, (int)k};
    return (struct decimal){(whole(v, ~s & 1) + 2) / 4, (int)k};
}

/* A power of two, or below the normal numbers, where digits are missing. */
APART struct decimal shortest_of_few(uint64_t fraction, int e)
{
    if (e > 1) return shortest(UINT64_C(1) << 52, e - 1075, true);
    struct decimal o = shortest(e ? UINT64_C(1) << 52 : fraction, -1074, false);
    for (; o.digits < E16 / 10; o.exponent--) o.digits *= 10;
    return o;
}

/* The eight digits of u < 10^8, the first in the lowest byte: halves, quarters and eighths side by side in one word.  The
 * quotients, u / 10^4 for one, are exact for what is below 10^8, 10^4 and 100; (u << m) - ((z << m) - 1) (u / z) is u / z with
 * u % z m bits above. */
INTO static inline uint64_t eight_digits(uint64_t u)
{
    const uint64_t four = (u << 32) - ((UINT64_C(10000) << 32) - 1) * (u * 109951163 >> 40);
    const uint64_t hundreds = (four * 10486 >> 20) & UINT64_C(0x0000007f0000007f);
    const uint64_t two = (four << 16) - ((100 << 16) - 1) * hundreds;
    const uint64_t ten = (two * 103 >> 10) & UINT64_C(0x000f000f000f000f);
    return (two << 8) - ((10 << 8) - 1) * ten;
}

/* The number of the last byte that is not 0, from 0, in the order of eight_digits(). */
INTO static inline int last_byte(uint64_t digits)
{
    return (63 ^ __builtin_clzll(digits)) >> 3;
}

/* d[0].d[1]...d[16] times 10^e of a number, as text; n without the last zeros. */
struct digits {
    uint64_t middle, last; /* eight each */
    char first;
    int n, e;
};

INTO static inline struct digits digits_of(struct decimal x)
{
    static const uint64_t ZEROS = UINT64_C(0x3030303030303030);
    const bool longest = x.digits >= E16;
    const uint64_t u = longest ? x.digits : 10 * x.digits, nine = u / E8,
                   first = nine * 1441151881 >> 57; /* nine / E8 */
    const uint64_t middle = eight_digits(nine - first * E8), last = eight_digits(u - nine * E8);
    int n = 1;
    if (last)
        n = 10 + last_byte(last);
    else if (middle)
        n = 2 + last_byte(middle);
    return (struct digits){middle + ZEROS, last + ZEROS, (char)('0' + first), n, x.exponent + 15 + longest};
}

INTO static inline void put_eight(char *to, uint64_t text)
{
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    text = __builtin_bswap64(text);
#endif
    memcpy(to, &text, sizeof text);
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

/* As put_decimal(), all 17 digits at once where they belong, those about the point twice; up to 26 bytes are written, whatever
 * the length. */
INTO static inline char *put_shortest(char *to, const struct digits *d)
{
    const int n = d->n, e = d->e;
    if (e < 0 && e >= -5) {
        memcpy(to, "0.000000", 8);
        to += 1 - e;
        to[0] = d->first;
        put_eight(to + 1, d->middle);
        put_eight(to + 9, d->last);
        return to + n;
    }
    const bool plain = e >= 0 && e < 17;
    const int point = plain ? e : 0; /* behind that digit */
    to[0] = d->first;
    put_eight(to + 1, d->middle);
    if (point < 8) {
        put_eight(to + point + 2, d->middle >> 8 * point);
        put_eight(to + 10, d->last);
    } else {
        put_eight(to + 9, d->last);
        put_eight(to + point + 2, d->last >> 8 * (point & 7));
    }
    to[point + 1] = '.';
    to += n > point + 1 ? n + 1 : point + 1;
    if (plain) return to;
    *to++ = 'e';
    *to++ = e < 0 ? '-' : '+';
    return put_exponent(to, e < 0 ? -e : e);
}

/* The end; of what is not finite, where it begins. */
INTO static inline char *put_number(char *to, double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    const uint64_t fraction = bits & ((UINT64_C(1) << 52) - 1);
    const int e = (int)(bits >> 52 & 0x7ff);
    char *place = to + (bits >> 63);
    if (e == 0x7ff) return to;
    *to = '-';
    struct decimal o;
    if (fraction != 0 && e != 0) {
        o = shortest(fraction | UINT64_C(1) << 52, e - 1075, false);
    } else if (fraction != 0 || e != 0) {
        o = shortest_of_few(fraction, e);
    } else {
        *place = '0';
        return place + 1;
    }
    const struct digits d = digits_of(o);
    return put_shortest(place, &d);
}

int number_write(char *to, double x)
{
    return (int)(put_number(to, x) - to);
}

char *number_list(char *to, const double *x, int n)
{
    for (int i = 0; i < n; i++) {
        to = put_number(to, x[i]);
        *to++ = ',';
    }
    return to;
}

/* printf rounds correctly from the exact value; only its digits and its exponent are taken, so that
 * the decimal point of a locale does not matter. */
int number_round(char *to, double x, int digits)
{
    assert(isfinite(x));
    assert(digits >= 1 && digits <= 17);
    if (x == 0) return number_write(to, x);
    char text[64], d[17], *place = to;
    if (x < 0) *place++ = '-';
    snprintf(text, sizeof text, "%.*e", digits - 1, fabs(x));
    int n = 0, e = 0;
    const char *c = text;
    for (; *c != 'e'; c++)
        if (*c >= '0' && *c <= '9') d[n++] = *c;
    sscanf(c + 1, "%d", &e);
    return (int)(put_decimal(place, d, significant(d, n), e) - to);
}
