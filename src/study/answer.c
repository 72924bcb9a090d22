/* answer.c -- the answer of a study in sentences; see study.h */
#include <math.h>

#include "multirate/schemes.h"
#include "study/study.h"

static void print_setting(const struct study_row *r, FILE *to)
{
    fprintf(to, "%s", r->scheme);
    if (isfinite(r->tolerance)) fprintf(to, " at tolerance %.3g", r->tolerance);
    if (isfinite(r->step)) fprintf(to, " at step %.4g s", r->step);
    if (r->ratio > 1) fprintf(to, ", ratio %d", r->ratio);
}

/* By what a further digit multiplies the work of this scheme, from its coarsest and its finest row; NAN: unknown. */
static double price_of_digit(const struct study *o, const struct study_row *of)
{
    const struct study_row *coarse = NULL, *fine = NULL;
    for (const struct study_row *r = o->row; r < o->row + o->nrow; r++) {
        if (r->scheme != of->scheme || r->ratio != of->ratio || r->status != OK) continue;
        if (!(r->errors.worst > 10 * r->uncertain && r->errors.worst < 1)) continue;
        if (!coarse || r->errors.worst > coarse->errors.worst) coarse = r;
        if (!fine || r->errors.worst < fine->errors.worst) fine = r;
    }
    if (!coarse || coarse->errors.worst < 1.5 * fine->errors.worst) return NAN;
    return pow(fine->work / coarse->work, 1 / log10(coarse->errors.worst / fine->errors.worst));
}

static void print_level(const struct study *o, double error, FILE *to)
{
    const struct study_row *r = study_pick(o, error);
    if (!r) {
        fprintf(to, "error below %.0e: none of these runs\n", error);
        return;
    }
    fprintf(to, "error below %.0e: ", error);
    print_setting(r, to);
    fprintf(to, " (%.2g in %s): work of %.3g evaluations, %.3g s", r->errors.worst, r->worst, r->work, r->cpu);
    const double digit = price_of_digit(o, r);
    if (isfinite(digit)) fprintf(to, "; each further digit: x %.2g", digit);
    fputc('\n', to);
}

/* The best row of a scheme of two rates against the best of one rate that is no less accurate. */
static void print_two_rates(const struct study *o, const struct stepper_kind *kind, FILE *to)
{
    const struct study_row *two = NULL, *one = NULL;
    for (const struct study_row *r = o->row; r < o->row + o->nrow; r++)
        if (r->status == OK && r->ratio > 1 && r->scheme == kind->name &&
            (!two || r->work * r->errors.worst < two->work * two->errors.worst))
            two = r;
    if (!two) return;
    for (const struct study_row *r = o->row; r < o->row + o->nrow; r++)
        if (r->status == OK && r->ratio == 1 && r->errors.worst <= 1.05 * two->errors.worst &&
            (!one || r->work < one->work))
            one = r;
    print_setting(two, to);
    if (!one) {
        fprintf(to, ": no run of one rate here is as accurate\n");
        return;
    }
    fprintf(to, two->work < one->work ? " pays: " : " does not pay here: ");
    fprintf(to, "%.2g times the work of ", two->work / one->work);
    print_setting(one, to);
    fprintf(to, ", at errors of %.2g and %.2g\n", two->errors.worst, one->errors.worst);
}

void study_answer(const struct study *o, FILE *to)
{
    static const double levels[] = {1e-2, 1e-4, 1e-6};
    for (int i = 0; i < 3; i++) print_level(o, levels[i], to);
    for (int i = 0; stepper_kinds[i]; i++)
        if (stepper_kinds[i]->two_rates) print_two_rates(o, stepper_kinds[i], to);
}

void study_print_pick(const struct study_row *r, FILE *to)
{
    fprintf(to, "integrate:\n  scheme: %s\n", r->scheme);
    if (isfinite(r->tolerance)) fprintf(to, "  tolerance: %.3e\n", r->tolerance);
    if (isfinite(r->step)) fprintf(to, "  step: %.12g\n", r->step);
    if (r->ratio > 1) fprintf(to, "  ratio: %d\n", r->ratio);
}
