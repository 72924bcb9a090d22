/* answer.c -- the answer of a study in sentences; see study.h */
#include <math.h>

#include "multirate/schemes.h"
#include "study/study.h"

void study_print_setting(const struct setting *r, FILE *to)
{
    fprintf(to, "%s", r->kind->name);
    if (r->order > 2) fprintf(to, " of order %d", r->order);
    if (isfinite(r->tolerance)) fprintf(to, " at tolerance %.3g", r->tolerance);
    if (isfinite(r->step)) fprintf(to, " at step %.4g s", r->step);
    if (r->ratio > 1) fprintf(to, ", ratio %d", r->ratio);
}

/* "0.0012 in pin.fx" */
static void print_error(const struct study_row *r, FILE *to)
{
    fprintf(to, "%.2g", r->errors.worst);
    if (*r->worst) fprintf(to, " in %s", r->worst);
}

double study_digit(const struct study *o, const struct study_row *of)
{
    const struct study_row *coarse = NULL, *fine = NULL;
    for (const struct study_row *r = o->row; r < o->row + o->nrow; r++) {
        if (!setting_together(&r->setting, &of->setting) || r->status != OK || r->doubtful) continue;
        if (!(r->errors.worst > 0 && r->errors.worst < .1)) continue;
        if (!coarse || r->errors.worst > coarse->errors.worst) coarse = r;
        if (!fine || r->errors.worst < fine->errors.worst) fine = r;
    }
    if (!coarse || coarse->errors.worst < 3 * fine->errors.worst || !(fine->work > coarse->work)) return NAN;
    return pow(fine->work / coarse->work, 1 / log10(coarse->errors.worst / fine->errors.worst));
}

const struct study_row *study_pick(const struct study *o, double error)
{
    const struct study_row *best = NULL;
    for (const struct study_row *r = o->row; r < o->row + o->nrow; r++)
        if (r->status == OK && r->errors.worst <= error && (!best || r->work < best->work)) best = r;
    return best;
}

/* The same among rows of other schemes than that of `but`. */
static const struct study_row *pick_other(const struct study *o, double error, const struct study_row *but)
{
    const struct study_row *best = NULL;
    for (const struct study_row *r = o->row; r < o->row + o->nrow; r++)
        if (r->status == OK && r->setting.kind != but->setting.kind && r->errors.worst <= error &&
            (!best || r->work < best->work))
            best = r;
    return best;
}

/* "1.8 times the work of", or `same` where nobody minds the difference. */
static void print_times(double times, const char *what, const char *same, FILE *to)
{
    static const double NEAR = 1.05;
    if (times < NEAR && times > 1 / NEAR)
        fputs(same, to);
    else
        fprintf(to, "%.2g times %s", times, what);
}

/* ---- a level ---- */

/* "; each further digit: x 1.4 with radau9, x 2.5 with dopri5, which takes 1.8 times the work" */
static void print_digits(const struct study *o, double error, const struct study_row *r, FILE *to)
{
    const struct study_row *next = pick_other(o, error, r);
    const double digit = study_digit(o, r), other = next ? study_digit(o, next) : NAN;
    if (isfinite(digit)) fprintf(to, "; each further digit: x %.2g with %s", digit, r->setting.kind->name);
    if (!next) return;
    if (isfinite(digit) && isfinite(other))
        fprintf(to, ", x %.2g with %s, which takes ", other, next->setting.kind->name);
    else
        fprintf(to, "; %s takes ", next->setting.kind->name);
    print_times(next->work / r->work, "the work", "as much work", to);
}

/* The most accurate, where none is as accurate as asked for. */
static void print_none(const struct study *o, FILE *to)
{
    const struct study_row *best = NULL;
    for (const struct study_row *r = o->row; r < o->row + o->nrow; r++)
        if (r->status == OK && isfinite(r->errors.worst) && (!best || r->errors.worst < best->errors.worst)) best = r;
    fputs("none of these runs", to);
    if (best) {
        fputs("; the most accurate is ", to);
        study_print_setting(&best->setting, to);
        fputs(" (", to);
        print_error(best, to);
        fprintf(to, "): work of %.3g evaluations", best->work);
    }
    fputc('\n', to);
}

static void print_level(const struct study *o, double error, FILE *to)
{
    const struct study_row *r = study_pick(o, error);
    fprintf(to, "error below %.0e: ", error);
    if (!r) {
        print_none(o, to);
        return;
    }
    study_print_setting(&r->setting, to);
    fputs(" (", to);
    print_error(r, to);
    fprintf(to, "): work of %.3g evaluations", r->work);
    if (isfinite(r->cpu)) fprintf(to, ", %.2g s", r->cpu);
    print_digits(o, error, r, to);
    fputc('\n', to);
}

