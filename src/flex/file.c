/* file.c -- reads a reduced body and doubts everything in it; see file.h */
#include "flex/file.h"

#include <cjson/cJSON.h>
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/text.h"
#include "la/dense.h"
#include "la/eigen.h"

enum { MOST_MODES = 500, MOST_NODES = 10000, MOST_BYTES = 1 << 28 };

/* Where we are, for messages. */
struct place {
    const char *path, *list; /* "nodes", "stresses"; NULL: the top */
    int item;
    struct report *report;
};

static enum status bad(const struct place *p, const char *key, const char *words)
{
    if (p->list) return fail(p->report, E_DECK, "%s: error: %s[%d].%s: %s", p->path, p->list, p->item, key, words);
    return fail(p->report, E_DECK, "%s: error: '%s': %s", p->path, key, words);
}

/* The member, the only one of that name. */
static enum status member(const cJSON **out, const cJSON *object, const char *key, bool needed, const struct place *p)
{
    const cJSON *item;
    *out = NULL;
    cJSON_ArrayForEach(item, object)
    {
        if (strcmp(item->string, key) != 0) continue;
        if (*out) return bad(p, key, "given twice");
        *out = item;
    }
    return *out || !needed ? OK : bad(p, key, "missing");
}

/* The members that are read, and "comment": any other would be missed without a word where it need not be there. */
static enum status known(const cJSON *object, const char *const *keys, int n, const struct place *p)
{
    const cJSON *item;
    cJSON_ArrayForEach(item, object)
    {
        int i = 0;
        char key[44], words[80] = "unknown member";
        while (i < n && strcmp(item->string, keys[i]) != 0) i++;
        if (i < n || strcmp(item->string, "comment") == 0) continue;
        const char *nearest = text_nearest(item->string, keys, n);
        if (nearest) snprintf(words, sizeof words, "unknown member: did you mean '%s'?", nearest);
        snprintf(key, sizeof key, "%.40s", item->string);
        return bad(p, key, words);
    }
    return OK;
}

static enum status numbers(double *x, int n, const cJSON *object, const char *key, const struct place *p)
{
    const cJSON *list, *item;
    int i = 0;
    TRY(member(&list, object, key, true, p));
    if (!cJSON_IsArray(list)) return bad(p, key, "expected a list of numbers");
    cJSON_ArrayForEach(item, list)
    {
        if (!cJSON_IsNumber(item)) return bad(p, key, "something in the list is no number");
        if (!isfinite(item->valuedouble)) return bad(p, key, "a number is not finite");
        if (i < n) x[i] = item->valuedouble;
        i++;
    }
    if (i == n) return OK;
    return p->list ? fail(p->report, E_DECK, "%s: error: %s[%d].%s: %d numbers, expected %d", p->path, p->list, p->item,
                          key, i, n)
                   : fail(p->report, E_DECK, "%s: error: '%s': %d numbers, expected %d", p->path, key, i, n);
}

static enum status whole(int *value, const cJSON *object, const char *key, int low, int high, const struct place *p)
{
    const cJSON *item;
    TRY(member(&item, object, key, true, p));
    double x = item && cJSON_IsNumber(item) ? item->valuedouble : NAN;
    if (!(x >= low && x <= high) || x != floor(x))
        return fail(p->report, E_DECK, "%s: error: '%s': expected a whole number from %d to %d", p->path, key, low,
                    high);
    *value = (int)x;
    return OK;
}

static enum status scalar(double *value, const cJSON *object, const char *key, const struct place *p)
{
    const cJSON *item;
    TRY(member(&item, object, key, true, p));
    *value = item && cJSON_IsNumber(item) ? item->valuedouble : NAN;
    return isfinite(*value) ? OK : bad(p, key, "expected a finite number");
}

static enum status name(const char **out, const cJSON *object, bool needed, const struct place *p, struct arena *life)
{
    const cJSON *item;
    *out = NULL;
    TRY(member(&item, object, "name", needed, p));
    if (!item) return OK;
    if (!cJSON_IsString(item)) return bad(p, "name", "expected a text");
    *out = arena_copy(life, item->valuestring, strlen(item->valuestring));
    return OK;
}

