/* places.c -- vectors, directions, points and orientations of a deck */
#include <math.h>
#include <string.h>

#include "la/rot.h"
#include "la/vec3.h"
#include "scene/build.h"

static const double SAME_PLACE = 1e-9; /* of a body's size: nodes that stand in one place */

const struct key keys_orient[] = {
    PARAM_NODE(struct orient_keys, z, "z", "vector", 0, "the body's z axis, world; alone: x is any"),
    PARAM_NODE(struct orient_keys, x, "x", "vector", 0,
               "the body's x axis, at right angles to z; alone: z leans to the world's z"),
    PARAM_NODE(struct orient_keys, axis, "axis", "vector", 0, "axis of a turn from the world's axes"),
    PARAM_REAL(struct orient_keys, angle, "angle", "rad", -INFINITY, INFINITY, 0, NULL, "angle of that turn"),
    PARAM_NODE(struct orient_keys, quaternion, "quaternion", "[w, x, y, z]", 0, "unit quaternion, body to world"),
    KEYS_END,
};

int read_place(struct builder *b, double *o, const struct node *n, const char *what)
{
    int space = b->scene->space;
    o[0] = o[1] = o[2] = 0;
    if (n->type == NODE_LIST && n->count != space && (n->count == 2 || n->count == 3)) {
        diag_error(b->diags, n, AT_VALUE, "E-count", "%s: expected %d numbers, found %d", what, space, n->count);
        if (b->space_from)
            diag_note(b->diags, b->space_from, AT_VALUE, "this makes the deck %s", space == 2 ? "planar" : "spatial");
        return 1;
    }
    return read_vector(o, space, n, what, &b->reader);
}

int read_direction(struct builder *b, double *o, const struct node *n, const char *what)
{
    if (read_place(b, o, n, what)) return 1;
    const double most = fmax(fabs(o[0]), fmax(fabs(o[1]), fabs(o[2])));
    if (most > 0) { /* squares of what is very long or short are no numbers */
        for (int i = 0; i < 3; i++) o[i] /= most;
        v3_scale(o, 1 / v3_norm(o), o);
        return 0;
    }
    diag_error(b->diags, n, AT_VALUE, "E-direction", "%s: a direction of length 0", what);
    return 1;
}

static int unknown_point(struct builder *b, const struct node *n, int body)
{
    const struct scene *scene = b->scene;
    const char **list = TAKE(b->life, const char *, scene->npoint + scene->nbody);
    int count = 0;
    for (int i = 0; i < scene->npoint; i++)
        if (body < 0 || scene->point[i].at.body == body) list[count++] = scene->point[i].name;
    for (int i = 0; body < 0 && i < scene->nbody; i++) list[count++] = scene->body[i].name;
    unknown_name(b, n, AT_VALUE, "E-unknown-point", "point", n->text, list, count);
    return 1;
}

int read_point(struct builder *b, struct marker *o, const struct node *n, const char *what)
{
    const struct scene *scene = b->scene;
    *o = (struct marker){0};
    if (n->type == NODE_LIST) return read_place(b, o->p, n, what);
    if (n->type != NODE_SCALAR) {
        diag_error(b->diags, n, AT_VALUE, "E-type", "%s: expected a vector or 'body.point'", what);
        return 1;
    }
    for (int i = 0; i < scene->npoint; i++)
        if (strcmp(scene->point[i].name, n->text) == 0) return *o = scene->point[i].at, 0;
    for (int i = 0; i < scene->nbody; i++)
        if (strcmp(scene->body[i].name, n->text) == 0) return o->body = i, 0;
    const char *dot = strchr(n->text, '.');
    int body = -1;
    for (int i = 0; dot && i < scene->nbody; i++) {
        const char *name = scene->body[i].name;
        if (strlen(name) == (size_t)(dot - n->text) && memcmp(name, n->text, strlen(name)) == 0) body = i;
    }
    for (int i = 0; body > 0 && scene->body[body].whole && i < scene->npoint; i++) { /* b2.tip for b.tip */
        const char *name = strchr(scene->point[i].name, '.');
        if (scene->point[i].at.body == body && name && strcmp(name, dot) == 0) return *o = scene->point[i].at, 0;
    }
    return unknown_point(b, n, body);
}

void marker_drawn(double *o, const struct scene *scene, const struct marker *m)
{
    const struct scene_body *body = &scene->body[m->body];
    double arm[3];
    m3_mul(arm, body->R, m->p);
    v3_sum(o, body->at, arm);
}

void marker_at(struct marker *o, const struct scene *scene, int body, const double *x)
{
    double arm[3];
    v3_diff(arm, x, scene->body[body].at);
    o->body = body;
    m3_tmul(o->p, scene->body[body].R, arm);
}

