/* state.c -- a state by names: `initial: {from: FILE}` and `--final-state FILE`.
 *
 * The file is JSON, which is YAML, too: every coordinate and every rate of the tree by its column name, as the
 * shortest text that reads back to the same double, so that a run goes on where another one ended, bit for bit.
 * Orientations are their quaternions, since turns about axes would not come back exactly; of measured angles in space,
 * which a posture gives up to whole turns, the file holds where they stand. */
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "deck/read.h"
#include "out/number.h"
#include "out/stream.h"
#include "sim/parts.h"

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

enum status state_take(const struct sim *sim, struct model *m, struct diags *diags, struct arena *life)
{
    const struct node *from = sim->scene->from;
    const struct catalogue *c = &sim->catalogue;
    if (!from) return OK;
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
        (c->origin[i].kind->use == USE_POSITION ? q : v)[c->origin[i].index] = x;
    }
    if (diags_status(diags) == OK) report_missing(c, given, from, diags);
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

/* `"name": x` lines; names of columns hold nothing that JSON would escape. */
static enum status put(struct stream *s, const char *name, double x, const char *end, struct report *report)
{
    char *to = stream_begin(s, strlen(name) + NUMBER_MOST + 16);
    to += sprintf(to, "\"%s\": ", name);
    to += number_write(to, x);
    to += sprintf(to, "%s\n", end);
    return stream_end(s, to, report);
}

static int count_angles(const struct sim *sim)
{
    int n = 0;
    for (int i = 0; i < sim->catalogue.n; i++) n += counts_turns(sim, &sim->catalogue.origin[i]);
    return n;
}

static enum status put_angles(const struct sim *sim, struct stream *stream, struct report *report)
{
    static const char open[] = "\"angles\": {\n", close[] = "},\n";
    const struct catalogue *c = &sim->catalogue;
    int left = count_angles(sim);
    if (!left) return OK;
    TRY(stream_put(stream, open, sizeof open - 1, report));
    for (int i = 0; i < c->n; i++)
        if (counts_turns(sim, &c->origin[i]))
            TRY(put(stream, c->column[i].name, record_value(sim, &c->origin[i]), --left ? "," : "", report));
    return stream_put(stream, close, sizeof close - 1, report);
}

enum status sim_write_state(struct sim *sim, struct stream *stream, struct report *report)
{
    static const char head[] = "{\"fmdsub_state\": 1,\n", open[] = "\"state\": {\n", close[] = "}}\n";
    const struct catalogue *c = &sim->catalogue;
    int last = 0;
    for (int i = 0; i < c->n; i++)
        if (is_state(&c->origin[i])) last = i;
    if (sim->model->nloop || count_angles(sim)) /* the rates of what follows */
        TRY(record_evaluate(sim, EVALUATE_MOTION));
    TRY(stream_put(stream, head, sizeof head - 1, report));
    TRY(put(stream, "t", sim->x.t, ",", report));
    TRY(put_angles(sim, stream, report));
    TRY(stream_put(stream, open, sizeof open - 1, report));
    for (int i = 0; i < c->n; i++)
        if (is_state(&c->origin[i]))
            TRY(put(stream, c->column[i].name, record_value(sim, &c->origin[i]), i < last ? "," : "", report));
    return stream_put(stream, close, sizeof close - 1, report);
}
