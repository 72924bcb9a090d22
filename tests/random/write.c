/* write.c -- a mechanism as a deck, in one of its variants. */
#include <ctype.h>
#include <math.h>
#include <string.h>

#include "mechanism.h"

static const char *const kind_names[JOINT_KINDS] = {
    "fixed",  "revolute", "prismatic", "cylindrical",   "screw", "universal", "spherical",
    "planar", "free",     "distance",  "point-on-line", "gear",  "rack"};

/* ---- the turn -------------------------------------------------------------------------------- */

/* About an axis that is that of the plane or a skew one, by an angle of the seed. */
static void turn_of(double q[4], const struct mechanism *m)
{
    double phi = 0.3 + 0.05 * (double)(m->seed % 40), s = sin(phi / 2);
    static const double skew[3] = {2. / 7, -3. / 7, 6. / 7};

    q[0] = cos(phi / 2);
    for (int i = 0; i < 3; i++) q[i + 1] = s * (m->dim == 2 ? i == 2 : skew[i]);
}

static struct vec turned(const double q[4], struct vec v)
{
    struct vec o = v;
    const double *u = q + 1;

    for (int i = 0; i < 3; i++) { /* v + 2 w u x v + 2 u x (u x v) */
        int j = (i + 1) % 3, k = (i + 2) % 3;
        double uv = u[0] * v.x[0] + u[1] * v.x[1] + u[2] * v.x[2], uu = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
        o.x[i] += 2 * q[0] * (u[j] * v.x[k] - u[k] * v.x[j]) + 2 * (u[i] * uv - v.x[i] * uu);
    }
    return o;
}

void mechanism_turn(struct vec *o, const struct mechanism *m, const struct vec *x, bool shifted)
{
    static const double shift[3] = {5, -3, 2};
    double q[4];

    turn_of(q, m);
    *o = turned(q, *x);
    for (int i = 0; i < m->dim && shifted; i++) o->x[i] += shift[i];
}

/* ---- words ----------------------------------------------------------------------------------- */

struct writer {
    FILE *f;
    const struct mechanism *m;
    const struct variant *v;
};

static void name(const struct writer *o, char kind, int i)
{
    if (!o->v->renamed)
        fprintf(o->f, "%c%d", kind, i);
    else
        fprintf(o->f, "%c_%d_name", "zyxw"[kind == 'b' ? 0 : kind == 'j' ? 1 : kind == 'f' ? 2 : 3], 97 - 7 * i);
}

static void body_name(const struct writer *o, int i)
{
    if (i < 0)
        fputs("ground", o->f);
    else
        name(o, 'b', i);
}

/* $j3 and $b0 become names. */
static void text(const struct writer *o, const char *s)
{
    for (; *s; s++) {
        if (*s != '$') {
            fputc(*s, o->f);
            continue;
        }
        name(o, s[1], s[2] - '0');
        s += 2;
    }
}

static void vector(const struct writer *o, struct vec v, bool place)
{
    if (o->v->turned) mechanism_turn(&v, o->m, &v, place);
    fprintf(o->f, "[%.15g, %.15g", v.x[0], v.x[1]);
    if (o->m->dim == 3) fprintf(o->f, ", %.15g", v.x[2]);
    fputc(']', o->f);
}

static void local(const struct writer *o, struct vec v)
{
    struct variant as_drawn = {false, false, false};
    struct writer w = {o->f, o->m, &as_drawn};

    vector(&w, v, false);
}

/* ---- sections -------------------------------------------------------------------------------- */

static void orient(const struct writer *o, const struct body *b)
{
    double r[4] = {1, 0, 0, 0}, q[4];

    if (o->v->turned) turn_of(r, o->m);
    if (o->m->dim == 2) {
        fprintf(o->f, "orient: %.15g", b->quat[0] + 2 * atan2(r[3], r[0]));
        return;
    }
    q[0] = r[0] * b->quat[0] - r[1] * b->quat[1] - r[2] * b->quat[2] - r[3] * b->quat[3];
    for (int i = 1; i < 4; i++) {
        int j = i % 3 + 1, k = (i + 1) % 3 + 1;
        q[i] = r[0] * b->quat[i] + r[i] * b->quat[0] + r[j] * b->quat[k] - r[k] * b->quat[j];
    }
    fprintf(o->f, "orient: {quaternion: [%.16g, %.16g, %.16g, %.16g]}", q[0], q[1], q[2], q[3]);
}

