/* memory.c -- what a run carries from step to step, and for whom it is good.
 *
 * Positions and rates make a state, but a step begins with more: predictors, a matrix of some steps ago, the split of the
 * coordinates of loops, whole turns, sums of works.  Every object names its own (base/recall.h).  It is good for the
 * same deck under the same scheme and steps. */
#include <string.h>

#include "base/hash.h"
#include "base/recall.h"
#include "engine/crossed.h"
#include "sim/parts.h"

enum { VERSION = 8 }; /* of the spans: another where a run would not go on the same from older ones */

/* ---- for whom ---- */

uint64_t memory_of_deck(const struct sim *sim)
{
    static const char *const apart[] = {"title",  "parameters", "initial",    "integrate", "output",
                                        "energy", "partition",  "checkpoint", NULL};
    return deck_fingerprint(sim->scene->deck, apart, true);
}

uint64_t memory_of_steps(const struct sim *sim)
{
    static const char *const partition[] = {"partition", NULL};
    const struct integrate *p = &sim->plan;
    const struct model *m = sim->model;
    const struct stepper_kind *kind = sim->stepper.kind;
    const bool natural = sim->stepper.natural;
    const double steps[] = {VERSION, natural ? sim->guess.h : p->step, natural ? sim->guess.ratio : p->ratio};
    uint64_t hash = deck_fingerprint(sim->scene->deck, partition, false);
    hash = hash_bytes(hash, kind->name, strlen(kind->name));
    hash = hash_bytes(hash, steps, sizeof steps);
    for (const struct key *k = kind->keys; k && k->name; k++) {
        const double x = key_value(k, p->options);
        hash = hash_bytes(hash, &x, sizeof x);
    }
    for (int i = 0; i < m->ncoordinate; i++) hash = hash_bytes(hash, &m->coordinate[i].fast, sizeof(bool));
    return hash;
}

/* ---- what ---- */

static void watch_recall(struct watch *o, struct recall *r)
{
    recall_within(r, "watch");
    recall_one(r, "condition", o->was);
    recall_each(r, "side", o->range, side, o->nrange);
    recall_each(r, "reported", o->range, reported, o->nrange);
    recall_without(r);
}

static void jumps_recall(struct sim *sim, struct recall *r)
{
    recall_within(r, "jumps");
    recall_each(r, "t", sim->jump, t, sim->njump);
    recall_each(r, "value", sim->jump, x[0], sim->njump);
    recall_each(r, "rate", sim->jump, x[1], sim->njump);
    recall_each(r, "acceleration", sim->jump, x[2], sim->njump);
    recall_each(r, "most", sim->jump, most, sim->njump);
    recall_each(r, "reported", sim->jump, reported, sim->njump);
    recall_without(r);
}

/* What the run's last words speak of. */
static void extremes_recall(struct sim *sim, struct recall *r)
{
    recall_within(r, "extremes");
    recall_one(r, "min_h", sim->min_h);
    recall_one(r, "turn", sim->turn);
    recall_one(r, "t_turn", sim->t_turn);
    recall_one(r, "turn_joint", sim->turn_joint);
    recall_each(r, "deflection", sim->deflection, most, sim->ndeflection);
    recall_each(r, "t_deflection", sim->deflection, t, sim->ndeflection);
    recall_each(r, "spin", sim->spin, most, sim->nspin);
    recall_each(r, "spin_x", sim->spin, axis[0], sim->nspin);
    recall_each(r, "spin_y", sim->spin, axis[1], sim->nspin);
    recall_each(r, "spin_z", sim->spin, axis[2], sim->nspin);
    recall_each(r, "t_spin", sim->spin, t, sim->nspin);
    recall_each(r, "tilt", sim->tilt, most, sim->ntilt);
    recall_each(r, "t_tilt", sim->tilt, t, sim->ntilt);
    recall_without(r);
}

enum status memory_recall(struct sim *sim, struct recall *r)
{
    recall_one(r, "last_h", sim->last_h);
    recall_list(r, "q", sim->x.q, sim->model->nq);
    recall_list(r, "v", sim->x.v, sim->model->n);
    recall_list(r, "a", sim->x.a, sim->model->n);
    if (recall_has(r, "watch")) watch_recall(&sim->watch, r);
    jumps_recall(sim, r);
    extremes_recall(sim, r);
    ledger_recall(&sim->ledger, r);
    if (sim->stepper.touch) recall_one(r, "struck", sim->ledger.struck);
    if (sim->stepper.touch && sim->model->ndrive > 0) recall_one(r, "cornered", sim->corner.met);
    if (guard_acts(sim)) guard_recall(sim, r);
    if (sim->crossed) crossed_recall(sim->crossed, r);
    system_recall(sim->system, r);
    return stepper_recall(&sim->stepper, r);
}

/* ---- taken back ---- */

/* Why the memory in the state is not for this run; NULL: it is. */
static const char *reason_against(const struct sim *sim)
{
    const struct node *memory = node_find(sim->scene->left, "memory"), *deck = node_find(sim->scene->left, "deck");
    char text[20];
    snprintf(text, sizeof text, "%016llx", (unsigned long long)memory_of_deck(sim));
    if (!deck || !deck->text || strcmp(deck->text, text) != 0) return "it is another deck's";
    if (!memory || memory->implied || memory->type != NODE_MAP) return "nothing else is in it";
    const struct node *steps = node_find(memory, MEMORY_STEPS);
    snprintf(text, sizeof text, "%016llx", (unsigned long long)memory_of_steps(sim));
    return steps && strcmp(steps->text, text) == 0 ? NULL : "scheme, step or partition are others";
}

enum status memory_take(struct sim *sim, struct arena *life, struct report *report)
{
    const struct node *left = sim->scene->left;
    struct recall r;
    if (!left || !sim->scene->keeps || sim->options.counting) return OK;
    sim->forgets = reason_against(sim);
    if (sim->forgets) return OK;
    const struct node *memory = node_find(left, "memory");
    struct recalled *span = TAKE(life, struct recalled, memory->count);
    for (int i = 0; i < memory->count; i++)
        span[i] = (struct recalled){memory->item[i]->key, memory->item[i]->text ? memory->item[i]->text : ""};
    recall_back(&r, span, memory->count);
    TRY(memory_recall(sim, &r));
    if (sim->stepper.kind->starts_anew) sim->forgets = "the scheme begins again at order 1";
    if (!*r.wrong) return OK;
    return fail(report, E_MODEL,
                "no start: what the integrator carried does not fit this run ('%s' in the state's 'memory'); without "
                "'memory' and 'check' the state gives coordinates and rates",
                r.wrong);
}
