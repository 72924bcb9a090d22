/* state.c -- a state by names: `initial: {from: FILE}` and `--final-state FILE`.
 *
 * The file is JSON, which is YAML, too: every coordinate and every rate of the tree by its column name, as the
 * shortest text that reads back to the same double.  Orientations are their quaternions, since turns about axes would not
 * come back exactly; of measured angles in space, which a posture gives up to whole turns, the file holds where they
 * stand.  Then what the integrator carries from step to step (memory.c), so that a run goes on where another one ended,
 * bit for bit, and a checksum of all of it. */
#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "base/hash.h"
#include "base/text.h"
#include "deck/read.h"
#include "out/number.h"
#include "out/stream.h"
#include "sim/parts.h"

enum { HASH_DIGITS = 16, MEMORY_MOST = DECK_BYTES / 2 };

static bool is_state(const struct origin *s)
{
    return s->kind->use == USE_POSITION || s->kind->use == USE_RATE;
}

static int place(const struct catalogue *c, const char *name)
{
    for (int i = 0; i < c->n; i++)
        if (is_state(&c->origin[i]) && strcmp(c->column[i].name, name) == 0) return i;
    return -1;
}

static void report_unknown(const struct catalogue *c, const struct node *n, struct reader *rd, struct arena *life)
{
    const char **names = TAKE(life, const char *, c->n);
    int count = 0;
    for (int i = 0; i < c->n; i++)
        if (is_state(&c->origin[i])) names[count++] = c->column[i].name;
    read_unknown(n, AT_KEY, "E-unknown-coordinate", "coordinate or rate", n->key, names, count, rd);
}

static void report_missing(const struct catalogue *c, const bool *given, const struct node *at, struct diags *diags)
{
    const char *first = NULL;
    int missing = 0;
    for (int i = 0; i < c->n; i++) {
        if (!is_state(&c->origin[i]) || given[i]) continue;
        if (!first) first = c->column[i].name;
        missing++;
    }
    if (missing == 1) diag_error(diags, at, AT_VALUE, "E-state", "the state has no '%.80s'", first);
    if (missing > 1)
        diag_error(diags, at, AT_VALUE, "E-state", "the state has no '%.80s', and %d more are missing", first,
                   missing - 1);
}

/* Quaternions that were written have length 1 but for round-off, and stay as they are. */
static void check_quaternions(const struct model *m, const double *q, const struct node *at, struct diags *diags)
{
    for (int i = 0; i < m->njoint; i++) {
        const struct model_joint *j = &m->joint[i];
        if (j->nq == j->nv) continue;
        const double *p = &q[j->iq[j->nq - 4]];
        double square = p[0] * p[0] + p[1] * p[1] + p[2] * p[2] + p[3] * p[3];
        if (!(fabs(square - 1) <= 1e-9))
            diag_error(diags, at, AT_VALUE, "E-quaternion", "the quaternion of '%.80s' has length %.6g", j->name,
                       sqrt(square));
    }
}

/* ---- whose it is ----------------------------------------------------------------------------------------------- */

/* Members of the map n, but for its checksum. */
static uint64_t check_of(uint64_t hash, const struct node *n)
{
    for (int i = 0; i < n->count; i++) {
        const struct node *x = n->item[i];
        if (x->implied || strcmp(x->key, "check") == 0) continue;
        hash = hash_bytes(hash, x->key, strlen(x->key) + 1);
        hash = x->type == NODE_MAP ? check_of(hash, x) : x->text ? hash_bytes(hash, x->text, strlen(x->text) + 1) : 0;
    }
    return hash;
}

static bool is_hash(const struct node *n, uint64_t hash)
{
    char text[HASH_DIGITS + 1];
    snprintf(text, sizeof text, "%016" PRIx64, hash);
    return n && n->text && strcmp(n->text, text) == 0;
}

static const struct node *named_at(const struct sim *sim)
{
    return node_find(node_find(sim->scene->deck->root, "initial"), "from");
}

static void check_whole(const struct scene *scene, struct diags *diags)
{
    const struct node *check = node_find(scene->left, "check");
    if (!check || check->implied || is_hash(check, check_of(HASH_NOTHING, scene->left))) return;
    diag_error(diags, check, AT_VALUE, "E-state",
               "the state is not as it was written: something in this file has been changed, or is damaged");
    diag_hint(diags, "write it anew with --final-state; where it was edited on purpose, take out 'check', 'deck' and "
                     "'memory', and set 'deck: any' beside 'from'");
}

