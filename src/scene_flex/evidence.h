/* evidence.h -- what modes: auto gathers of one flexible body; private to scene_flex. */
#ifndef FMDSUB_SCENE_FLEX_EVIDENCE_H
#define FMDSUB_SCENE_FLEX_EVIDENCE_H

#include "flex/choice.h"
#include "scene_flex/flexible.h"

enum { MOST_MOTIONS = 24, MOST_RECOIL = 6, PACES = 200 };

enum {
    FAMILY_INERTIA,
    FAMILY_RECOIL,
    FAMILY_JOINTS,
    FAMILY_MOMENTS,
    FAMILIES
}; /* and one for each force behind them */
enum { GROUP_MOVES, GROUP_TURNS, GROUPS };

struct motion {
    double d[6], axis[3], p[3]; /* of the reference node; of a turn: its axis and a point on it, body axes */
    const char *name;
    bool turns, driven;
    double rate[2]; /* driven: at the start, and at most [rad/s] or [m/s] */
};

/* Of a tie. */
struct hanging {
    double along[6];  /* how it goes with motions of the reference node */
    double centre[3]; /* where its mass is, from the body's centre, body axes */
    int axis;
};

struct evidence {
    struct builder *b;
    const struct scene_body *body;
    int index;
    const struct flex_body *all;
    struct flex_choosing o;
    struct flex_case *cases;
    struct flex_view *view;
    struct flex_tie *tie;
    struct hanging *hanging; /* [o.ntie] */
    int *like;
    int casecap, viewcap, tiecap, hangcap, likecap;
    int nmotion;
    struct motion motion[MOST_MOTIONS];
    const char *recoils[MOST_RECOIL];
    bool forced[MOST_RECOIL]; /* a force acts along there */
    double recoil[MOST_RECOIL][6], mass[MOST_RECOIL * MOST_RECOIL];
    bool still, any, free; /* nothing moves it; anything may; something but drives */
    bool at_rest;          /* the run begins in equilibrium */
    double length, pace;   /* of the body [m]; of the drives [rad/s] */
    bool smooth;           /* drives begin and go on without jumps of acceleration */
};

/* evidence.c: a case, a group, a view more */
struct flex_case *add_case(struct evidence *e, const char *name, int family, bool sudden, double omega);
int new_group(struct evidence *e, int like);
/* Along axis a of what `rows` [step x n] hold. */
void add_view(struct evidence *e, const char *name, int group, const double *rows, int step, int a);

/* evidence_motion.c: how the joint that carries the body moves, and how quickly drives and forces do */
void find_motions(struct evidence *e);
void find_spin(struct evidence *e);
void find_pull(struct evidence *e);
void find_pace(struct evidence *e);
/* The pace of a signal's order-th derivative [rad/s], and whether it or a lower one jumps. */
double pace_of(const struct signal *s, int order, double until, bool *jumps);
int other_end(const struct scene *s, int joint, int body);

/* evidence_joints.c: what hangs on its further joints, or holds them */
void add_ties(struct evidence *e);
/* What hangs there goes with the motion d of the reference node; and with the turn w about x0. */
void add_hanging(const struct evidence *e, double *p, double *rigid, const double *d);
void add_hanging_turn(const struct evidence *e, double *p, const double *w, const double *x0);

/* evidence_cases.c, evidence_views.c */
void add_cases(struct evidence *e);
void add_views(struct evidence *e);

#endif
