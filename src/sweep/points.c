/* points.c -- see points.h */
#include "sweep/points.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "out/number.h"

enum { DIGITS = 15 };

static const char *number_text(double x, char *buffer)
{
    buffer[number_round(buffer, x, DIGITS)] = 0;
    return buffer;
}

static const char *trim(const char *text, size_t n, struct arena *life)
{
    while (n > 0 && (*text == ' ' || *text == '\t')) text++, n--;
    while (n > 0 && (text[n - 1] == ' ' || text[n - 1] == '\t')) n--;
    return arena_copy(life, text, n);
}

static enum status wrong(const char *text, const char *why, struct report *report)
{
    return fail(report, E_USAGE, "--over '%.80s': %s", text, why);
}

/* ---- values that are given ---- */

/* As far as the next comma outside of brackets and quotes. */
static size_t item_length(const char *list)
{
    int depth = 0;
    char quote = 0;
    size_t n = 0;
    for (; list[n] && (list[n] != ',' || depth > 0 || quote); n++) {
        if (quote)
            quote = list[n] == quote ? 0 : quote;
        else if (list[n] == '"' || list[n] == '\'')
            quote = list[n];
        else
            depth += (strchr("[{(", list[n]) != NULL) - (strchr("]})", list[n]) != NULL);
    }
    return n;
}

static enum status read_list(struct factor *f, const char *text, const char *list, struct arena *life,
                             struct report *report)
{
    const size_t n = strlen(list);
    int capacity = 0;
    if (list[n - 1] != ']') return wrong(text, "a list ends with ]", report);
    const char *at = arena_copy(life, list + 1, n - 2);
    for (;; at++) {
        const size_t length = item_length(at);
        const char *value = trim(at, length, life);
        if (!*value) return wrong(text, "an empty value in the list", report);
        f->value = arena_more(life, f->value, f->n, &capacity, sizeof *f->value);
        f->value[f->n++] = value;
        at += length;
        if (!*at) return OK;
    }
}

/* a:b:n, a:b:lin:n, a:b:log:n */
static enum status read_range(struct factor *f, const char *text, const char *range, struct arena *life,
                              struct report *report)
{
    char *end, buffer[NUMBER_MOST + 1];
    const double a = strtod(range, &end);
    if (end == range || *end != ':') return wrong(text, "values are [a, b, ...], from:to:n or from:to:log:n", report);
    const char *second = end + 1;
    const double b = strtod(second, &end);
    if (end == second || *end != ':' || !isfinite(a) || !isfinite(b))
        return wrong(text, "a range is from:to:n or from:to:log:n", report);
    const bool by_ratio = strncmp(end, ":log:", 5) == 0, lin = strncmp(end, ":lin:", 5) == 0;
    const char *count = end + (by_ratio || lin ? 5 : 1);
    const long n = strtol(count, &end, 10);
    if (end == count || *end || n < 1 || n > MOST_POINTS)
        return wrong(text, "a range ends with the number of its values", report);
    if (by_ratio && !(a * b > 0))
        return wrong(text, "both ends of a logarithmic range are of one sign and not 0", report);
    f->n = (int)n;
    f->value = TAKE(life, const char *, n);
    for (long i = 0; i < n; i++) {
        const double share = n > 1 ? (double)i / (double)(n - 1) : 0;
        const double x = i == 0 ? a : i == n - 1 ? b : by_ratio ? a * pow(b / a, share) : a + (b - a) * share;
        number_text(x, buffer);
        f->value[i] = arena_copy(life, buffer, strlen(buffer));
    }
    return OK;
}

/* ---- values that are drawn ---- */

/* splitmix64: S. Vigna, 2015. */
static uint64_t mix(uint64_t x)
{
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
    x = (x ^ x >> 27) * 0x94d049bb133111ebu;
    return x ^ x >> 31;
}

