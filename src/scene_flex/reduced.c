/* reduced.c -- a flexible body from a file that fmdsub-reduce wrote: where it stands, names of its nodes.
 *
 * The file's own axes, those of its mesh, are the body's. */
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "flex/file.h"
#include "la/vec3.h"
#include "scene_flex/flexible.h"

static const double SAME = 1e-9;

const struct key keys_reduced[] = {
    PARAM_TEXT(struct reduced_keys, file, "flexible", KEY_REQUIRED, NULL, "file of fmdsub-reduce beside the deck"),
    PARAM_NODE(struct reduced_keys, at, "at", "vector [m]", 0, "centre of mass when drawn, world"),
    PARAM_NODE(struct reduced_keys, origin, "origin", "vector [m]", 0,
               "or the origin of the mesh when drawn, world; one of both"),
    PARAM_NODE(struct reduced_keys, orient, "orient",
               "2-D: angle [rad]; 3-D: {x: [...], z: [...]} or one of them, {axis: [...], angle: a}, {quaternion: [w, "
               "x, y, z]}",
               0, "axes of the mesh when drawn; default: the world's"),
    PARAM_WORD(struct reduced_keys, modes, "modes", "all|auto", 0, "all",
               "coordinates kept; auto: of modes those that the deck's loads, motions and columns ask for, to the "
               "tolerance of 'effects' (1.0e-3)"),
    PARAM_NODE(struct reduced_keys, points, "points", "{name: node}, {name: vector [m]}", 0,
               "named points besides the file's named nodes; a vector is from the centre of mass, axes of the mesh"),
    KEYS_END,
};

/* Every step-th of n numbers. */
static double largest(const double *x, int step, int n)
{
    double most = 0;
    for (int i = 0; i < n; i += step) most = fmax(most, fabs(x[i]));
    return most;
}

/* Does it stand and move in the x-y plane?  Of each coordinate, particles count by their kinetic energy; nodes count by
 * their displacements and turns. */
static bool is_planar(const struct flex_body *o, struct arena *life)
{
    const int n = o->n;
    double *Me = TAKE(life, double, n *n), size = 0, most = 0, turn = 0;
    flex_mass(Me, o);
    for (int j = 0; j < n * n; j += n + 1)
        if (o->ff[9 * j + 8] > SAME * SAME * Me[j]) return false;
    for (int i = 0; i < o->nnode; i++) {
        size = fmax(size, v3_norm(o->node[i].x));
        most = fmax(most, largest(o->node[i].phi, 1, 3 * n));
        turn = fmax(turn, largest(o->node[i].psi, 1, 3 * n));
    }
    for (int i = 0; i < o->nnode; i++) {
        const struct flex_node *p = &o->node[i];
        if (fabs(p->x[2]) > SAME * size || largest(p->phi + 2, 3, 3 * n - 2) > SAME * most) return false;
        if (fmax(largest(p->psi, 3, 3 * n), largest(p->psi + 1, 3, 3 * n - 1)) > SAME * turn) return false;
    }
    return true;
}

/* Without displacements of second order: what the deck wishes of files, which have no key of their own for it. */
static void take_off_stiffening(struct flex_body *o)
{
    o->s = o->xs = NULL;
    for (int i = 0; i < o->nnode; i++) o->node[i].S = o->node[i].T = NULL;
}

static int read_file(struct builder *b, struct scene_body *body, double *centre, const struct node *n)
{
    struct flex_body *flex;
    struct report report = {0};
    const char *path = deck_file(n, b->reader.deck);
    if (!path) return 1;
    if (flex_file_read(&flex, centre, path, b->life, &report) == OK) {
        if (b->scene->space == 2 && !is_planar(flex, b->life)) {
            diag_error(b->diags, n, AT_VALUE, "E-dimension",
                       "'%s' moves out of the plane of x and y: it needs a 3-D deck", diag_clip(b->diags, n->text));
            return 1;
        }
        if (b->scene->effects.wish[EFFECT_STIFFENING] == WISH_OFF && flex->s) {
            b->scene->off |= effect_bit(EFFECT_STIFFENING);
            struct flex_body *full = TAKE(b->life, struct flex_body, 1);
            struct flex_node *node = TAKE(b->life, struct flex_node, flex->nnode);
            *full = *flex;
            memcpy(node, flex->node, (size_t)flex->nnode * sizeof *node);
            full->node = node;
            body->full = full;
            take_off_stiffening(flex);
        }
        body->flex = flex;
        body->nmode = flex->n;
        return 0;
    }
    const char *text = strstr(report.text, ": error: ");
    diag_error(b->diags, n, AT_VALUE, "E-flexible", "'%s': %s", diag_clip(b->diags, n->text),
               text ? text + strlen(": error: ") : report.text);
    return 1;
}

int read_reduced(struct builder *b, struct scene_body *body, const struct node *n)
{
    struct reduced_keys k = {0};
    double centre[3] = {0, 0, 0}, arm[3];
    char what[100];
    snprintf(what, sizeof what, "body '%.60s'", n->key);
    int errors = read_keys(&k, keys_reduced, n, NULL, what, &b->reader);
    if (!k.at == !k.origin) {
        diag_error(b->diags, n, AT_KEY, k.at ? "E-two-kinds" : "E-missing-key", "%s: expected 'at' or 'origin'", what);
        errors++;
    }
    if (k.orient) errors += read_orientation(b, body->R, k.orient, what);
    if (k.at || k.origin) errors += read_place(b, body->at, k.at ? k.at : k.origin, what);
    if (errors || read_file(b, body, centre, node_find(n, "flexible"))) return errors + 1;
    m3_mul(arm, body->R, centre);
    if (k.origin) v3_add(body->at, arm);
    if (b->scene->space == 2) body->at[2] = 0;
    v3_copy(body->origin, body->at);
    return 0;
}

int read_node_name(struct builder *b, double *p, int body, const struct node *n)
{
    const struct flex_body *flex = b->scene->body[body].flex;
    const char **names = TAKE(b->life, const char *, flex->nnode);
    int count = 0;
    for (int i = 0; i < flex->nnode; i++) {
        if (!flex->node[i].name) continue;
        names[count++] = flex->node[i].name;
        if (strcmp(flex->node[i].name, n->text) != 0) continue;
        v3_copy(p, flex->node[i].x);
        return 0;
    }
    diag_error(b->diags, n, AT_VALUE, "E-unknown-point", "body '%s' has no node '%s'", b->scene->body[body].name,
               diag_clip(b->diags, n->text));
    diag_suggest(b->diags, n->text, names, count);
    return 1;
}

/* The nodes that have names, but for those whose names the deck gives to points of its own. */
void name_nodes(struct builder *b, int body, const struct node *points)
{
    struct scene *scene = b->scene;
    const struct flex_body *flex = scene->body[body].flex;
    for (int i = 0; i < flex->nnode; i++) {
        const char *name = flex->node[i].name;
        if (!name || !text_is_name(name) || (points && points->type == NODE_MAP && node_find(points, name))) continue;
        struct scene_point *p = &scene->point[scene->npoint++];
        p->name = arena_print(b->life, "%s.%s", scene->body[body].name, name);
        p->at = (struct marker){.body = body};
        v3_copy(p->at.p, flex->node[i].x);
    }
}
