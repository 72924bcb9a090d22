/* expression.c -- an expression of slots a, b, c and t: its value is the same by every machine, inside its span, and an error
 * is about a word of the text.  The first byte says where the slots are. */
#include <math.h>
#include <string.h>

#include "expr/expr.h"
#include "fuzz/fuzz.h"

enum { SLOTS = 4 };

static int find(void *self, int *slot, double *value, const char *name, struct expr_error *error)
{
    static const char *const names[SLOTS] = {"a", "b.c", "c_1", "t"};
    (void)self, (void)error;
    for (int i = 0; i < SLOTS; i++)
        if (strcmp(name, names[i]) == 0) return *slot = i, 0;
    *slot = -1, *value = 2.5;
    return strcmp(name, "k") != 0;
}

static bool same(double a, double b)
{
    return a == b || (isnan(a) && isnan(b));
}

/* A point of the box, not at its rim where a slot moves; false: there is none. */
static bool inside(double *x, const double *lo, const double *hi, int k)
{
    for (int i = 0; i < SLOTS; i++) {
        x[i] = lo[i] + (hi[i] - lo[i]) * (1 + (k * (i + 2) + i) % 7) / 8;
        if (lo[i] != hi[i] && !(x[i] > lo[i] && x[i] < hi[i])) return false;
    }
    return true;
}

static void evaluate(const struct expr *e, unsigned seed)
{
    static const double some[] = {0, 1, -1, 0.5, -2.5, 3, 1e-9, 1e9, -0.0, 7, -1e300, 1e-300};
    enum { SOME = sizeof some / sizeof *some };
    double lo[SLOTS], hi[SLOTS], x[SLOTS], d[SLOTS], first, second;
    int slots[SLOTS];
    struct expr_span span;
    for (int i = 0; i < SLOTS; i++) {
        lo[i] = some[(seed + (unsigned)i) % SOME];
        hi[i] = lo[i] + fabs(some[(seed / SOME + 1) % SOME]);
    }
    const int n = expr_reads(e, slots, SLOTS);
    PROMISE(n >= 0 && n <= SLOTS);
    const bool sure = expr_span(&span, e, lo, hi);
    const double slack = sure ? 1e-9 * (fabs(span.lo) + fabs(span.hi)) : 0;
    for (int k = 0; k < 7; k++) {
        const bool judged = inside(x, lo, hi, k) && sure;
        const double value = expr_value(e, x);
        PROMISE(same(value, expr_slopes(e, d, x, slots, n)));
        for (int i = 0; i < n; i++) PROMISE(same(value, expr_jet(e, &first, &second, x, slots[i])));
        PROMISE(!judged || (value >= span.lo - slack && value <= span.hi + slack));
    }
    double at, before, behind;
    const struct expr_way way = {e, lo, hi, SLOTS};
    (void)expr_bends(&way);
    (void)expr_pole(&at, &way);
    (void)expr_leap(&before, &behind, &way);
    (void)expr_is_smooth(e);
    (void)expr_may_have_poles(e);
    if (n > 0) {
        memcpy(hi, lo, sizeof hi);
        hi[slots[0]] += 1;
        (void)expr_mean(&first, &way, slots[0]);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const struct expr_names names = {.find = find, .self = NULL};
    if (size == 0) return 0;
    const unsigned seed = data[0];
    const size_t len = size - 1;
    struct arena *life = arena_open();
    char *text = arena_copy(life, (const char *)data + 1, len);
    for (int truth = 0; truth < 2; truth++) {
        struct expr *e;
        struct expr_error error = {0};
        const int failed = (truth ? expr_parse_truth : expr_parse)(&e, text, len, &names, life, &error);
        if (failed) {
            PROMISE(error.text[0] && memchr(error.text, 0, sizeof error.text) &&
                    memchr(error.hint, 0, sizeof error.hint));
            PROMISE(error.offset <= len && error.length >= 1);
        } else {
            evaluate(e, seed);
        }
    }
    arena_close(life);
    return 0;
}