static void write_beam(const struct writer *o, const struct body *b)
{
    fputs(":\n    beam: {from: ", o->f);
    vector(o, b->from, true);
    fputs(", to: ", o->f);
    vector(o, b->to, true);
    if (o->m->dim == 3) {
        fputs(", up: ", o->f);
        vector(o, b->up, false);
    }
    fprintf(o->f, ", elements: 4}\n    section: {rectangle: [%.12g, %.12g]}\n", b->width, b->height);
    fprintf(o->f, "    material: {E: %.12g, nu: 0.3, density: %.12g}\n    modes: %d\n", b->E, b->density, b->modes);
    if (b->beta > 0) fprintf(o->f, "    damping: {beta: %g}\n", b->beta);
    fputs("    points: {p: {station: 1}}\n", o->f);
}

static void write_body(const struct writer *o, int i)
{
    const struct body *b = &o->m->body[i];

    fputs("  ", o->f);
    name(o, 'b', i);
    if (b->beam) {
        write_beam(o, b);
        return;
    }
    fprintf(o->f, ": {mass: %.12g, inertia: ", b->mass);
    if (o->m->dim == 2)
        fprintf(o->f, "%.12g", b->inertia[0]);
    else
        fprintf(o->f, "[%.12g, %.12g, %.12g]", b->inertia[0], b->inertia[1], b->inertia[2]);
    fputs(", at: ", o->f);
    vector(o, b->at, true);
    fputs(", ", o->f);
    orient(o, b);
    fputs(", points: {p: ", o->f);
    local(o, b->point);
    fputs("}}\n", o->f);
}

static void write_pair(const struct writer *o, const struct joint *j)
{
    bool points = j->kind == DISTANCE;

    fputs(" [", o->f);
    body_name(o, j->swapped ? j->b : j->a);
    if (points && j->a >= 0) fputs(".p", o->f);
    fputs(", ", o->f);
    body_name(o, j->swapped ? j->a : j->b);
    fputs(points ? ".p]" : "]", o->f);
}

static void write_joint(const struct writer *o, int i)
{
    const struct joint *j = &o->m->joint[i];
    bool space = o->m->dim == 3;

    fputs("  ", o->f);
    name(o, 'j', i);
    fprintf(o->f, ": {%s:", kind_names[j->kind]);
    if (j->kind == GEAR || j->kind == RACK) {
        fputs(" [", o->f);
        name(o, 'j', j->a);
        fputs(", ", o->f);
        name(o, 'j', j->b);
        fprintf(o->f, "], %s: %g}\n", j->kind == GEAR ? "ratio" : "radius", j->pitch);
        return;
    }
    if (j->kind == DISTANCE && j->a < 0) { /* from a point of the ground */
        fputs(" [", o->f);
        vector(o, j->at, true);
        fputs(", ", o->f);
        body_name(o, j->b);
        fputs(".p]}\n", o->f);
        return;
    }
    write_pair(o, j);
    if (j->kind != DISTANCE) {
        fputs(", at: ", o->f);
        vector(o, j->at, true);
    }
    bool axis = j->kind == PRISMATIC || j->kind == ON_LINE ||
                (space && (j->kind == REVOLUTE || j->kind == CYLINDRICAL || j->kind == SCREW || j->kind == UNIVERSAL ||
                           j->kind == PLANAR));
    if (axis) {
        fputs(", axis: ", o->f);
        vector(o, j->axis, false);
    }
    if (space && (j->kind == UNIVERSAL || j->kind == PLANAR)) {
        fputs(", axis2: ", o->f);
        vector(o, j->axis2, false);
    }
    if (j->kind == SCREW) fprintf(o->f, ", pitch: %g", j->pitch);
    fputs("}\n", o->f);
}

static void write_load(const struct writer *o, const struct force *f)
{
    struct vec way = f->axis;
    bool planar_torque = f->torque && o->m->dim == 2;

    if (o->v->turned && !f->in_body) mechanism_turn(&way, o->m, &way, false);
    fprintf(o->f, "{%s: ", f->torque ? "torque" : "force");
    body_name(o, f->body);
    if (!f->torque) fputs(".p", o->f);
    fputs(planar_torque ? ", value: " : ", value: [", o->f);
    for (int i = planar_torque ? 2 : 0; i < (planar_torque ? 3 : o->m->dim); i++) {
        if (i > 0 && !planar_torque) fputs(", ", o->f);
        fprintf(o->f, "\"%.15g*%s\"", way.x[i], f->text);
    }
    if (!planar_torque) fputs("]", o->f);
    if (!planar_torque) fprintf(o->f, ", frame: %s", f->in_body ? "body" : "world");
    fputs("}", o->f);
}

static void write_force(const struct writer *o, int i)
{
    const struct force *f = &o->m->force[i];

    fputs("  ", o->f);
    name(o, 'f', i);
    fputs(": ", o->f);
    switch (f->kind) {
    case LINE:
        text(o, f->text);
        break;
    case LOAD:
        write_load(o, f);
        break;
    case BUSHING:
        fputs("{bushing: [", o->f);
        body_name(o, f->body);
        fputs(", ", o->f);
        body_name(o, f->other);
        fputs("], at: ", o->f);
        vector(o, f->at, true);
        fputs(", axis: ", o->f);
        vector(o, f->axis, false);
        fprintf(o->f, ", %s}", f->text);
    }
    fputc('\n', o->f);
}

