/* parts.h -- what the files of system.h share. */
#ifndef FMDSUB_SYSTEM_PARTS_H
#define FMDSUB_SYSTEM_PARTS_H

#include "contact/near.h"
#include "loop/condense.h"
#include "loop/coordinates.h"
#include "model/flat.h"
#include "open/open.h"
#include "system/system.h"

struct system {
    const struct model *model;
    const struct sweep_ops *ops;
    struct open_tree tree;
    struct condense *loops;    /* of the tree with its loops; NULL: none */
    struct windings *windings; /* NULL: nobody asks for them */
    struct sweep *view;
    struct loops *shown; /* the loops there */
    struct contacts *contacts;
    struct near *near;            /* gaps of those contacts */
    struct ode2_contact touching; /* as the engine sees them */
    double *row, *still;          /* [(1 + 2) n], [n] zeros */
    double *press;                /* [rows] forces of contacts at the instant that is looked at */
    double *lambda;               /* [rows] at the last system_evaluate() */
    double constraint_worst;
    const struct model_flat *flat; /* steps are in its plane; NULL: they are not, and the next, too */
    struct system *seen;           /* all of space, for what the output asks */
    /* at the last system_evaluate() */
    double *q, *v, *a, *r;         /* [nq], [n] */
    struct effect *effect;         /* [nforce] */
    double *near_q[2], *near_v[2]; /* [nq], [n] two states of system_leap() */
    struct energies energies;
};

/* What the output asks for is asked of this. */
static inline const struct system *system_seen(const struct system *s)
{
    return s->seen ? s->seen : s;
}

/* flat.c: system_evaluate() of one that steps in a plane; that of any by itself */
enum status flat_evaluate(struct system *s, const double *q, const double *v, double t, unsigned what,
                          struct trouble *why);
enum status system_evaluate_itself(struct system *s, const double *q, const double *v, double t, unsigned what,
                                   struct trouble *why);
/* The joints' forces at x, of the independents, with its a, while contacts push with f. */
enum status system_joint_forces(struct system *s, const struct instant *x, const double *f, struct trouble *why);
/* touching.c: rigid contacts, behind the door. */
void touching_build(struct system *s, struct arena *life);

#endif
