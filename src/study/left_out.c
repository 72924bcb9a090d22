/* left_out.c -- see left_out.h */
#include "study/left_out.h"

#include <math.h>
#include <string.h>

#include "base/stop.h"
#include "sim/neglects.h"
#include "study/auto.h"

static const double MOST = 5; /* [s] of CPU by price: of the run that is compared */
enum { MOST_NUMBERS = 1 << 23 };

/* ---- kept -------------------------------------------------------------------------------------------------------- */

static bool within(const struct left_out *o)
{
    const struct sim *sim = o->sim;
    const struct stepper *s = &sim->stepper;
    if ((o->first.kept.rows + 1) * (double)o->first.kept.n > MOST_NUMBERS) return false;
    return price_whole(&o->price, s->kind, &s->effort) <= MOST;
}

static enum status take_meta(struct sink *sink, const struct run_meta *meta, struct report *report)
{
    struct left_out *o = sink->self;
    o->first.kept.n = meta->n;
    return sink_meta(o->to, meta, report);
}

static enum status take_row(struct sink *sink, const double *x, struct report *report)
{
    struct left_out *o = sink->self;
    o->cut = o->cut || !within(o);
    if (!o->cut) outcome_keep(&o->first.kept, x, o->own);
    return o->to->ops->row(o->to, x, report);
}

static enum status take_event(struct sink *sink, double t, const char *kind, const char *text, struct report *report)
{
    struct left_out *o = sink->self;
    return sink_event(o->to, t, kind, text, report);
}

static enum status take_tick(struct sink *sink, double now, struct report *report)
{
    struct left_out *o = sink->self;
    return sink_tick(o->to, now, report);
}

/* ---- compared ---------------------------------------------------------------------------------------------------- */

/* A column's largest change, and when it is more than `limit` [s]; -1: never. */
struct change {
    double most, t;
    int common; /* instants */
};

static struct change compare(const struct flip *a, int i, const struct flip *b, int k, double limit)
{
    struct change o = {0, -1, 0};
    for (int row[2] = {-1, -1}; outcome_next(row, &a->kept, &b->kept);) {
        const double *y = outcome_row(&b->kept, row[1]), d = fabs(y[k] - outcome_row(&a->kept, row[0])[i]);
        o.common++;
        o.most = fmax(o.most, d);
        if (o.t < 0 && d > limit) o.t = y[0];
    }
    return o;
}

/* Places, angles, rates and stresses are judged; forces and accelerations stand beside; energies tell of the effect itself. */
enum sort { MOVES, ACTS, BOOKED };

static enum sort sort_of(const struct outcome_column *c)
{
    static const struct {
        const char *unit;
        enum sort sort;
    } units[] = {{"N", ACTS},   {"N m", ACTS},   {"m/s2", ACTS}, {"rad/s2", ACTS},
                 {"N s", ACTS}, {"N m s", ACTS}, {"J", BOOKED},  {"W", BOOKED}};
    for (size_t i = 0; c->unit && i < sizeof units / sizeof *units; i++)
        if (strcmp(c->unit, units[i].unit) == 0) return units[i].sort;
    return MOVES;
}

/* Differences of runs that choose their steps are their errors, too [of a column's range]. */
static double noise(const struct sim *sim)
{
    return sim->stepper.kind->adaptive && sim->trust.known && sim->trust.column >= 0 ? sim->trust.worst : 0;
}

static struct neglect_found find(const struct left_out *o, const struct flip *with, enum sort sort)
{
    const struct flip *run = &o->first;
    const double limit = fmax(o->sim->scene->effects.tolerance, noise(o->sim));
    struct neglect_found found = {.t = -1, .until = fmin(with->until, run->until)};
    for (int i = 1; i < with->kept.n; i++) {
        const int k = flip_column(run, with->column[i].name);
        if (k < 0 || !with->column[i].compared || sort_of(&with->column[i]) != sort) continue;
        const double usual = flip_usual(with, i, run, k);
        const struct change c = compare(with, i, run, k, limit * usual);
        if (c.common < 2) continue; /* the start tells nothing */
        const double share = c.most > 0 ? c.most / usual : 0;
        if (c.t >= 0 && (found.t < 0 || c.t < found.t)) found.t = c.t;
        if (found.known && !(share > found.share)) continue;
        found.known = true;
        found.share = share;
        found.column = with->column[i].name;
    }
    if (found.share <= noise(o->sim)) found.t = -1;
    return found;
}

/* A run that ends by what happens may end at another time. */
static void add_end(struct neglect_found *found, const struct left_out *o, const struct flip *with)
{
    const double first = fmin(with->until, o->first.until), last = fmax(with->until, o->first.until);
    const double share = (last - first) / (last - o->sim->model->t0);
    if (o->cut || !(last > first) || (found->known && share <= found->share)) return;
    if (share > o->sim->scene->effects.tolerance && found->t < 0) found->t = first;
    found->known = true;
    found->share = share;
    found->column = o->first.column[0].name;
    found->until = o->sim->x.t;
}

static void run_with(struct left_out *o, enum effect_id id)
{
    struct scene *scene;
    struct report report = {0};
    struct flip with;
    if (stop || o->load(&scene, o->self, effect_bit(id), o->own) != OK) return;
    auto_same(scene, o->sim->scene);
    if (flip_run(&with, scene, o->cut ? o->first.until : 0, diags_open(o->own), o->own, &report) != OK) return;
    if (with.kept.status != OK && with.kept.status != E_VERDICT) return;
    struct neglect_found moved = find(o, &with, MOVES), acts = find(o, &with, ACTS);
    if (!moved.known) moved = acts;
    add_end(&moved, o, &with);
    moved.noise = noise(o->sim);
    moved.acts = acts.share;
    moved.acting = acts.column;
    o->sim->neglects.found[id] = moved;
}

static void run_all(struct left_out *o)
{
    struct flip *f = &o->first;
    f->column = outcome_columns(o->sim, o->own);
    f->until = f->kept.rows ? outcome_row(&f->kept, f->kept.rows - 1)[0] : 0;
    if (f->kept.rows < 2) return;
    for (int i = 0; i < EFFECTS; i++)
        if (neglects_unsettled(o->sim, (enum effect_id)i)) run_with(o, (enum effect_id)i);
}

static enum status take_end(struct sink *sink, const struct run_summary *summary, struct report *report)
{
    struct left_out *o = sink->self;
    struct pair facts[MOST_SIM_FACTS];
    (void)summary;
    if (o->sim->status == OK || o->sim->status == E_VERDICT) run_all(o);
    const struct run_summary all = {.n = sim_facts(o->sim, facts, MOST_SIM_FACTS), .facts = facts};
    return sink_end(o->to, &all, report);
}

static const struct sink_ops ops = {
    .meta = take_meta, .row = take_row, .event = take_event, .end = take_end, .tick = take_tick};

/* Of the same scene: looking at the run's own loops would move it. */
static bool price(struct left_out *o)
{
    const struct sim_options options = {0};
    struct report report = {0};
    struct sim other;
    struct diags *diags = diags_open(o->own);
    if (sim_open(&other, o->sim->scene, &o->sim->plan, &options, diags, o->own, &report) != OK) return false;
    price_find(&o->price, &other);
    return true;
}

struct sink *left_out_open(struct left_out *o, struct sim *sim, struct sink *to, struct arena *life)
{
    if (!sim->model->off || sim->place.resumed || sim->saves.stream) return to;
    o->to = to;
    o->sim = sim;
    o->own = arena_within(life);
    if (!price(o)) return to;
    o->sink = (struct sink){&ops, o};
    return &o->sink;
}