/* ---- the deck's own setting ---- */

static void print_own(const struct study *o, FILE *to)
{
    const struct study_row *own = o->own;
    const struct study_row *best = own ? study_pick(o, own->errors.worst) : NULL;
    if (!own) return;
    fputs("the deck's own setting, ", to);
    study_print_setting(&own->setting, to);
    if (own->status != OK && own->status != E_VERDICT) {
        fputs(", stops on the way\n", to);
        return;
    }
    fputs(": error ", to);
    print_error(own, to);
    fprintf(to, "%s, work of %.3g evaluations", own->status == E_VERDICT ? ", its balance of energy broken" : "",
            own->work);
    if (best == own) fputs(": the least for that error", to);
    if (best && best != own) {
        fputs(", ", to);
        print_times(own->work / best->work, "that of ", "as much as ", to);
        study_print_setting(&best->setting, to);
        fprintf(to, " (%.2g)", best->errors.worst);
    }
    fputc('\n', to);
}

/* ---- two rates ---- */

/* The cheapest of one rate that is as accurate. */
static const struct study_row *rival_of(const struct study *o, const struct study_row *two)
{
    const struct study_row *best = NULL;
    for (const struct study_row *r = o->row; r < o->row + o->nrow; r++)
        if (r->status == OK && !r->setting.kind->two_rates && r->errors.worst <= 1.05 * two->errors.worst &&
            (!best || r->work < best->work))
            best = r;
    return best;
}

/* A whole run of two rates? */
static bool is_of(const struct study_row *r, const struct stepper_kind *kind)
{
    return r->status == OK && r->setting.kind == kind && (r->setting.ratio > 1 || isfinite(r->setting.tolerance)) &&
           r->errors.worst < 1;
}

/* The best row of a scheme of two rates that is of use: by what it saves; where none of one rate is as accurate, by the error
 * that its work buys. */
static const struct study_row *best_of(const struct study *o, const struct stepper_kind *kind)
{
    static const double OF_USE = 1e-2;
    const struct study_row *best = NULL, *cheap = NULL;
    double most = 0;
    for (const struct study_row *r = o->row; r < o->row + o->nrow; r++) {
        if (!is_of(r, kind)) continue;
        const struct study_row *one = r->errors.worst <= OF_USE ? rival_of(o, r) : NULL;
        if (!cheap || r->work * r->errors.worst < cheap->work * cheap->errors.worst) cheap = r;
        if (!one || one->work <= most * r->work) continue;
        most = one->work / r->work;
        best = r;
    }
    return best ? best : cheap;
}

/* The most accurate of one rate, of those that took more work. */
static const struct study_row *nearest_of(const struct study *o, const struct study_row *two)
{
    const struct study_row *best = NULL;
    for (const struct study_row *r = o->row; r < o->row + o->nrow; r++)
        if (r->status == OK && !r->setting.kind->two_rates && r->work > two->work &&
            (!best || r->errors.worst < best->errors.worst))
            best = r;
    return best;
}

static void print_unmatched(const struct study *o, const struct study_row *two, FILE *to)
{
    const struct study_row *one = nearest_of(o, two);
    fputs(": no run of one rate here is as accurate", to);
    if (!one) return;
    fputs("; the most accurate, ", to);
    study_print_setting(&one->setting, to);
    fprintf(to, " (%.2g), takes ", one->errors.worst);
    print_times(one->work / two->work, "the work", "as much work", to);
}

/* Its own scheme at one rate, at the same step or tolerance. */
static const struct study_row *twin_of(const struct study *o, const struct study_row *two)
{
    struct setting twin = two->setting;
    twin.kind = two->setting.kind->single;
    twin.ratio = 1;
    for (const struct study_row *r = o->row; twin.kind && r < o->row + o->nrow; r++)
        if (r->setting.kind == twin.kind && r->setting.tolerance == twin.tolerance) return r;
    for (const struct study_row *r = o->row; twin.kind && r < o->row + o->nrow; r++)
        if (r->setting.kind == twin.kind && r->setting.step == twin.step && r->setting.order == twin.order) return r;
    return NULL;
}

/* Why: what the two rates themselves save or cost, then what order does. */
static void print_why(const struct study *o, const struct study_row *two, FILE *to)
{
    const struct study_row *twin = twin_of(o, two);
    const double share = 100. * o->subject.ns / o->subject.n;
    if (!twin) return;
    fprintf(to, "; against %s, the same at one rate, it takes ", twin->setting.kind->name);
    print_times(two->work / twin->work, "the work", "as much work", to);
    fprintf(to, " (%.0f %% of the coordinates are fast, %.3g sweeps a major step)", share,
            (double)two->effort.sweeps / fmax(1, (double)two->effort.majors));
}