/* An array that may be missing: NULL then. */
static enum status optional(double **out, int n, const cJSON *object, const char *key, const struct place *p,
                            struct arena *life)
{
    const cJSON *list;
    *out = NULL;
    TRY(member(&list, object, key, false, p));
    if (!list) return OK;
    *out = TAKE(life, double, n);
    return numbers(*out, n, object, key, p);
}

static enum status read_node(struct flex_node *o, int n, const cJSON *item, const struct place *p, struct arena *life)
{
    static const char *const keys[] = {"name", "x", "phi", "psi", "S", "T"};
    if (!cJSON_IsObject(item)) return bad(p, "", "expected an object");
    TRY(known(item, keys, sizeof keys / sizeof *keys, p));
    TRY(name(&o->name, item, false, p, life));
    TRY(numbers(o->x, 3, item, "x", p));
    TRY(numbers(o->phi, 3 * n, item, "phi", p));
    TRY(numbers(o->psi, 3 * n, item, "psi", p));
    TRY(optional(&o->S, 3 * n * n, item, "S", p, life));
    return optional(&o->T, 3 * n * n, item, "T", p, life);
}

static enum status read_stress(struct flex_stress *o, int n, const cJSON *item, const struct place *p,
                               struct arena *life)
{
    static const char *const keys[] = {"name", "tensor", "axial", "bending"};
    if (!cJSON_IsObject(item)) return bad(p, "", "expected an object");
    TRY(known(item, keys, sizeof keys / sizeof *keys, p));
    TRY(name(&o->name, item, true, p, life));
    TRY(numbers(o->tensor, 6 * n, item, "tensor", p));
    TRY(optional(&o->axial, n, item, "axial", p, life));
    TRY(optional(&o->bending, n, item, "bending", p, life));
    return !o->axial == !o->bending ? OK : bad(p, "axial", "axial and bending go together");
}

static enum status list_of(const cJSON **out, int *n, const cJSON *object, const char *key, const struct place *p)
{
    TRY(member(out, object, key, true, p));
    if (!cJSON_IsArray(*out)) return bad(p, key, "expected a list");
    *n = 0;
    const cJSON *item;
    cJSON_ArrayForEach(item, *out)++ *n;
    return *n <= MOST_NODES ? OK : bad(p, key, "too many items");
}

static enum status read_lists(struct flex_body *o, const cJSON *nodes, const cJSON *stresses, struct place p,
                              struct arena *life)
{
    const cJSON *item;
    p.list = "nodes";
    p.item = 0;
    cJSON_ArrayForEach(item, nodes)
    {
        TRY(read_node(o->node + p.item, o->n, item, &p, life));
        p.item++;
    }
    p.list = "stresses";
    p.item = 0;
    cJSON_ArrayForEach(item, stresses)
    {
        TRY(read_stress(o->stress + p.item, o->n, item, &p, life));
        p.item++;
    }
    return OK;
}

static enum status read_integrals(struct flex_body *o, const cJSON *json, const struct place *p, struct arena *life)
{
    const int n = o->n;
    TRY(scalar(&o->mass, json, "mass", p));
    TRY(numbers(o->xx, 9, json, "xx", p));
    TRY(numbers(o->rot, 9, json, "rot", p));
    TRY(numbers(o->f, 3 * n, json, "f", p));
    TRY(numbers(o->xf, 9 * n, json, "xf", p));
    TRY(numbers(o->ff, 9 * n * n, json, "ff", p));
    TRY(numbers(o->rpsi, 3 * n, json, "rpsi", p));
    TRY(numbers(o->ppsi, n * n, json, "ppsi", p));
    TRY(numbers(o->K, n * n, json, "K", p));
    TRY(optional(&o->s, 3 * n * n, json, "s", p, life));
    TRY(optional(&o->xs, 9 * n * n, json, "xs", p, life));
    TRY(optional(&o->D, n * n, json, "D", p, life));
    TRY(optional(&o->hertz, n, json, "hertz", p, life));
    return !o->s == !o->xs ? OK : bad(p, "s", "s and xs go together");
}

