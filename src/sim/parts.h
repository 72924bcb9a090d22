/* parts.h -- the parts of a run; private to sim/. */
#ifndef FMDSUB_SIM_PARTS_H
#define FMDSUB_SIM_PARTS_H

#include "sim/sim.h"

/* plan.c: the plan checked against scheme and records */
enum status plan_steps(struct sim *sim, struct diags *diags, struct arena *life, struct report *report);

/* choose.c: the catalogue, and what of it is written */
enum status choose_columns(struct sim *sim, struct diags *diags, struct arena *life, struct report *report);

/* unread.c: warnings of keys that the scheme does not read */
/* Does --set compare another scheme with the deck's, whose key waits for its own? */
bool scheme_is_compared(const struct sim *sim, const struct node *key);
void warn_of_unread(const struct sim *sim, struct diags *diags);

/* advance.c: one major step to `to`, halved where it must be; after the stepper is open */
void advance_open(struct sim *sim, struct arena *life);
enum status advance(struct sim *sim, double h, int ratio, double to);
/* Energies at the present state, and the balance by them. */
enum status look_at_energies(struct sim *sim);
/* Where that is not done with every step: is it due at the end of major step k; record: which is recorded? */
static inline bool look_is_due(const struct sim *sim, long k, bool record)
{
    enum { LOOK_EVERY = 8 };
    return !sim->looks_at_once && ((sim->before + k) % LOOK_EVERY == 0 || k == sim->majors || sim->watch.met ||
                                   (record && sim->needs & NEED_ENERGY));
}
/* One of the steps that are the scheme's own, at most to `to`. */
enum status advance_naturally(struct sim *sim, double to);
/* That step is undone. */
enum status advance_back(struct sim *sim);

/* pulses.c: what comes and goes all at once: times at which a scheme that chooses its steps stops; warnings of loads
 * that do so within one fixed step */
void pulses_stop_at(const struct sim *sim, struct model *m, struct arena *life);
void warn_of_pulses(struct sim *sim, struct diags *diags);

/* loops.c: warnings about the start; the event of a new partition */
void warn_of_loops(const struct sim *sim, struct diags *diags);
/* Why there is no start, with the place of the constraint or of `initial` that it is about. */
enum status sim_no_start(const struct sim *sim, enum status status, const char *why, struct report *report);
const char *sim_loop_kind(const struct sim *sim, int l); /* "constraint" or "drive" */
enum status write_partition(struct sim *sim, struct sink *sink, struct report *report);

/* Do records or conditions read angles of loop joints? */
static inline bool follows_turns(const struct sim *sim)
{
    return (sim->needs | sim->watch.needs) & NEED_TURNS;
}

/* state.c: the model's initial state from the file that the deck names; how far angles have turned there */
enum status state_take(const struct sim *sim, struct model *m, struct diags *diags, struct arena *life);
enum status state_turns(struct sim *sim, struct diags *diags);

/* memory.c: whose a state is: the deck's but for start, end and output; the steps'.  All that a run carries from
 * step to step, kept or taken back: base/recall.h.  From the state that the run goes on from, if that is its own */
#define MEMORY_STEPS "of_steps"
uint64_t memory_of_deck(const struct sim *sim);
uint64_t memory_of_steps(const struct sim *sim);
enum status memory_recall(struct sim *sim, struct recall *r);
enum status memory_take(struct sim *sim, struct arena *life, struct report *report);

/* events.c: the end that the deck describes, joints that leave their range; is there anything of this? */
void events_open(struct sim *sim, struct arena *life);
static inline bool events_watched(const struct sim *sim)
{
    return sim->watch.slot || sim->watch.nrange;
}
enum status events_check(struct sim *sim, struct sink *sink, struct report *report);
/* Is it so at the present state, and was not when last looked at? */
enum status events_happen(bool *is, struct sim *sim);
/* onto.c: when that is in the step that a scheme has chosen and taken last, short of its end; infinity: it is not.
 * Asked again and again of steps onto it, it ends. */
double onto_event(struct sim *sim);

/* contacts.c: rigid contacts: which schemes take them; the start, without overlaps; forces in what records look at;
 * events of the last major step */
enum status contacts_plan(const struct sim *sim, struct diags *diags);
enum status contacts_begin(struct sim *sim, struct report *report);
enum status contacts_press(struct sim *sim);
enum status contacts_events(struct sim *sim, struct sink *sink, struct report *report);
/* guard.c: after energies have been looked at: tells the first loss of the balance */
enum status guard_look(struct sim *sim, struct sink *sink, struct report *report);
/* Does it act on a loss, too (`guard: act` and fixed steps)? */
bool guard_acts(const struct sim *sim);
void guard_open(struct sim *sim);
/* Major steps are taken in 2^depth parts from here. */
void guard_part(struct sim *sim, int depth);
/* And with numerical damping, which is told; false: the scheme has none, or damps already. */
bool guard_damp(struct sim *sim);
void guard_recall(struct sim *sim, struct recall *r);