static void print_two_rates(const struct study *o, const struct stepper_kind *kind, FILE *to)
{
    const struct study_row *two = best_of(o, kind), *one = two ? rival_of(o, two) : NULL;
    int rows = 0;
    for (const struct study_row *r = o->row; r < o->row + o->nrow; r++) rows += r->setting.kind == kind;
    if (rows && !two)
        fprintf(to, "%s: none of its runs is whole, balanced and within its columns' range\n", kind->name);
    if (!two) return;
    study_print_setting(&two->setting, to);
    fprintf(to, " (%.2g)", two->errors.worst);
    if (one) {
        fprintf(to, two->work < one->work ? " pays: " : " does not pay here: ");
        print_times(two->work / one->work, "the work of ", "as much work as ", to);
        study_print_setting(&one->setting, to);
        fprintf(to, " (%.2g)", one->errors.worst);
    } else {
        print_unmatched(o, two, to);
    }
    print_why(o, two, to);
    fputc('\n', to);
}

/* ---- what is left out ---- */

/* No equations are solved in its steps. */
static bool is_explicit(const struct stepper_kind *kind)
{
    return !kind->full && !key_find(kind->keys, "newton_tolerance");
}

/* Of which nothing was run to its end, each with its own line. */
static void print_hopeless(const struct study *o, const struct study_gap *g, FILE *to)
{
    fputs("left out: ", to);
    study_print_setting(&g->from, to);
    fprintf(to, ", which takes %.2g evaluations or more, %s", g->work,
            g->budget ? "its share of the budget" : "more than the reference");
    if (o->fastest > 0 && is_explicit(g->from.kind))
        fprintf(to, ": an explicit scheme has to follow the fastest vibration, %.3g rad/s", o->fastest);
    fputc('\n', to);
}

/* The finer settings of the others, in one line. */
static void print_finer(const struct study *o, bool budget, FILE *to)
{
    int n = 0;
    for (int i = 0; i < o->ngap; i++) {
        const struct study_gap *g = &o->gap[i];
        if (g->all || g->budget != budget) continue;
        if (n == 0 && budget) fputs("over the budget: from ", to);
        if (n == 0 && !budget)
            fprintf(to, "more work than the reference, %.2g evaluations, and left out: from ", o->reference.work);
        fputs(n++ ? ", " : "", to);
        study_print_setting(&g->from, to);
    }
    if (n) fputs(" on\n", to);
}

/* Are errors known of any run that is whole, if there is one? */
static bool compares(const struct study *o)
{
    int whole = 0;
    for (const struct study_row *r = o->row; r < o->row + o->nrow; r++) {
        if (r->status != OK) continue;
        if (!isnan(r->errors.worst)) return true;
        whole++;
    }
    return whole == 0;
}

void study_answer(const struct study *o, FILE *to)
{
    static const double levels[] = {1e-2, 1e-4, 1e-6};
    for (int i = 0; i < o->ngap; i++)
        if (o->gap[i].all) print_hopeless(o, &o->gap[i], to);
    print_finer(o, false, to);
    print_finer(o, true, to);
    if (o->subject.n == 0) fputs("drives move everything: every scheme gives the same motion\n", to);
    if (!compares(o)) {
        fputs("none of the deck's columns can be compared, so that no error is known: neither steps and counts, nor "
              "what is\n"
              "round-off or what the reference does not know; let it write places, angles or rates (output: columns)\n",
              to);
        return;
    }
    for (int i = 0; i < 3; i++) print_level(o, levels[i], to);
    print_own(o, to);
    for (int i = 0; stepper_kinds[i]; i++)
        if (stepper_kinds[i]->two_rates) print_two_rates(o, stepper_kinds[i], to);
}

double study_share(const struct study *o)
{
    const double start = o->subject.scene->start;
    return (o->subject.until - start) / (o->subject.scene->integrate.until - start);
}

void study_print_pick(const struct study *o, const struct study_row *r, FILE *to)
{
    if (study_share(o) < 1)
        fprintf(to, "# its error was measured up to t = %.4g s only, of %.4g s\n", o->subject.until,
                o->subject.scene->integrate.until);
    fprintf(to, "integrate:\n  scheme: %s\n", r->setting.kind->name);
    if (isfinite(r->setting.tolerance)) fprintf(to, "  tolerance: %.3e\n", r->setting.tolerance);
    if (isfinite(r->setting.step)) fprintf(to, "  step: %.12g\n", r->setting.step);
    if (r->setting.ratio > 1) fprintf(to, "  ratio: %d\n", r->setting.ratio);
    if (r->setting.order > 2) fprintf(to, "  order: %d\n", r->setting.order);
}