/* A = A' to 1e-9 of its diagonal, no negative eigenvalue below -1e-9 of the largest. */
static bool is_positive(const double *A, int n, struct arena *scratch)
{
    double *copy = TAKE(scratch, double, n *n), *X = TAKE(scratch, double, n *n), *lambda = TAKE(scratch, double, n);
    memcpy(copy, A, (size_t)(n * n) * sizeof *A);
    if (!(dense_asymmetry(A, n, n) <= 1e-9)) return false;
    eigen_symmetric(lambda, X, copy, n);
    return lambda[0] >= -1e-9 * fabs(lambda[n - 1]);
}

/* Blocks [rows x cols] of pairs i, j: that of j, i is the same, or its transpose, to 1e-9 of the largest. */
static bool pairs_agree(const double *A, int rows, int cols, bool turned, int n)
{
    double worst = 0, most = 0;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++)
            for (int k = 0; k < rows * cols; k++) {
                int back = turned ? k / rows + cols * (k % rows) : k;
                double a = A[k + rows * cols * (i + n * j)], b = A[back + rows * cols * (j + n * i)];
                worst = fmax(worst, fabs(a - b));
                most = fmax(most, fabs(a));
            }
    return worst <= 1e-9 * most;
}

static enum status check_pairs(const struct flex_body *o, const struct place *p)
{
    struct place at = *p;
    if (!pairs_agree(o->ff, 3, 3, true, o->n)) return bad(p, "ff", "block i, j is not that of j, i transposed");
    if (!pairs_agree(o->ppsi, 1, 1, false, o->n)) return bad(p, "ppsi", "is not symmetric");
    if (o->s && !pairs_agree(o->s, 3, 1, false, o->n)) return bad(p, "s", "is not symmetric in i, j");
    if (o->xs && !pairs_agree(o->xs, 3, 3, false, o->n)) return bad(p, "xs", "is not symmetric in i, j");
    at.list = "nodes";
    for (at.item = 0; at.item < o->nnode; at.item++)
        if (o->node[at.item].S && !pairs_agree(o->node[at.item].S, 3, 1, false, o->n))
            return bad(&at, "S", "is not symmetric in i, j");
    return OK;
}

static bool all_zero(const double *x, int n)
{
    for (int i = 0; i < n; i++)
        if (x[i] != 0) return false;
    return true;
}

static enum status check(const struct flex_body *o, const struct place *p, struct arena *scratch)
{
    const struct flex_node *reference = o->node + o->reference;
    double *Me = TAKE(scratch, double, o->n * o->n);
    if (!(o->mass > 0)) return bad(p, "mass", "should be positive");
    if (!is_positive(o->xx, 3, scratch)) return bad(p, "xx", "is no inertia: it should be symmetric, not negative");
    if (!is_positive(o->K, o->n, scratch)) return bad(p, "K", "should be symmetric, not negative");
    if (o->D && !is_positive(o->D, o->n, scratch)) return bad(p, "D", "should be symmetric, not negative");
    TRY(check_pairs(o, p));
    flex_mass(Me, o);
    if (dense_cholesky(Me, o->n, o->n) >= 0) return bad(p, "ff", "gives a mass matrix that is not positive");
    if ((reference->S && !all_zero(reference->S, 3 * o->n * o->n)) ||
        (reference->T && !all_zero(reference->T, 3 * o->n * o->n)))
        return bad(p, "reference", "the reference node should not move");
    if (!all_zero(reference->phi, 3 * o->n) || !all_zero(reference->psi, 3 * o->n))
        return bad(p, "reference", "the reference node should not move");
    return OK;
}