/* checkpoint.c: at the end of a step, its place in sim->place: is one due?  All that the run needs to go on. */
bool checkpoint_due(struct sim *sim);
enum status checkpoint_write(struct sim *sim, struct report *report);

/* Watches of the step, below: one that has nothing to watch need not be called. */

/* rotations.c: the farthest turn of a ball or free joint in one step */
void rotations_open(struct sim *sim, struct arena *life);
void rotations_note(struct sim *sim, double h, int ratio);
void warn_of_rotations(struct sim *sim);
void warn_of_unresolved(struct sim *sim);

/* deflections.c: the largest deflections of flexible bodies */
void deflections_open(struct sim *sim, struct arena *life);
enum status deflections_note(struct sim *sim);
/* A flexible body that at q bends by more than so many of its lengths; 0: none. */
int deflections_beyond(const struct sim *sim, const double *q, double lengths);
void warn_of_deflections(struct sim *sim);
/* What helps a body that bends too far. */
const char *bending_advice(const struct flex_body *flex);

/* spins.c: the fastest turns of flexible bodies without geometric stiffening */
void spins_open(struct sim *sim, struct arena *life);
void spins_note(struct sim *sim);
bool spins_passed(const struct sim *sim);
void warn_of_spins(struct sim *sim);

/* idle.c: turns that move no mass: held, told and refused where something acts along them, watched */
void idle_open(struct sim *sim, struct arena *life);
enum status idle_begin(struct sim *sim, struct diags *diags, struct report *report);
enum status idle_note(struct sim *sim);
void idle_describe(char *what, size_t size, const struct sim *sim, int turn);

/* inertias.c: bodies of negative inertia, as long as the mass matrix is positive */
void inertias_open(struct sim *sim, struct arena *life);
enum status inertias_note(struct sim *sim);

/* passes.c: forces along distances whose ends come together: refused at the start, reported on the way */
void passes_open(struct sim *sim, struct arena *life);
enum status passes_begin(struct sim *sim, struct diags *diags);
/* Has what only pushes let its ends through each other since the last check?  Such balls went through each other. */
bool passes_through(const struct sim *sim);
enum status passes_check(struct sim *sim, struct sink *sink, struct report *report);

/* tilts.c: the largest rotations of bushings that are shared by convention */
void tilts_open(struct sim *sim, struct arena *life);
void tilts_note(struct sim *sim);
void warn_of_tilts(struct sim *sim);
/* loops.c: how near loops have come to a dead point, three facts or a line; redundant equations that do not say the
 * same to round-off */
int nearest_facts(const struct sim *sim, struct pair *facts);
void print_nearest(const struct sim *sim, FILE *to);
void warn_of_misfits(struct sim *sim);

/* jumps.c: drives that jump in the major step that ends at `to`; the time before which none does from here on, by the corners
 * that are known [s], INFINITY: none does at all */
void jumps_open(struct sim *sim, struct arena *life);
double jumps_clear(const struct sim *sim);
enum status jumps_check(struct sim *sim, double to, struct sink *sink, struct report *report);

/* corners.c: drives whose rate jumps beside friction or closed contacts, in the step from a time; first where steps
 * begin */
void corners_open(struct sim *sim, struct arena *life);
void corners_begin(struct sim *sim);
void corners_note(struct sim *sim, double from);

/* formulas.c: the deck's signals, and then its expressions of columns, join the catalogue */
enum status signals_open(struct sim *sim, struct diags *diags, struct arena *life);
enum status formulas_open(struct sim *sim, struct diags *diags, struct arena *life);

/* flatten.c: steps in a plane where the motion stays in one; after the watches that look at turns in space */
enum status flatten_open(struct sim *sim, struct diags *diags, struct arena *life);
/* Before that: *m := the model without the modes that stay 0 in the plane; with all where the deck asks for them. */
enum status leave_still(struct model **m, struct sim *sim, struct arena *life);

/* record.c: evaluates the system at the present state as far as columns need it (EVALUATE_..., NEED_...); one
 * column, after that */
