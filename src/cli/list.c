/* list.c -- fmdsub list: schemes, joints, forces, sections of a deck with their keys, columns of a deck */
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "cli/cli.h"
#include "cli/page.h"
#include "multirate/schemes.h"
#include "out/table.h"
#include "sim/load.h"
#include "sim/sim.h"

static void print_range(const struct key *k)
{
    if (k->type != KEY_REAL && k->type != KEY_INT && k->type != KEY_VECTOR) return;
    if (!isinf(k->lo)) printf(", %s %g", k->flags & KEY_ABOVE ? ">" : ">=", k->lo);
    if (!isinf(k->hi)) printf(", %s %g", k->flags & KEY_BELOW ? "<" : "<=", k->hi);
}

static void print_key(const struct key *k)
{
    printf("    %-18s %s", k->name, page_type(k));
    if (k->unit) printf(" [%s]", k->unit);
    print_range(k);
    if (k->flags & KEY_REQUIRED) printf(", required");
    if (k->fallback) printf(", default %s", k->fallback);
    if (k->flags & KEY_PLANAR) printf(", 2-D only");
    if (k->flags & KEY_SPATIAL) printf(", 3-D only");
    printf("\n      %s\n", k->brief);
}

static void print_sections(const char *path, struct arena *life)
{
    struct section s;
    for (int i = 0; sim_section(&s, i, life); i++) {
        if (path && strcmp(s.path, path) != 0) continue;
        printf("%s%s%s: %s\n", *s.path ? s.path : "(top level)", s.word ? "." : "", s.word ? s.word : "", s.brief);
        for (const struct key *k = s.keys; k && k->name; k++) print_key(k);
    }
}

static void print_scheme(const struct stepper_kind *k)
{
    printf("%-17s order %d%s%s  %s", k->name, k->order, k->two_rates ? ", two rates" : "",
           k->adaptive ? ", own steps" : "", k->brief);
}

static void print_schemes(void)
{
    for (int i = 0; stepper_kinds[i]; i++) {
        print_scheme(stepper_kinds[i]);
        putchar('\n');
    }
    for (int i = 0; stepper_absent[i]; i++) {
        print_scheme(stepper_absent[i]);
        printf(" (not in this build: %s was missing)\n", stepper_absent[i]->needs);
    }
}

static void print_effects(void)
{
    for (int i = 0; i < EFFECTS; i++) {
        const struct effect_kind *e = &effect_kinds[i];
        printf("%s: %s\n    tells      %s\n    left out   %s\n    costs      %s\n    watched    %s\n", e->name,
               e->brief, e->evidence, e->threshold, e->cost, e->watched);
    }
}

/* ---- as tables: --format ---- */

static enum status put_table(const struct table *table, const struct request *request, struct report *report)
{
    return table_print(table, table_form_of(request->format, false), stdout, report);
}

static void scheme_row(struct table *table, const struct stepper_kind *k, bool absent)
{
    table_text(table, k->name);
    table_number(table, k->order);
    table_text(table, k->two_rates ? "yes" : "no");
    table_text(table, k->adaptive ? "yes" : "no");
    table_text(table, k->brief);
    table_text(table, absent ? k->needs : "");
}

static enum status schemes_table(const struct request *request, struct arena *life, struct report *report)
{
    static const struct table_column columns[] = {{"scheme", NULL, 0},    {"order", NULL, 6}, {"two_rates", NULL, 0},
                                                  {"own_steps", NULL, 0}, {"brief", NULL, 0}, {"missing", NULL, 0}};
    struct table *table = table_open(columns, 6, life);
    for (int i = 0; stepper_kinds[i]; i++) scheme_row(table, stepper_kinds[i], false);
    for (int i = 0; stepper_absent[i]; i++) scheme_row(table, stepper_absent[i], true);
    return put_table(table, request, report);
}

static enum status effects_table(const struct request *request, struct arena *life, struct report *report)
{
    static const struct table_column columns[] = {{"effect", NULL, 0},   {"brief", NULL, 0}, {"tells", NULL, 0},
                                                  {"left_out", NULL, 0}, {"costs", NULL, 0}, {"watched", NULL, 0}};
    struct table *table = table_open(columns, 6, life);
    for (int i = 0; i < EFFECTS; i++) {
        const struct effect_kind *e = &effect_kinds[i];
        const char *const texts[] = {e->name, e->brief, e->evidence, e->threshold, e->cost, e->watched};
        for (int k = 0; k < 6; k++) table_text(table, texts[k]);
    }
    return put_table(table, request, report);
}