static enum status read_body(struct flex_body **out, double *at, const cJSON *json, const struct place *p,
                             struct arena *life)
{
    static const char *const keys[] = {"fmdsub_flex", "modes", "reference", "at",    "mass",     "xx",      "rot",
                                       "f",           "xf",    "ff",        "rpsi",  "ppsi",     "s",       "xs",
                                       "K",           "D",     "hertz",     "nodes", "stresses", "checksum"};
    const cJSON *nodes, *stresses;
    int version, n, nnode, nstress, reference;
    double place[3];
    if (!cJSON_IsObject(json)) return fail(p->report, E_DECK, "%s: error: no JSON object", p->path);
    TRY(whole(&version, json, "fmdsub_flex", 1, 1, p));
    TRY(known(json, keys, sizeof keys / sizeof *keys, p));
    TRY(whole(&n, json, "modes", 1, MOST_MODES, p));
    TRY(list_of(&nodes, &nnode, json, "nodes", p));
    TRY(list_of(&stresses, &nstress, json, "stresses", p));
    if (!nnode) return bad(p, "nodes", "the list is empty");
    TRY(whole(&reference, json, "reference", 0, nnode - 1, p));
    TRY(numbers(place, 3, json, "at", p));
    struct flex_body *o = flex_body_take(n, nnode, nstress, false, life);
    o->reference = reference;
    TRY(read_integrals(o, json, p, life));
    TRY(read_lists(o, nodes, stresses, *p, life));
    if (at) memcpy(at, place, sizeof place);
    *out = o;
    return OK;
}

static enum status read_text(char **text, size_t *size, const char *path, struct arena *life, struct report *report)
{
    struct stat about;
    FILE *file = file_or_end(path, "rb");
    if (!file) return fail(report, E_FILE, "%s: %s", path, strerror(errno));
    bool plain = fstat(fileno(file), &about) == 0 && S_ISREG(about.st_mode);
    *size = plain ? (size_t)about.st_size : 0;
    if (plain && *size <= MOST_BYTES) {
        *text = TAKE(life, char, *size + 1);
        plain = fread(*text, 1, *size, file) == *size;
    }
    fclose(file);
    if (!plain) return fail(report, E_FILE, "%s: cannot be read as a file", path);
    if (*size > MOST_BYTES) return fail(report, E_LIMIT, "%s: larger than %d bytes", path, MOST_BYTES);
    return OK;
}

/* What was changed since it was written, by mistake, would else be taken where it is still a body. */
static enum status check_text(const cJSON *json, const char *text, const struct place *p)
{
    static const char key[] = "\"checksum\"";
    const cJSON *is = cJSON_GetObjectItemCaseSensitive(json, "checksum");
    if (!is) return OK;
    const char *last = NULL;
    for (const char *at = strstr(text, key); at; at = strstr(at + 1, key)) last = at;
    char fresh[20];
    snprintf(fresh, sizeof fresh, "%016" PRIx64, last ? flex_file_checksum(text, (size_t)(last - text)) : 0);
    if (cJSON_IsString(is) && strcmp(is->valuestring, fresh) == 0) return OK;
    return bad(p, "checksum",
               "does not fit: the file was changed since it was written (make it again, or leave this out)");
}

static int line_of(const char *text, const char *at)
{
    int line = 1;
    for (; text < at; text++) line += *text == '\n';
    return line;
}

enum status flex_file_read(struct flex_body **out, double *at, const char *path, struct arena *life,
                           struct report *report)
{
    struct arena *scratch = arena_open();
    struct place place = {.path = path, .report = report};
    char *text = NULL;
    size_t size = 0;
    const char *end = NULL;
    enum status status = read_text(&text, &size, path, scratch, report);
    if (status == OK && text) {
        cJSON *json = cJSON_ParseWithLengthOpts(text, size + 1, &end, true);
        status = json ? check_text(json, text, &place)
                      : fail(report, E_DECK, "%s:%d: error: this is not JSON", path, line_of(text, end ? end : text));
        if (status == OK) status = read_body(out, at, json, &place, life);
        cJSON_Delete(json);
    }
    if (status == OK) status = check(*out, &place, scratch);
    arena_close(scratch);
    return status;
}