static void check_deck(const struct sim *sim, struct diags *diags)
{
    const struct node *deck = node_find(sim->scene->left, "deck");
    if (sim->scene->any_deck || is_hash(deck, memory_of_deck(sim))) return;
    diag_error(diags, named_at(sim), AT_VALUE, "E-state",
               deck && !deck->implied ? "the state is of another deck, or this one has been changed since"
                                      : "the state does not tell which deck it is of");
    diag_hint(diags, "'deck: any' beside 'from' takes its coordinates and rates all the same");
}

/* ---- taken ----------------------------------------------------------------------------------------------------- */

enum status state_take(const struct sim *sim, struct model *m, struct diags *diags, struct arena *life)
{
    const struct node *from = sim->scene->from;
    const struct catalogue *c = &sim->catalogue;
    if (!from) return OK;
    check_whole(sim->scene, diags);
    TRY(diags_status(diags));
    struct reader rd = {.diags = diags, .deck = (struct deck *)sim->scene->deck, .space = sim->scene->space};
    double *q = TAKE(life, double, m->nq), *v = TAKE(life, double, m->n);
    bool *given = TAKE(life, bool, c->n);
    for (int k = 0; k < from->count; k++) {
        const struct node *n = from->item[k];
        int i = place(c, n->key);
        double x = 0;
        if (i < 0) { /* the state of another deck: one word is enough */
            report_unknown(c, n, &rd, life);
            return diags_status(diags);
        }
        read_number(&x, n, NULL, &rd);
        given[i] = true;
        if (c->origin[i].index >= 0) (c->origin[i].kind->use == USE_POSITION ? q : v)[c->origin[i].index] = x;
    }
    if (diags_status(diags) == OK) report_missing(c, given, from, diags);
    if (diags_status(diags) == OK) check_deck(sim, diags);
    if (diags_status(diags) == OK) check_quaternions(m, q, from, diags);
    m->q0 = q;
    m->v0 = v;
    m->given_q = memset(TAKE(life, bool, m->nq), true, (size_t)m->nq * sizeof(bool));
    m->given_v = memset(TAKE(life, bool, m->n), true, (size_t)m->n * sizeof(bool));
    return diags_status(diags);
}

/* An angle in space, which a posture gives up to whole turns: of a measure, of a joint that closes a loop. */
static bool counts_turns(const struct sim *sim, const struct origin *o)
{
    const struct model *m = sim->model;
    if (o->kind->use == USE_TURNS) return follows_turns(sim);
    return o->kind->use == USE_COUNTED && m->space == 3 && m->measure[o->index].type == MEASURE_ANGLE;
}

enum status state_turns(struct sim *sim, struct diags *diags)
{
    const struct node *angles = sim->scene->angles;
    const struct catalogue *c = &sim->catalogue;
    struct reader rd = {.diags = diags, .deck = (struct deck *)sim->scene->deck, .space = sim->scene->space};
    for (int i = 0; angles && i < c->n; i++) {
        const struct origin *o = &c->origin[i];
        const struct node *n = counts_turns(sim, o) ? node_find(angles, c->column[i].name) : NULL;
        double x = 0;
        if (!n) continue;
        read_number(&x, n, NULL, &rd);
        if (o->kind->use == USE_TURNS)
            system_set_loop_coordinate(sim->system, o->index, o->k, x);
        else
            system_set_measure(sim->system, o->index, x);
    }
    return diags_status(diags);
}

/* ---- written --------------------------------------------------------------------------------------------------- */

/* The file under way, and the checksum of what it holds so far. */
struct writing {
    struct stream *stream;
    struct report *report;
    uint64_t check;
};

/* Lines that hold no values. */
static enum status mark(struct writing *w, const char *line)
{
    return stream_put(w->stream, line, strlen(line), w->report);
}

/* `"name": value`; names and values hold nothing that JSON would escape. */
static enum status put(struct writing *w, const char *name, const char *value, const char *quote, const char *end)
{
    char *to = stream_begin(w->stream, strlen(name) + strlen(value) + 16);
    to += sprintf(to, "\"%s\": %s%s%s%s\n", name, quote, value, quote, end);
    w->check = hash_bytes(w->check, name, strlen(name) + 1);
    w->check = hash_bytes(w->check, value, strlen(value) + 1);
    return stream_end(w->stream, to, w->report);
}

static enum status put_text(struct writing *w, const char *name, const char *value, const char *end)
{
    return put(w, name, value, "\"", end);
}