void frame_about(double *E, const double *z, const double *near)
{
    double x[3];
    if (near) {
        v3_copy(x, near);
    } else { /* the world axis least along z */
        int least = fabs(z[0]) <= fabs(z[1]) && fabs(z[0]) <= fabs(z[2]) ? 0 : fabs(z[1]) <= fabs(z[2]) ? 1 : 2;
        x[0] = x[1] = x[2] = 0;
        x[least] = 1;
    }
    v3_axpy(x, -v3_dot(x, z), z);
    v3_scale(E, 1 / v3_norm(x), x);
    v3_cross(E + 3, z, E);
    v3_copy(E + 6, z);
}

const double *up_of(const double *x)
{
    static const double up[3] = {0, 0, 1}, ahead[3] = {1, 0, 0};
    return fabs(x[0]) + fabs(x[1]) <= 1e-9 * fabs(x[2]) ? ahead : up;
}

void frame_along(double *E, const double *x)
{
    matrix_of_axes(E, 0, x, 2, up_of(x));
}

static int from_axes(struct builder *b, double *R, const struct orient_keys *k, const struct node *n, const char *what)
{
    double x[3], z[3];
    if (!k->x && !k->z) {
        diag_error(b->diags, n, AT_VALUE, "E-orientation", "%s: expected 'x' or 'z', or both", what);
        return 1;
    }
    if (k->x && read_direction(b, x, k->x, what)) return 1;
    if (k->z && read_direction(b, z, k->z, what)) return 1;
    if (!k->z) {
        frame_along(R, x);
        return 0;
    }
    const double lean = k->x ? v3_dot(x, z) : 0;
    if (fabs(lean) > 1e-6) {
        diag_error(b->diags, k->x, AT_VALUE, "E-axes", "%s: 'x' and 'z' are not at right angles", what);
        diag_hint(b->diags, "the angle between them is %.6g degrees; one of the two alone will do",
                  acos(fmax(-1, fmin(1, lean))) * 57.29577951308232);
        return 1;
    }
    frame_about(R, z, k->x ? x : NULL);
    return 0;
}

static int from_quaternion(struct builder *b, double *R, const struct node *n, const char *what)
{
    double q[4];
    if (read_vector(q, 4, n, what, &b->reader)) return 1;
    double size = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(fabs(size - 1) <= 1e-3)) {
        diag_error(b->diags, n, AT_VALUE, "E-quaternion", "%s: a quaternion of length %g", what, size);
        diag_hint(b->diags, "expected [w, x, y, z] of length 1 (within 0.001, then it is scaled)");
        return 1;
    }
    if (fabs(size - 1) > 1e-12)
        diag_warn(b->diags, n, AT_VALUE, "W-quaternion", "%s: quaternion of length %.9g scaled to 1", what, size);
    for (int i = 0; i < 4; i++) q[i] /= size;
    quat_matrix(R, q);
    return 0;
}

int read_orientation(struct builder *b, double *R, const struct node *n, const char *what)
{
    if (b->scene->space == 2) {
        double angle;
        if (read_number(&angle, n, NULL, &b->reader)) return 1;
        warn_of_angle(b, n, angle);
        const double about_z[9] = {cos(angle), sin(angle), 0, -sin(angle), cos(angle), 0, 0, 0, 1};
        memcpy(R, about_z, sizeof about_z);
        return 0;
    }
    struct orient_keys k = {.angle = NAN};
    if (read_keys(&k, keys_orient, n, NULL, what, &b->reader)) return 1;
    if (!!k.quaternion + (k.axis || !isnan(k.angle)) + (k.x || k.z) > 1) {
        diag_error(b->diags, n, AT_VALUE, "E-two-kinds",
                   "%s: expected one of 'z' and 'x', 'axis' and 'angle', 'quaternion'", what);
        return 1;
    }
    if (k.quaternion) return from_quaternion(b, R, k.quaternion, what);
    if (!k.axis) return from_axes(b, R, &k, n, what);
    double axis[3], q[4];
    if (read_direction(b, axis, k.axis, what)) return 1;
    if (isnan(k.angle)) {
        diag_error(b->diags, n, AT_VALUE, "E-missing-key", "%s: 'axis' needs an 'angle'", what);
        return 1;
    }
    warn_of_angle(b, node_find(n, "angle"), k.angle);
    q[0] = cos(k.angle / 2);
    for (int i = 0; i < 3; i++) q[i + 1] = sin(k.angle / 2) * axis[i];
    quat_matrix(R, q);
    return 0;
}

int scene_node(double *offset, const struct scene_body *body, const double *world)
{
    double d[3], x[3], least = INFINITY, size = 0;
    int node = 0;
    v3_diff(d, world, body->origin);
    m3_tmul(x, body->R, d);
    for (int i = 0; i < body->flex->nnode; i++) size = fmax(size, v3_norm(body->flex->node[i].x));
    for (int i = 0; i < body->flex->nnode; i++) {
        double away[3];
        v3_diff(away, x, body->flex->node[i].x);
        double distance = v3_norm(away);
        if (distance >= least - SAME_PLACE * size) continue; /* of two in one place the first */
        least = distance;
        node = i;
        v3_copy(offset, away);
    }
    return node;
}