double points_uniform(uint64_t seed, uint64_t stream, uint64_t i)
{
    return ((double)(mix(mix(mix(seed) ^ stream) ^ i) >> 12) + .5) * 0x1p-52;
}

static double ratio(const double *p, const double *q, int n, double x)
{
    double above = p[n], below = q[n];
    for (int i = n - 1; i >= 0; i--) above = above * x + p[i], below = below * x + q[i];
    return above / below;
}

/* M. J. Wichura, Algorithm AS 241 (PPND16), Applied Statistics 37, 1988. */
double points_normal(double u)
{
    static const double a[] = {3.3871328727963666080e0,  1.3314166789178437745e+2, 1.9715909503065514427e+3,
                               1.3731693765509461125e+4, 4.5921953931549871457e+4, 6.7265770927008700853e+4,
                               3.3430575583588128105e+4, 2.5090809287301226727e+3};
    static const double b[] = {1,
                               4.2313330701600911252e+1,
                               6.8718700749205790830e+2,
                               5.3941960214247511077e+3,
                               2.1213794301586595867e+4,
                               3.9307895800092710610e+4,
                               2.8729085735721942674e+4,
                               5.2264952788528545610e+3};
    static const double c[] = {1.42343711074968357734e0,  4.63033784615654529590e0, 5.76949722146069140550e0,
                               3.64784832476320460504e0,  1.27045825245236838258e0, 2.41780725177450611770e-1,
                               2.27238449892691845833e-2, 7.74545014278341407640e-4};
    static const double d[] = {1,
                               2.05319162663775882187e0,
                               1.67638483018380384940e0,
                               6.89767334985100004550e-1,
                               1.48103976427480074590e-1,
                               1.51986665636164571966e-2,
                               5.47593808499534494600e-4,
                               1.05075007164441684324e-9};
    static const double e[] = {6.65790464350110377720e0,  5.46378491116411436990e0,  1.78482653991729133580e0,
                               2.96560571828504891230e-1, 2.65321895265761230930e-2, 1.24266094738807843860e-3,
                               2.71155556874348757815e-5, 2.01033439929228813265e-7};
    static const double f[] = {1,
                               5.99832206555887937690e-1,
                               1.36929880922735805310e-1,
                               1.48753612908506148525e-2,
                               7.86869131145613259100e-4,
                               1.84631831751005468180e-5,
                               1.42151175831644588870e-7,
                               2.04426310338993978564e-15};
    const double q = u - .5;
    if (fabs(q) <= .425) return q * ratio(a, b, 7, .180625 - q * q);
    const double r = sqrt(-log(fmin(u, 1 - u)));
    const double x = r <= 5 ? ratio(c, d, 7, r - 1.6) : ratio(e, f, 7, r - 5);
    return copysign(x, q);
}

static double draw_normal(double u, double mean, double deviation)
{
    return mean + deviation * points_normal(u);
}

static double draw_uniform(double u, double a, double b)
{
    return a + (b - a) * u;
}

static double draw_loguniform(double u, double a, double b)
{
    return a * pow(b / a, u);
}

/* normal(1e4,1e3) */
static enum status read_distribution(struct factor *f, const char *text, const char *words, struct report *report)
{
    static const struct {
        const char *name;
        double (*draw)(double u, double a, double b);
    } kinds[] = {{"normal(", draw_normal}, {"uniform(", draw_uniform}, {"loguniform(", draw_loguniform}};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        const size_t n = strlen(kinds[i].name);
        if (strncmp(words, kinds[i].name, n) != 0) continue;
        char *end;
        f->draw = kinds[i].draw;
        f->a = strtod(words + n, &end);
        if (end > words + n && *end == ',') {
            const char *second = end + 1;
            f->b = strtod(second, &end);
            if (end > second && strcmp(end, ")") == 0 && isfinite(f->a) && isfinite(f->b)) break;
        }
        return wrong(text, "a distribution has two numbers, such as normal(1e4,1e3)", report);
    }
    if (!f->draw)
        return wrong(text, "a distribution is normal(mean,deviation), uniform(from,to) or loguniform(from,to)", report);
    if (f->draw == draw_normal && f->b < 0) return wrong(text, "a deviation is not negative", report);
    if (f->draw == draw_loguniform && !(f->a * f->b > 0))
        return wrong(text, "both ends of loguniform are of one sign and not 0", report);
    return OK;
}

