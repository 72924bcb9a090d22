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
    long exponent;   /* x = digits 10^exponent */
};

/* The high half of a b. */
INTO static inline uint64_t high_of(uint64_t a, uint64_t b)
{
    return (uint64_t)((wide)a * b >> 64);
}

struct product {
    uint64_t high, low; /* high + low 2^-64 */
};

/* g c 2^-64, the last bits cut off.  g is less than one unit above the true power: an exact product leaves 0 or 1 in the
 * low word, any other more. */
INTO static inline struct product times(const uint64_t g[2], uint64_t c)
{
    const uint64_t carried = high_of(g[1], c), low = g[0] * c + carried;
    return (struct product){high_of(g[0], c) + (low < carried), low};
}

/* The largest whole number up to such a product 2^-64; `less`: that is less than it. */
INTO static inline uint64_t whole(struct product product, uint64_t less)
{
    return product.high - (product.low < 2 * less);
}

static const uint64_t E8 = 100000000, E16 = 10000000000000000;

/* c 2^q = 4 c 10^k (2^h g 2^-128) / 4: where its 4 c 10^-k stands in the table. */
struct place {
    const uint64_t *g;
    long k;
    int h;
};

INTO static inline struct place place_of(long q, bool narrow)
{
    const long k = (q * 1262611 - (narrow ? 524031 : 0)) >> 22;
    return (struct place){pow10_table[-k - POW10_FIRST], k, (int)(q + ((-k * 1741647) >> 19) + 1)};
}

/* c 2^q, c > 0; narrow: the neighbour below is half as far away as the one above, and the nearest multiple of 10^k need
 * not lie in R, where that is the lower one.  Of up to 17 digits. */
APART struct decimal shortest(uint64_t c, long q, bool narrow)
{
    const struct place p = place_of(q, narrow);
    const uint64_t *g = p.g;
    const long k = p.k;
    const int h = p.h;
    const uint64_t odd = c & 1, at = 4 * c << h, half = UINT64_C(2) << h;
    const struct product v = times(g, at); /* 4 x 10^-k */
    const uint64_t outside = whole(times(g, at - (half >> narrow)), !odd);
    const uint64_t inside = whole(times(g, at + half), odd);

    const uint64_t s = v.high >> 2, tens = s / 10;
    const bool below = outside < 40 * tens, above = 40 * tens + 40 <= inside;
    if (below | above) return (struct decimal){10 * (tens + above), k};
    if (narrow && outside >= 4 * s) return (struct decimal){s + 1, k};
    return (struct decimal){(whole(v, ~s & 1) + 2) / 4, k};
}

/* The same where nothing is near a tie, by one product: of x 10^-k its last digit, with 59 bits behind it, against half of what
 * is between x and its neighbours.  Both are less than one unit too small: what is more than two away from a tie is beyond it. */
INTO static inline struct decimal quickly_shortest(uint64_t c, long q)
{
    static const uint64_t ONE = UINT64_C(1) << 59, TIE = UINT64_C(1) << 63;
    const struct place p = place_of(q, false);
    const struct product v = times(p.g, c << p.h);
    const uint64_t tens = v.high / 10, last = (v.high << 59 | v.low >> 5) - 10 * ONE * tens;
    const uint64_t half = p.g[0] >> (6 - p.h);
    const int64_t down = (int64_t)(last - half), up = (int64_t)(last + half - 10 * ONE);
    if (down < -2) return (struct decimal){10 * tens, p.k};
    if (up > 2) return (struct decimal){10 * tens + 10, p.k};
    if (down <= 2 || up >= -2 || v.low - TIE + 64 <= 128) return shortest(c, q, false);
    return (struct decimal){v.high + (v.low >> 63), p.k};
}

/* A power of two, or below the normal numbers, where digits are missing. */
APART struct decimal shortest_of_few(uint64_t fraction, long e)
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
    return ((two - 10 * ten) << 8) + ten;
}

/* The number of the last byte that is not 0, from 0, in the order of eight_digits(). */
INTO static inline long last_byte(uint64_t digits)
{
    return (63 ^ (unsigned)__builtin_clzll(digits)) >> 3;
}

/* d[0].d[1]...d[16] times 10^e of a number, as text; n without the last zeros. */
struct digits {
    uint64_t middle, last; /* eight each */
    char first;
    long n, e;
};

INTO static inline struct digits digits_of(struct decimal x)
{
    static const uint64_t ZEROS = UINT64_C(0x3030303030303030);
    if (x.digits < E16) x = (struct decimal){10 * x.digits, x.exponent - 1};
    const uint64_t nine = x.digits / E8, first = nine * 1441151881 >> 57; /* nine / E8 */
    const uint64_t middle = eight_digits(nine - first * E8), last = eight_digits(x.digits - nine * E8);
    long n = 1;
    if (last)
        n = 10 + last_byte(last);
    else if (middle)
        n = 2 + last_byte(middle);
    return (struct digits){middle + ZEROS, last + ZEROS, (char)('0' + first), n, x.exponent + 16};
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

static char *put_exponent(char *to, long e)
{
    const long tens = e / 10;
    if (tens >= 10) *to++ = (char)('0' + tens / 10);
    if (tens) *to++ = (char)('0' + tens % 10);
    *to++ = (char)('0' + (e - 10 * tens));
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
    const long n = d->n, e = d->e;
    if (e < 0 && e >= -5) {
        memcpy(to, "0.000000", 8);
        to += 1 - e;
        to[0] = d->first;
        put_eight(to + 1, d->middle);
        put_eight(to + 9, d->last);
        return to + n;
    }
    const bool plain = e >= 0 && e < 17;
    const long point = plain ? e : 0; /* behind that digit */
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

enum { NOT_FINITE = 0x7ff };

/* As put_number(), of what is not often met, its digits from `place` on: 0, powers of two, what is below the normal numbers or
 * not finite. */
APART char *put_unusual(char *to, char *place, uint64_t fraction, long e)
{
    if (e == NOT_FINITE) return to;
    if (e != 0 || fraction != 0) {
        const struct digits d = digits_of(shortest_of_few(fraction, e));
        return put_shortest(place, &d);
    }
    *place = '0';
    return place + 1;
}

/* The end; of what is not finite, where it begins. */
INTO static inline char *put_number(char *to, double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    const uint64_t fraction = bits & ((UINT64_C(1) << 52) - 1);
    const long e = (long)(bits >> 52 & 0x7ff);
    const bool normal = (unsigned long)e - 1 < NOT_FINITE - 1;
    char *place = to + (bits >> 63);
    *to = '-';
    if (!normal || fraction == 0) return put_unusual(to, place, fraction, e);
    const struct digits d = digits_of(quickly_shortest(fraction | UINT64_C(1) << 52, e - 1075));
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
