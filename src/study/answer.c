/* answer.c -- the answer of a study in sentences; see study.h */
#include <math.h>

#include "multirate/schemes.h"
#include "study/study.h"

void study_print_setting(const struct setting *r, FILE *to)
{
    fprintf(to, "%s", r->kind->name);
    if (isfinite(r->tolerance)) fprintf(to, " at tolerance %.3g", r->tolerance);
    if (isfinite(r->step)) fprintf(to, " at step %.4g s", r->step);
    if (r->ratio > 1) fprintf(to, ", ratio %d", r->ratio);
}

static void print_error(const struct study_row *r, FILE *to)
{
    fprintf(to, "%.2g in %s", r->errors.worst, r->worst);
}

/* Rows of one scheme at one ratio. */
static bool together(const struct study_row *a, const struct study_row *b)
{
    return a->setting.kind == b->setting.kind && a->setting.ratio == b->setting.ratio;
}

/* By what a further digit multiplies the work of this scheme, from its coarsest and its finest row; NAN: unknown. */
static double price_of_digit(const struct study *o, const struct study_row *of)
{
    const struct study_row *coarse = NULL, *fine = NULL;
    for (const struct study_row *r = o->row; r < o->row + o->nrow; r++) {
        if (!together(r, of) || r->status != OK || r->doubtful) continue;
        if (!(r->errors.worst > 0 && r->errors.worst < .1)) continue;
        if (!coarse || r->errors.worst > coarse->errors.worst) coarse = r;
        if (!fine || r->errors.worst < fine->errors.worst) fine = r;
    }
    if (!coarse || coarse->errors.worst < 3 * fine->errors.worst) return NAN;
    return pow(fine->work / coarse->work, 1 / log10(coarse->errors.worst / fine->errors.worst));
}

/* The row of the least work for an error among those of other schemes than `but`. */
static const struct study_row *pick_other(const struct study *o, double error, const struct study_row *but)
{
    const struct study_row *best = NULL;
    for (const struct study_row *r = o->row; r < o->row + o->nrow; r++)
        if (r->status == OK && !together(r, but) && r->errors.worst <= error && (!best || r->work < best->work))
            best = r;
    return best;
}

static void print_digits(const struct study *o, double error, const struct study_row *r, FILE *to)
{
    const struct study_row *next = pick_other(o, error, r);
    const double digit = price_of_digit(o, r), other = next ? price_of_digit(o, next) : NAN;
    if (isfinite(digit)) fprintf(to, "; each further digit: x %.2g with %s", digit, r->setting.kind->name);
    if (!next) return;
    fprintf(to, "%s %s takes %.2g times the work", isfinite(digit) ? ";" : ";", next->setting.kind->name,
            next->work / r->work);
    if (isfinite(other)) fprintf(to, ", x %.2g a digit", other);
}

static void print_level(const struct study *o, double error, FILE *to)
{
    const struct study_row *r = study_pick(o, error);
    if (!r) {
        fprintf(to, "error below %.0e: none of these runs\n", error);
        return;
    }
    fprintf(to, "error below %.0e: ", error);
    study_print_setting(&r->setting, to);
    fputs(" (", to);
    print_error(r, to);
    fprintf(to, "): work of %.3g evaluations", r->work);
    if (isfinite(r->cpu)) fprintf(to, ", %.2g s", r->cpu);
    print_digits(o, error, r, to);
    fputc('\n', to);
}

/* The best row of a scheme of two rates against the best of one rate that is no less accurate. */
static void print_two_rates(const struct study *o, const struct stepper_kind *kind, FILE *to)
{
    const struct study_row *two = NULL, *one = NULL;
    for (const struct study_row *r = o->row; r < o->row + o->nrow; r++)
        if (r->status == OK && r->setting.kind == kind && (r->setting.ratio > 1 || isfinite(r->setting.tolerance)) &&
            r->errors.worst < 1 && (!two || r->work * r->errors.worst < two->work * two->errors.worst))
            two = r;
    if (!two) return;
    for (const struct study_row *r = o->row; r < o->row + o->nrow; r++)
        if (r->status == OK && !r->setting.kind->two_rates && r->errors.worst <= 1.05 * two->errors.worst &&
            (!one || r->work < one->work))
            one = r;
    study_print_setting(&two->setting, to);
    if (!one) {
        fputs(": no run of one rate here is as accurate\n", to);
        return;
    }
    fprintf(to, two->work < one->work ? " pays: " : " does not pay here: ");
    fprintf(to, "%.2g times the work of ", two->work / one->work);
    study_print_setting(&one->setting, to);
    fprintf(to, ", at errors of %.2g and %.2g", two->errors.worst, one->errors.worst);
    fputc('\n', to);
}

/* No equations are solved in its steps. */
static bool is_explicit(const struct stepper_kind *kind)
{
    return !kind->full && !key_find(kind->keys, "newton_tolerance");
}

/* Schemes of which nothing was run to its end, those that leave something out. */
static void print_gap(const struct study *o, const struct study_gap *g, FILE *to)
{
    fprintf(to, "left out: ");
    study_print_setting(&g->from, to);
    if (!g->all) fputs(" and finer", to);
    fprintf(to, g->all ? ", more than %.2g evaluations" : ", about %.2g evaluations", g->work);
    fputs(g->budget ? ": over its share of the budget" : ": more than the reference itself takes", to);
    if (g->all && o->fastest > 0 && is_explicit(g->from.kind))
        fprintf(to, " (the fastest vibration is %.3g rad/s)", o->fastest);
    fputc('\n', to);
}

void study_answer(const struct study *o, FILE *to)
{
    static const double levels[] = {1e-2, 1e-4, 1e-6};
    for (int i = 0; i < o->ngap; i++) print_gap(o, &o->gap[i], to);
    for (int i = 0; i < 3; i++) print_level(o, levels[i], to);
    for (int i = 0; stepper_kinds[i]; i++)
        if (stepper_kinds[i]->two_rates) print_two_rates(o, stepper_kinds[i], to);
}

void study_print_pick(const struct study_row *r, FILE *to)
{
    fprintf(to, "integrate:\n  scheme: %s\n", r->setting.kind->name);
    if (isfinite(r->setting.tolerance)) fprintf(to, "  tolerance: %.3e\n", r->setting.tolerance);
    if (isfinite(r->setting.step)) fprintf(to, "  step: %.12g\n", r->setting.step);
    if (r->setting.ratio > 1) fprintf(to, "  ratio: %d\n", r->setting.ratio);
}