/* ---- all of them ---- */

enum status points_add(struct pointset *o, const char *text, struct arena *life, struct report *report)
{
    const size_t n = strcspn(text, "=~");
    struct factor f = {.name = trim(text, n, life)};
    const char *value = text[n] ? trim(text + n + 1, strlen(text + n + 1), life) : "";
    if (!*f.name || !*value) return wrong(text, "expected name=values or name~distribution", report);
    for (int i = 0; i < o->nfactor; i++)
        if (strcmp(o->factor[i].name, f.name) == 0) return wrong(text, "the name is given twice", report);
    TRY(text[n] == '~'  ? read_distribution(&f, text, value, report)
        : *value == '[' ? read_list(&f, text, value, life, report)
                        : read_range(&f, text, value, life, report));
    o->factor = arena_more(life, o->factor, o->nfactor, &o->capacity, sizeof *o->factor);
    o->factor[o->nfactor++] = f;
    return OK;
}

/* A permutation of the parts: Fisher and Yates, with the factor's own stream. */
static void shuffle(struct factor *f, const struct pointset *o, uint64_t stream, struct arena *life)
{
    f->part = TAKE(life, int, o->draws);
    for (long i = 0; i < o->draws; i++) f->part[i] = (int)i;
    for (long i = o->draws - 1; i > 0; i--) {
        const long j = (long)(points_uniform(o->seed, ~stream, (uint64_t)i) * (double)(i + 1));
        const int other = f->part[j];
        f->part[j] = f->part[i];
        f->part[i] = other;
    }
}

enum status points_close(struct pointset *o, long draws, struct arena *life, struct report *report)
{
    int drawn = 0;
    double all = 1;
    for (int f = 0; f < o->nfactor; f++) drawn += o->factor[f].n == 0;
    if (!o->nfactor) return fail(report, E_USAGE, "a sweep needs --over 'name=values'");
    if (drawn && draws < 1)
        return fail(report, E_USAGE, "--sample N says how many values of '%.40s' are drawn",
                    o->factor[o->nfactor - 1].name);
    if (!drawn && draws > 0)
        return fail(report, E_USAGE, "--sample: nothing is drawn; --over 'name~normal(mean,deviation)'");
    o->draws = drawn ? draws : 1;
    for (int f = 0; f < o->nfactor; f++) all *= o->factor[f].n ? o->factor[f].n : 1;
    if (!(all * (double)o->draws <= MOST_POINTS))
        return fail(report, E_USAGE, "%g points: the limit is %d", all * (double)o->draws, MOST_POINTS);
    o->n = (long)all * o->draws;
    for (int f = 0; f < o->nfactor && o->latin; f++)
        if (o->factor[f].n == 0) shuffle(&o->factor[f], o, (uint64_t)f, life);
    return OK;
}

const char *points_value(const struct pointset *o, long i, int f, char *buffer)
{
    const struct factor *factor = &o->factor[f];
    const long draw = i % o->draws;
    long combination = i / o->draws;
    if (factor->n == 0) {
        double u = points_uniform(o->seed, (uint64_t)f, (uint64_t)draw);
        if (factor->part) u = (factor->part[draw] + u) / (double)o->draws;
        return number_text(factor->draw(u, factor->a, factor->b), buffer);
    }
    for (int g = o->nfactor - 1; g > f; g--) combination /= o->factor[g].n ? o->factor[g].n : 1;
    return factor->value[combination % factor->n];
}
