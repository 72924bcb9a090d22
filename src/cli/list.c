/* list.c -- fmdsub list: schemes, joints, forces, sections of a deck with their keys, columns of a deck */
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "cli/cli.h"
#include "cli/page.h"
#include "multirate/schemes.h"
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

static void print_schemes(void)
{
    for (int i = 0; stepper_kinds[i]; i++)
        printf("%-17s order %d%s%s  %s\n", stepper_kinds[i]->name, stepper_kinds[i]->order,
               stepper_kinds[i]->two_rates ? ", two rates" : "", stepper_kinds[i]->adaptive ? ", own steps" : "",
               stepper_kinds[i]->brief);
}

static void print_effects(void)
{
    for (int i = 0; i < EFFECTS; i++) {
        const struct effect_kind *e = &effect_kinds[i];
        printf("%s: %s\n    tells      %s\n    left out   %s\n    costs      %s\n    watched    %s\n", e->name,
               e->brief, e->evidence, e->threshold, e->cost, e->watched);
    }
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
    if (diags) diags_print(stderr, diags, cli_color(request));
    TRY(status);
    for (int i = 0; i < sim.catalogue.n; i++) {
        const struct column *c = &sim.catalogue.column[i];
        printf("%-24s %-8s %s\n", c->name, c->unit ? c->unit : "-", c->brief);
    }
    return OK;
}

enum status verb_list(const struct request *request, struct arena *life, struct report *report)
{
    static const char *const topics[] = {"schemes", "joints", "forces", "contacts", "effects", "sections", "columns"};
    const char *topic = request->nword ? request->word[0] : "";
    bool one_word = strcmp(topic, "columns") != 0 && strcmp(topic, "page") != 0 && strcmp(topic, "completion") != 0;
    if (one_word && request->nword > 1) return fail(report, E_USAGE, "'fmdsub list %.40s' takes nothing more", topic);
    if (!*topic) {
        printf("schemes\n");
        print_schemes();
        printf("\n");
        print_sections(NULL, life);
    } else if (strcmp(topic, "schemes") == 0) {
        print_schemes();
    } else if (strcmp(topic, "joints") == 0) {
        print_sections("constraints.NAME", life);
    } else if (strcmp(topic, "forces") == 0) {
        print_sections("forces.NAME", life);
    } else if (strcmp(topic, "effects") == 0) {
        print_effects();
    } else if (strcmp(topic, "contacts") == 0) {
        static const char *const paths[] = {"surfaces.NAME", "contacts.NAME", "contacts.NAME.friction",
                                            "constraints.NAME.range", "constraints.NAME.range.hold"};
        for (int i = 0; i < 5; i++) print_sections(paths[i], life);
    } else if (strcmp(topic, "sections") == 0) {
        print_sections(NULL, life);
    } else if (strcmp(topic, "columns") == 0) {
        return print_columns(request, life, report);
    } else if (strcmp(topic, "page") == 0) {
        return page_print(stdout, request->nword - 1, request->word + 1, report);
    } else if (strcmp(topic, "completion") == 0) {
        return completion_print(stdout, request->nword - 1, request->word + 1, report);
    } else {
        const char *nearest = text_nearest(topic, topics, (int)(sizeof topics / sizeof *topics));
        return fail(report, E_USAGE,
                    "no list of '%.40s'%s%s%s (schemes, joints, forces, contacts, effects, sections, columns DECK)",
                    topic, nearest ? ": did you mean '" : "", nearest ? nearest : "", nearest ? "'?" : "");
    }
    return OK;
}