static enum status put_number(struct writing *w, const char *name, double x, const char *end)
{
    char text[NUMBER_MOST + 1];
    text[number_write(text, x)] = 0;
    return put(w, name, text, "", end);
}

static enum status put_hash(struct writing *w, const char *name, uint64_t hash, const char *end)
{
    char text[HASH_DIGITS + 1];
    snprintf(text, sizeof text, "%016" PRIx64, hash);
    return put_text(w, name, text, end);
}

/* A map begins: its name counts, as those of values do. */
static enum status open_map(struct writing *w, const char *name)
{
    char line[40];
    snprintf(line, sizeof line, "\"%s\": {\n", name);
    w->check = hash_bytes(w->check, name, strlen(name) + 1);
    return mark(w, line);
}

static enum status put_tree(const struct sim *sim, struct writing *w)
{
    const struct model *m = sim->model;
    struct arena *scratch = arena_open();
    size_t len = 1;
    for (int i = 0; i < m->njoint; i++) len += strlen(m->joint[i].name) + 1;
    char *text = TAKE(scratch, char, len), *to = text;
    for (int i = 0; i < m->njoint; i++)
        if (!m->body[m->joint[i].child].at_node) to += sprintf(to, "%s%s", to > text ? " " : "", m->joint[i].name);
    const enum status status = put_text(w, "tree", text, ",");
    arena_close(scratch);
    return status;
}

static int count_angles(const struct sim *sim)
{
    int n = 0;
    for (int i = 0; i < sim->catalogue.n; i++) n += counts_turns(sim, &sim->catalogue.origin[i]);
    return n;
}

static enum status put_angles(const struct sim *sim, struct writing *w)
{
    const struct catalogue *c = &sim->catalogue;
    int left = count_angles(sim);
    if (!left) return OK;
    TRY(open_map(w, "angles"));
    for (int i = 0; i < c->n; i++)
        if (counts_turns(sim, &c->origin[i]))
            TRY(put_number(w, c->column[i].name, record_value(sim, &c->origin[i]), --left ? "," : ""));
    return mark(w, "},\n");
}

static enum status put_state(const struct sim *sim, struct writing *w)
{
    const struct catalogue *c = &sim->catalogue;
    int last = 0;
    for (int i = 0; i < c->n; i++)
        if (is_state(&c->origin[i])) last = i;
    TRY(open_map(w, "state"));
    for (int i = 0; i < c->n; i++)
        if (is_state(&c->origin[i]))
            TRY(put_number(w, c->column[i].name, record_value(sim, &c->origin[i]), i < last ? "," : ""));
    return mark(w, "},\n");
}

static enum status put_memory(struct sim *sim, struct writing *w)
{
    struct arena *scratch = arena_open();
    struct recall r;
    recall_keep(&r, scratch);
    enum status status = memory_recall(sim, &r);
    const bool fits = status == OK && r.size < MEMORY_MOST;
    if (!fits && sim->options.log)
        fprintf(sim->options.log, "final state: without what the integrator carries: that takes too much\n");
    status = fits ? open_map(w, "memory") : OK;
    if (fits && status == OK) status = put_hash(w, MEMORY_STEPS, memory_of_steps(sim), ",");
    for (int i = 0; fits && status == OK && i < r.n; i++)
        status = put_text(w, r.span[i].name, r.span[i].text, i < r.n - 1 ? "," : "");
    arena_close(scratch);
    TRY(status);
    return fits ? mark(w, "},\n") : OK;
}

enum status sim_write_state(struct sim *sim, struct stream *stream, struct report *report)
{
    struct writing w = {stream, report, HASH_NOTHING};
    const bool follows = sim->model->nloop || count_angles(sim); /* then their rates are to be found */
    TRY(record_evaluate(sim, follows ? EVALUATE_MOTION : EVALUATE_NOTHING));
    TRY(mark(&w, "{\n"));
    TRY(put_number(&w, "fmdsub_state", 2, ","));
    TRY(put_number(&w, "t", sim->x.t, ","));
    TRY(put_text(&w, "last_step", sim->cut ? "cut" : "whole", ","));
    TRY(put_hash(&w, "deck", memory_of_deck(sim), ","));
    TRY(put_tree(sim, &w));
    const double length = system_start_length(sim->system);
    if (length > 0) TRY(put_number(&w, "length", length, ","));
    TRY(put_angles(sim, &w));
    TRY(put_state(sim, &w));
    TRY(put_memory(sim, &w));
    TRY(put_hash(&w, "check", w.check, "}"));
    return OK;
}