enum status record_evaluate(struct sim *sim, unsigned needs);
double record_value(const struct sim *sim, const struct origin *o);
/* Does a record look at the bodies, where the steps are?  Then the energies may be had with it. */
bool record_looks(const struct sim *sim);
/* The row where record_evaluate() has been with what it needs; both. */
void record_read(struct sim *sim);
enum status record_fill(struct sim *sim);

/* lateral.c: does a motion that is stepped in a plane stay there in space? */
void lateral_open(struct sim *sim, struct arena *life);
void lateral_note(struct sim *sim);
void lateral_recall(struct sim *sim, struct recall *r);
void warn_of_lateral(struct sim *sim);

/* trust.c: the estimated error of the run (trust.h) */
void trust_open(struct sim *sim, struct arena *life);
/* After advance_open(): with one degree of freedom and no drives errors are propagated (engine/tangent.h). */
void trust_follow(struct sim *sim, struct arena *life);
/* With each step; with each record. */
void trust_step(struct sim *sim);
void trust_note(struct sim *sim);
void trust_recall(struct sim *sim, struct recall *r);
/* The present state and its sums of local errors become the place p; are errors propagated, and have they been? */
void trust_keep(struct sim *sim, struct trust_place *p);
bool trust_follows(const struct sim *sim);
/* trust_find.c: at the end of the run, errors of the columns, and the estimate from them. */
void trust_find(struct sim *sim);
/* trust_why.c: why the steps cannot tell, NULL: they can; does any drive or force depend explicitly on time? */
const char *trust_why(const struct sim *sim);
bool trust_of_time(const struct sim *sim);
/* trust_told.c: the worst column by its error; three facts of the end line; words */
void trust_judge(struct sim *sim);
int trust_facts(const struct sim *sim, struct pair *facts);
void warn_of_trust(struct sim *sim);
void print_trust(const struct sim *sim, FILE *to);

/* growth.c: how fast small differences grow near a place of the run */
struct growth_place {
    double t;    /* [s] */
    double pace; /* fastest velocity over the usual size of its coordinate [1/s] */
    const double *q, *v;
};
/* At how many places that may be looked at for a fiftieth of the evaluations of the run, which has ended. */
int growth_places(const struct sim *sim);
/* The fastest growth rate there [1/s], 0: none; *blur: what round-off of the differences alone may make of it,
 * INFINITY where the rate cannot be had. */
double growth_at(struct sim *sim, const struct growth_place *p, double *blur);

/* neglects.c: what effects turned off by the deck would change */
void neglects_open(struct sim *sim, struct arena *life);
void neglects_note(struct sim *sim);
void neglects_recall(struct sim *sim, struct recall *r);
int neglects_facts(const struct sim *sim, struct pair *facts);
void warn_of_neglects(struct sim *sim);
void print_neglects(const struct sim *sim, FILE *to);

/* rest.c: moves sim->x to a stable static equilibrium near it, at rest.  The kind of TROUBLE_DIVERGED where the one
 * that it stands in is not stable: its index is the coordinate that falls away; and where the search has not come to an
 * end: that which it has moved farthest, by value */
enum { REST_FALLS = 1, REST_GOES_ON };
enum status rest_find(struct sim *sim, struct arena *scratch, struct trouble *why);

/* messages.c: what is said to people */
/* What ends the run, in quotes and with a blank behind. */
void print_condition(const struct sim *sim, FILE *to);
void print_plan(const struct sim *sim);
/* A warning about the run: one line, counted for --strict. */
__attribute__((format(printf, 2, 3))) void sim_warn(struct sim *sim, const char *format, ...);
/* What has been noted of the run and is too much. */
void warn_at_end(struct sim *sim);
void print_end(const struct sim *sim, double wall);
/* FILE:LINE:COLUMN of the node; text. */
const char *place_of(char *text, size_t size, const struct sim *sim, const struct node *node);

/* stops.c: why a run stopped, in words */
/* The force that jumps near here and its values; -1: none does. */
int find_leap(const struct sim *sim, double *before, double *behind);
enum status describe_trouble(const struct sim *sim, const struct trouble *why, enum status status,
                             struct report *report);

/* progress.c: a line on a terminal, rewritten a few times a second */
struct progress {
    FILE *to;
    double start, shown; /* on the clock [s] */
    double from;         /* of the run [s] */
    bool wrote;
    double read;      /* the clock, last */
    int skipped, due; /* since, and then it is read again */
};
void progress_open(struct progress *p, FILE *to, double now, double t);
void progress_show(struct progress *p, double now, double t, double until);
void progress_close(struct progress *p);

/* steps.c: from the start, or where the run goes on, to the end, with all records */
enum status steps_take(struct sim *sim, struct sink *sink, struct progress *progress, struct report *report);

#endif
