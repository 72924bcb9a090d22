/* t-number.c -- numbers to text: the table of powers against exact integers, the text against
 * strtod, and its length against every shorter "%.*e". */
#include "out/number.h"
#include "out/pow10.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Exact integers, 32 bits a limb, lowest first. */
enum { LIMBS = 48 };

struct big {
    uint32_t limb[LIMBS];
};

static struct big big_of(uint64_t high, uint64_t low)
{
    return (struct big){{(uint32_t)low, (uint32_t)(low >> 32), (uint32_t)high, (uint32_t)(high >> 32)}};
}

static void big_times(struct big *a, uint32_t factor)
{
    uint64_t carry = 0;
    for (int i = 0; i < LIMBS; i++) {
        carry += (uint64_t)a->limb[i] * factor;
        a->limb[i] = (uint32_t)carry;
        carry >>= 32;
    }
    assert_int_equal(carry, 0);
}

static void big_times_pow10(struct big *a, int n)
{
    for (int i = 0; i < n; i++) big_times(a, 10);
}

static void big_shift(struct big *a, int n)
{
    for (; n > 0; n -= n < 31 ? n : 31) big_times(a, UINT32_C(1) << (n < 31 ? n : 31));
}

static int big_compare(const struct big *a, const struct big *b)
{
    for (int i = LIMBS - 1; i >= 0; i--)
        if (a->limb[i] != b->limb[i]) return a->limb[i] < b->limb[i] ? -1 : 1;
    return 0;
}

/* Sign of g 2^r - 10^k, both scaled to integers; g is a ceiling when g gives >= 0 and g - 1 gives < 0. */
static int side(int k, int r, uint64_t high, uint64_t low)
{
    struct big left = big_of(high, low), right = big_of(0, 1);
    big_times_pow10(k < 0 ? &left : &right, abs(k));
    big_shift(r > 0 ? &left : &right, abs(r));
    return big_compare(&left, &right);
}

static void powers_are_exact_ceilings(void **state)
{
    (void)state;
    for (int k = POW10_FIRST; k <= POW10_LAST; k++) {
        uint64_t high = pow10_table[k - POW10_FIRST][0], low = pow10_table[k - POW10_FIRST][1];
        int r = (int)floor(k * 3.3219280948873623478703194294894) - 127;
        assert_true(high >> 63);
        assert_true(side(k, r, high, low) >= 0);
        assert_true(side(k, r, high - (low == 0), low - 1) < 0);
    }
}

static const char *written(double x)
{
    static char text[NUMBER_MOST + 2];
    memset(text, '#', sizeof text);
    int n = number_write(text, x);
    assert_in_range(n, 1, NUMBER_MOST);
    assert_null(memchr(text, '#', (size_t)n));
    assert_true(text[NUMBER_MOST] == '#' && text[NUMBER_MOST + 1] == '#'); /* its room, and no more */
    text[n] = 0;
    return text;
}