static enum status columns_table(const struct catalogue *c, const struct request *request, struct arena *life,
                                 struct report *report)
{
    static const struct table_column columns[] = {{"column", NULL, 0}, {"unit", NULL, 0}, {"brief", NULL, 0}};
    struct table *table = table_open(columns, 3, life);
    for (int i = 0; i < c->n; i++) {
        table_text(table, c->column[i].name);
        table_text(table, c->column[i].unit ? c->column[i].unit : "");
        table_text(table, c->column[i].brief);
    }
    return put_table(table, request, report);
}

static void key_row(struct table *table, const struct section *s, const struct key *k)
{
    table_text(table, s->path);
    table_text(table, s->word ? s->word : "");
    table_text(table, k->name);
    table_text(table, page_type(k));
    table_text(table, k->unit ? k->unit : "");
    table_text(table, k->flags & KEY_REQUIRED ? "yes" : "no");
    table_text(table, k->fallback ? k->fallback : "");
    table_text(table, k->brief);
}

/* paths: ends with NULL; NULL: all. */
static enum status sections_table(const char *const *paths, const struct request *request, struct arena *life,
                                  struct report *report)
{
    static const struct table_column columns[] = {{"section", NULL, 0}, {"kind", NULL, 0}, {"key", NULL, 0},
                                                  {"type", NULL, 0},    {"unit", NULL, 0}, {"required", NULL, 0},
                                                  {"default", NULL, 0}, {"brief", NULL, 0}};
    struct table *table = table_open(columns, 8, life);
    struct section s;
    for (int i = 0; sim_section(&s, i, life); i++) {
        bool wanted = !paths;
        for (const char *const *p = paths; p && *p && !wanted; p++) wanted = strcmp(*p, s.path) == 0;
        for (const struct key *k = s.keys; wanted && k && k->name; k++) key_row(table, &s, k);
    }
    return put_table(table, request, report);
}

static enum status print_columns(const struct request *request, struct arena *life, struct report *report)
{
    struct request one = *request;
    struct scene *scene;
    struct diags *diags = NULL;
    struct sim sim;
    const struct sim_options options = {.version = FMDSUB_VERSION, .drawn = true};
    if (request->nword != 2)
        return fail(report, E_USAGE, "'fmdsub list columns' takes one deck%s",
                    request->nword > 2 ? "" : "; '-' is standard input");
    one.nword--;
    one.word++;
    enum status status = cli_load(&scene, &diags, &one, life, report);
    if (status == OK) status = sim_open(&sim, scene, &scene->integrate, &options, diags, life, report);
    TRY(cli_told(diags, request, status));
    if (request->format) return columns_table(&sim.catalogue, request, life, report);
    for (int i = 0; i < sim.catalogue.n; i++) {
        const struct column *c = &sim.catalogue.column[i];
        printf("%-24s %-8s %s\n", c->name, c->unit ? c->unit : "-", c->brief);
    }
    return OK;
}

/* ---- names alone ---- */

/* The next of a paragraph of words. */
struct words {
    int column;
    const char *last;
};

static void put_word(struct words *o, const char *word)
{
    enum { INDENT = 12, WIDE = 78 };
    if (!word || (o->last && strcmp(o->last, word) == 0)) return;
    if (o->last) printf(",");
    if (o->last && o->column + (int)strlen(word) + 2 > WIDE) {
        printf("\n%*s", INDENT, "");
        o->column = INDENT;
    } else if (o->last) {
        printf(" ");
    }
    if (!o->last) o->column = INDENT;
    o->column += (int)strlen(word) + 2;
    printf("%s", word);
    o->last = word;
}

static void put_kinds(const char *topic, const char *path, struct arena *life)
{
    struct words words = {0};
    struct section s;
    printf("%-12s", topic);
    for (int i = 0; sim_section(&s, i, life); i++)
        if (strcmp(s.path, path) == 0) put_word(&words, s.word);
    printf("\n");
}

