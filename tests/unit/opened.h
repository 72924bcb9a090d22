/* opened.h -- decks in a test's text, opened and run; columns by name */
#ifndef FMDSUB_TESTS_OPENED_H
#define FMDSUB_TESTS_OPENED_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "sim/load.h"
#include "sim/parts.h"

#include <cmocka.h>

#ifndef OPENED_HEAD
#define OPENED_HEAD "fmdsub: 1\n" /* what each of these decks begins with */
#endif

struct opened {
    struct arena *life;
    struct scene *scene;
    struct sim sim;
    struct report report;
};

static void write_file(const char *path, const char *head, const char *text)
{
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    fprintf(f, "%s%s\n", head, text);
    fclose(f);
}

/* beside: the text of body.json in the deck's folder; NULL: none. */
static void open_beside(struct opened *o, const char *text, const char *beside)
{
    char folder[] = "/tmp/t-flexible-XXXXXX", path[60], file[60];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/deck.yaml", folder);
    snprintf(file, sizeof file, "%s/body.json", folder);
    write_file(path, OPENED_HEAD, text);
    if (beside) write_file(file, "", beside);
    const struct sim_options options = {.version = "test"};
    o->report = (struct report){0};
    o->life = arena_open();
    struct diags *diags = diags_open(o->life);
    enum status status = sim_load(&o->scene, path, NULL, diags, o->life, &o->report);
    if (status == OK) status = sim_open(&o->sim, o->scene, &o->scene->integrate, &options, diags, o->life, &o->report);
    unlink(path);
    unlink(file);
    rmdir(folder);
    if (status == OK) return;
    diags_print(stderr, diags, false);
    fail_msg("%s", o->report.text);
}

static inline void open_deck(struct opened *o, const char *text)
{
    open_beside(o, text, NULL);
}

/* The column's value now. */
static inline double value(struct opened *o, const char *name)
{
    const struct catalogue *c = &o->sim.catalogue;
    struct sim *s = &o->sim;
    assert_int_equal(record_evaluate(s, ~0u), OK);
    for (int i = 0; i < c->n; i++)
        if (strcmp(c->column[i].name, name) == 0) return record_value(s, &c->origin[i]);
    fail_msg("no column %s", name);
    return 0;
}

static inline void run(struct opened *o)
{
    enum status status = sim_run(&o->sim, NULL, &o->report);
    if (status != OK) fail_msg("%s", o->report.text);
}

static inline void near(double x, double want, double within)
{
    if (fabs(x - want) <= within) return;
    fail_msg("%.17g, should be %.17g within %g", x, want, within);
}

#endif