static uint64_t bits_of(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static double of_bits(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static void reads_back(double x)
{
    const char *text = written(x);
    char *end;
    if (bits_of(strtod(text, &end)) != bits_of(x) || *end) fail_msg("%a was written as %s", x, text);
}

/* The digits of text, without sign, point, exponent, and zeros before and after. */
static void digits_of(char *digits, const char *text)
{
    int n = 0;
    for (; *text && *text != 'e'; text++)
        if (*text >= '0' && *text <= '9' && (n > 0 || *text != '0')) digits[n++] = *text;
    while (n > 1 && digits[n - 1] == '0') n--;
    digits[n] = 0;
}

/* The first "%.*e" that reads back is the shortest and the nearest of its length, but above a power
 * of two, where the interval is not centred, a shorter one may exist that is not the nearest. */
static void is_shortest(double x)
{
    char loop[40], by_loop[40], ours[40];
    for (int digits = 1; digits <= 17; digits++) {
        snprintf(loop, sizeof loop, "%.*e", digits - 1, x);
        if (strtod(loop, NULL) == x) break;
    }
    digits_of(by_loop, loop);
    digits_of(ours, written(x));
    bool narrow = (bits_of(x) & ((UINT64_C(1) << 52) - 1)) == 0;
    if (narrow)
        assert_true(strlen(ours) <= strlen(by_loop));
    else
        assert_string_equal(ours, by_loop);
}

static void checked(double x)
{
    reads_back(x);
    reads_back(-x);
    if (x != 0) is_shortest(x);
}

static uint64_t next_random(uint64_t *state)
{
    uint64_t z = (*state += UINT64_C(0x9e3779b97f4a7c15)); /* splitmix64 */
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

static void random_bits_read_back(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (int i = 0; i < 10000000; i++) {
        double x = of_bits(next_random(&seed));
        if (isfinite(x)) reads_back(x);
    }
}

static void random_bits_are_shortest(void **state)
{
    (void)state;
    uint64_t seed = 2;
    for (int i = 0; i < 30000; i++) {
        double x = of_bits(next_random(&seed) >> 1);
        if (isfinite(x)) is_shortest(x);
    }
}

/* What results look like: few digits, round times, whole numbers of any size. */
static void everyday_numbers_are_shortest(void **state)
{
    (void)state;
    uint64_t seed = 3;
    for (int i = 0; i < 30000; i++) {
        uint64_t bits = next_random(&seed);
        checked((double)(int)(bits % 200001) / 1000);
        checked((double)(bits >> (bits & 63)));
        checked(i * 1e-3);
    }
}

static void powers_and_neighbours(void **state)
{
    (void)state;
    for (int e = -1074; e < 1024; e++) {
        double x = ldexp(1, e);
        checked(x);
        checked(nextafter(x, INFINITY) < INFINITY ? nextafter(x, INFINITY) : x);
        checked(nextafter(x, 0));
    }
    for (int e = -323; e <= 308; e++) {
        char text[40];
        snprintf(text, sizeof text, "1e%d", e);
        double x = strtod(text, NULL);
        checked(x);
        checked(nextafter(x, INFINITY));
        checked(nextafter(x, 0));
        digits_of(text, written(x));
        assert_string_equal(text, "1");
    }
}

static void denormals(void **state)
{
    (void)state;
    uint64_t seed = 4;
    for (uint64_t bits = 1; bits < 3000; bits++) checked(of_bits(bits));
    for (int i = 0; i < 3000; i++) checked(of_bits(next_random(&seed) >> (12 + i % 50)));
    checked(DBL_MIN);
    checked(nextafter(DBL_MIN, 0));
    checked(DBL_MAX);
}

static void forms(void **state)
{
    (void)state;
    static const struct {
        double x;
        const char *text;
    } rows[] = {{0, "0"},
                {-0.0, "-0"},
                {3, "3"},
                {-10, "-10"},
                {0.1, "0.1"},
                {0.1 + 0.2, "0.30000000000000004"},
                {1.0 / 3, "0.3333333333333333"},
                {-2.5, "-2.5"},
                {123456.789, "123456.789"},
                {1e-5, "0.00001"},
                {9.999e-6, "9.999e-6"},
                {1e-6, "1e-6"},
                {9007199254740993, "9007199254740992"},
                {1e16, "10000000000000000"},
                {99999999999999984, "99999999999999980"},
                {1e17, "1e+17"},
                {1.5e300, "1.5e+300"},
                {5e-324, "5e-324"},
                {DBL_MAX, "1.7976931348623157e+308"},
                {-1.2345678901234567e-308, "-1.2345678901234567e-308"},
                {2e-44, "2e-44"},
                {9.5367431640625e-7, "9.5367431640625e-7"}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) assert_string_equal(written(rows[i].x), rows[i].text);
}

/* Ties, and all that a search by continued fractions over every exponent finds within two units of the quick product's 59
 * bits of a tie where the product alone goes wrong: the end of the interval that reads back stands at a shorter decimal, or
 * the number in the middle of two decimals.  The last five are ties. */
static void near_ties(void **state)
{
    (void)state;
    static const double rows[] = {
        0x1.090684f5fe998p-650, 0x1.8823a57adbef9p-497, 0x1.8823a57adbef8p-497, 0x1.acc46749dccfep-870,
        0x1.1009fd836acf5p-793, 0x1.3f8a3d7a3b923p-716, 0x1.3e07d2c0cb1e9p-654, 0x1.1b96458445d07p-345,
        0x1.88f6a1b543ad8p-182, 0x1.eb344a229498ep-179, 0x1.e735b3003e352p+455, 0x1.2efc987c579bbp+778,
        0x1.8739d11afbffdp+891, 0x1.0000000000002p+54,  0x1.0000000000001p+54,  0x1.0000000000029p+56,
        0x1.0000000000001p+50,  0x1.0000000000003p+50,
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) checked(rows[i]);
}

/* Each place of the point, with all 17 digits, with fewer than stand before it, and with a sign. */
static void points(void **state)
{
    (void)state;
    static const char *const digits[] = {"12345678901234567", "5", "12", "123456789"};
    for (size_t i = 0; i < sizeof digits / sizeof *digits; i++)
        for (int e = -8; e < 20; e++) {
            char text[40];
            snprintf(text, sizeof text, "-%.1s.%se%d", digits[i], digits[i] + 1, e);
            const double x = strtod(text, NULL);
            checked(x);
            const char *point = strchr(written(x), '.');
            if (e >= 0 && e + 1 < (int)strlen(digits[i]) && e < 16) assert_true(point && point - written(x) == e + 2);
        }
}

static void not_finite_has_no_text(void **state)
{
    (void)state;
    char text[NUMBER_MOST];
    assert_int_equal(number_write(text, NAN), 0);
    assert_int_equal(number_write(text, INFINITY), 0);
    assert_int_equal(number_write(text, -INFINITY), 0);
}

static const char *rounded(double x, int digits)
{
    static char text[NUMBER_MOST + 1];
    text[number_round(text, x, digits)] = 0;
    return text;
}

static void rounding(void **state)
{
    (void)state;
    assert_string_equal(rounded(0, 3), "0");
    assert_string_equal(rounded(-0.0012345, 3), "-0.00123");
    assert_string_equal(rounded(1.25e-6, 3), "1.25e-6");
    assert_string_equal(rounded(9.996, 3), "10");
    assert_string_equal(rounded(123456, 2), "120000");
    assert_string_equal(rounded(2.5, 1), "2"); /* half to even */
    assert_string_equal(rounded(DBL_MAX, 4), "1.798e+308");
    uint64_t seed = 5;
    for (int i = 0; i < 50000; i++) {
        double x = of_bits(next_random(&seed));
        char text[40];
        int digits = 1 + i % 17;
        if (!isfinite(x)) continue;
        snprintf(text, sizeof text, "%.*e", digits - 1, x);
        assert_true(strtod(rounded(x, digits), NULL) == strtod(text, NULL));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(powers_are_exact_ceilings),
        cmocka_unit_test(random_bits_read_back),
        cmocka_unit_test(random_bits_are_shortest),
        cmocka_unit_test(everyday_numbers_are_shortest),
        cmocka_unit_test(powers_and_neighbours),
        cmocka_unit_test(denormals),
        cmocka_unit_test(forms),
        cmocka_unit_test(near_ties),
        cmocka_unit_test(points),
        cmocka_unit_test(not_finite_has_no_text),
        cmocka_unit_test(rounding),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