static void write_measure(const struct writer *o, int i)
{
    fputs("  ", o->f);
    name(o, 'm', i);
    fputs(": ", o->f);
    text(o, o->m->measure[i]);
    fputc('\n', o->f);
}

/* n members of a section in order, or in the opposite one. */
static void section(const struct writer *o, const char *title, int n, void (*write)(const struct writer *, int))
{
    if (n == 0) return;
    fprintf(o->f, "%s:\n", title);
    for (int i = 0; i < n; i++) write(o, o->v->reversed ? n - 1 - i : i);
}

static void write_initial(const struct writer *o)
{
    static const char *const way[3] = {"x_rate", "y_rate", "z_rate"};
    const char *before = "initial: {";

    for (int i = 0; i < o->m->nbody; i++) {
        if (o->m->has_initial[i]) {
            fputs(before, o->f);
            text(o, o->m->initial[i]);
            before = ", ";
        }
        struct vec v = o->m->slide[i];
        if (o->v->turned) mechanism_turn(&v, o->m, &v, false);
        for (int k = 0; k < o->m->dim && o->m->has_slide[i]; k++) {
            fputs(before, o->f);
            name(o, 'j', i);
            fprintf(o->f, ".%s: %.15g", way[k], v.x[k]);
            before = ", ";
        }
    }
    if (before[0] == ',') fputs("}\n", o->f);
}

void mechanism_write(FILE *f, const struct mechanism *m, const struct variant *variant)
{
    struct writer o = {f, m, variant};
    bool heavy = false;

    fprintf(f, "# mechanism %d: ", (int)m->seed);
    mechanism_tell(f, m);
    fputs("fmdsub: 1\n", f);
    for (int i = 0; i < 3; i++) heavy |= m->gravity.x[i] != 0;
    if (heavy) {
        fputs("gravity: ", f);
        vector(&o, m->gravity, false);
        fputc('\n', f);
    }
    section(&o, "bodies", m->nbody, write_body);
    section(&o, "constraints", m->njoint, write_joint);
    section(&o, "measures", m->nmeasure, write_measure);
    section(&o, "forces", m->nforce, write_force);
    if (m->drive[0]) {
        fputs("drives:\n  motor: ", f);
        text(&o, m->drive);
        fputc('\n', f);
    }
    write_initial(&o);
    fputs("partition: {fast: [", f);
    text(&o, m->fast);
    fprintf(f, "]}\nintegrate: {scheme: subcycle, step: %.15g, ratio: %d, until: %g}\n", m->until / 160 / m->ratio,
            m->ratio, m->until);
    fprintf(f, "output: {every: %g, columns: [", m->until / 10);
    int lengths;
    mechanism_columns(f, m, variant, &lengths);
    fputs("]}\n", f);
}

/* ---- columns --------------------------------------------------------------------------------- */

static int write_columns(const struct writer *o, char kind, int i, const char *point, const char *prefix)
{
    for (int k = 0; k < o->m->dim; k++) {
        name(o, kind, i);
        fprintf(o->f, "%s.%s%c, ", point, prefix, "xyz"[k]);
    }
    return o->m->dim;
}

int mechanism_columns(FILE *f, const struct mechanism *m, const struct variant *variant, int *lengths)
{
    struct writer o = {f, m, variant};
    int n = 0;

    for (int i = 0; i < m->nbody; i++) n += write_columns(&o, 'b', i, "", "") + write_columns(&o, 'b', i, ".p", "");
    *lengths = n;
    for (int i = 0; i < m->nbody; i++) n += write_columns(&o, 'b', i, "", "v") + write_columns(&o, 'b', i, ".p", "v");
    for (int i = 0; i < m->nbody; i++) n += write_columns(&o, 'j', i, "", "f");
    fputs("energy.kinetic", f);
    return n + 1;
}

void mechanism_tell(FILE *f, const struct mechanism *o)
{
    double least = 1e9, most = 0;

    for (int i = 0; i < o->nbody; i++) {
        least = fmin(least, o->body[i].mass);
        most = fmax(most, o->body[i].mass);
    }
    fprintf(f, "%s, %d bod%s (%d flexible), %d loop(s), %d force(s), %smasses %g to %g kg, ratio %d\n",
            o->dim == 2 ? "planar" : "spatial", o->nbody, o->nbody == 1 ? "y" : "ies", o->nflex, o->nloop, o->nforce,
            o->drive[0] ? "a drive, " : "", least, most, o->ratio);
}