/* The deck's own sections. */
static void put_sections(struct arena *life)
{
    struct words words = {0};
    struct section s;
    printf("%-12s", "sections");
    for (int i = 0; sim_section(&s, i, life); i++)
        for (const struct key *k = s.keys; !*s.path && k->name; k++) put_word(&words, k->name);
    printf("\n");
}

static void print_short(struct arena *life)
{
    struct words words = {0};
    printf("%-12s", "schemes");
    for (int i = 0; stepper_kinds[i]; i++) put_word(&words, stepper_kinds[i]->name);
    printf("\n");
    put_kinds("joints", "constraints.NAME", life);
    put_kinds("forces", "forces.NAME", life);
    put_kinds("measures", "measures.NAME", life);
    put_kinds("surfaces", "surfaces.NAME", life);
    printf("%-12scontact, stop, friction\n", "contacts");
    printf("%-12s", "effects");
    words = (struct words){0};
    for (int i = 0; i < EFFECTS; i++) put_word(&words, effect_kinds[i].name);
    printf("\n");
    put_sections(life);
    printf("\n`fmdsub list TOPIC` says what each is and takes: schemes, joints, forces, contacts, friction, effects,\n"
           "sections, columns DECK; with -f json or csv as a table\n");
}

/* ---- the verb ---- */

static const char *const contact_paths[] = {"surfaces.NAME",
                                            "contacts.NAME",
                                            "contacts.NAME.friction",
                                            "constraints.NAME.range",
                                            "constraints.NAME.range.hold",
                                            "constraints.NAME.friction",
                                            NULL};

static void print_paths(const char *const *paths, struct arena *life)
{
    for (; paths && *paths; paths++) print_sections(*paths, life);
}

/* What consists of sections of the deck: NULL: all of them. */
static bool topic_paths(const char *const **paths, const char *topic)
{
    static const char *const joints[] = {"constraints.NAME", NULL}, *const forces[] = {"forces.NAME", NULL},
                             *const friction[] = {"contacts.NAME.friction", "constraints.NAME.friction", NULL};
    static const struct {
        const char *topic;
        const char *const *paths;
    } topics[] = {{"joints", joints},
                  {"forces", forces},
                  {"contacts", contact_paths},
                  {"friction", friction},
                  {"sections", NULL}};
    for (size_t i = 0; i < sizeof topics / sizeof *topics; i++) {
        *paths = topics[i].paths;
        if (strcmp(topics[i].topic, topic) == 0) return true;
    }
    return false;
}

static enum status unknown_topic(const char *topic, struct report *report)
{
    static const char *const topics[] = {"schemes",  "joints",  "forces",   "contacts",
                                         "friction", "effects", "sections", "columns"};
    const char *nearest = text_nearest(topic, topics, (int)(sizeof topics / sizeof *topics));
    return fail(
        report, E_USAGE,
        "no list of '%.40s'%s%s%s (schemes, joints, forces, contacts, friction, effects, sections, columns DECK)",
        topic, nearest ? ": did you mean '" : "", nearest ? nearest : "", nearest ? "'?" : "");
}

enum status verb_list(const struct request *request, struct arena *life, struct report *report)
{
    const char *topic = request->nword ? request->word[0] : "";
    const char *const *paths;
    if (strcmp(topic, "columns") == 0) return print_columns(request, life, report);
    if (strcmp(topic, "page") == 0) return page_print(stdout, request->nword - 1, request->word + 1, report);
    if (strcmp(topic, "completion") == 0)
        return completion_print(stdout, request->nword - 1, request->word + 1, report);
    if (request->nset) return fail(report, E_USAGE, "--set changes a deck: only 'fmdsub list columns DECK' reads one");
    if (request->nword > 1) return fail(report, E_USAGE, "'fmdsub list %.40s' takes nothing more", topic);
    if (strcmp(topic, "schemes") == 0) {
        if (request->format) return schemes_table(request, life, report);
        print_schemes();
    } else if (strcmp(topic, "effects") == 0) {
        if (request->format) return effects_table(request, life, report);
        print_effects();
    } else if (!request->nword && !request->format) {
        print_short(life);
    } else if (!request->nword || topic_paths(&paths, topic)) {
        if (!request->nword) paths = NULL;
        if (request->format) return sections_table(paths, request, life, report);
        if (paths)
            print_paths(paths, life);
        else
            print_sections(NULL, life);
    } else {
        return unknown_topic(topic, report);
    }
    return OK;
}
