/* bodies.c -- masses, inertias, drawn places and named points of rigid bodies */
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "la/vec3.h"
#include "scene_flex/flexible.h"
#include "scene_read/parts.h"

static const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
static const double pi = 3.14159265358979323846;

/* A solid's volume and its inertia per mass about the centre, diagonal in body axes. */
struct solid {
    double volume, i[3];
};

static struct solid box_solid(const double *a)
{
    double x = a[0] * a[0] / 12, y = a[1] * a[1] / 12, z = a[2] * a[2] / 12;
    return (struct solid){a[0] * a[1] * a[2], {y + z, x + z, x + y}};
}

/* a: outer radius, inner radius, length; along z. */
static struct solid tube_solid(const double *a)
{
    double round = a[0] * a[0] + a[1] * a[1], across = round / 4 + a[2] * a[2] / 12;
    return (struct solid){pi * (a[0] * a[0] - a[1] * a[1]) * a[2], {across, across, round / 2}};
}

static struct solid ball_solid(double r)
{
    double i = 0.4 * r * r;
    return (struct solid){4 * pi / 3 * r * r * r, {i, i, i}};
}

static int read_sizes(struct builder *b, double *a, int n, const struct node *node, const char *what)
{
    if (n == 1 ? read_number(a, node, NULL, &b->reader) : read_vector(a, n, node, what, &b->reader)) return 1;
    for (int i = 0; i < n; i++)
        if (!(a[i] > 0)) {
            diag_error(b->diags, n == 1 ? node : node->item[i], AT_VALUE, "E-range", "%s: sizes must be positive",
                       what);
            return 1;
        }
    return 0;
}

/* A rod by its two ends: its length, and where the body stands. */
static int read_ends(struct builder *b, double *length, struct scene_body *body, const struct body_keys *k,
                     const struct node *n, const char *what)
{
    struct rod_keys rod = {0};
    double from[3], to[3], along[3];
    if (read_keys(&rod, keys_rod, n, NULL, what, &b->reader)) return 1;
    if (k->at || k->orient) {
        diag_error(b->diags, k->at ? k->at : k->orient, AT_KEY, "E-two-kinds",
                   "%s: the ends of its rod say where it stands, and so does '%s'", what, k->at ? "at" : "orient");
        return 1;
    }
    if (read_place(b, from, rod.from, what) | read_place(b, to, rod.to, what)) return 1;
    v3_diff(along, to, from);
    *length = v3_norm(along);
    if (!(*length > 0)) {
        diag_error(b->diags, rod.to, AT_VALUE, "E-direction", "%s: a rod of length 0", what);
        return 1;
    }
    for (int i = 0; i < 3; i++) body->at[i] = from[i] + along[i] / 2;
    frame_along(body->R, along);
    return 0;
}

static int read_solid(struct builder *b, struct solid *o, struct scene_body *body, const struct body_keys *of,
                      const struct shape_keys *k, const struct node *n, const char *what)
{
    double a[3];
    int given = !!k->box + !!k->cylinder + !!k->rod + !!k->sphere + !!k->tube;
    if (given != 1) {
        diag_error(b->diags, n, AT_VALUE, "E-shape", "%s: expected one of box, cylinder, rod, sphere, tube", what);
        return 1;
    }
    if (k->box) {
        if (read_sizes(b, a, 3, k->box, what)) return 1;
        *o = box_solid(a);
    } else if (k->cylinder) {
        double c[2];
        if (read_sizes(b, c, 2, k->cylinder, what)) return 1;
        *o = tube_solid((double[]){c[0], 0, c[1]});
    } else if (k->tube) {
        if (read_sizes(b, a, 3, k->tube, what)) return 1;
        *o = tube_solid(a);
    } else if (k->sphere) {
        if (read_sizes(b, a, 1, k->sphere, what)) return 1;
        *o = ball_solid(a[0]);
    } else {
        if (k->rod->type == NODE_MAP ? read_ends(b, a, body, of, k->rod, what) : read_sizes(b, a, 1, k->rod, what))
            return 1;
        *o = (struct solid){0, {0, a[0] * a[0] / 12, a[0] * a[0] / 12}};
    }
    if (o->volume >= 0) return 0;
    diag_error(b->diags, n, AT_VALUE, "E-range", "%s: the inner radius is larger than the outer", what);
    return 1;
}

static int read_shape(struct builder *b, struct scene_body *body, const struct body_keys *k, const char *what)
{
    struct shape_keys s = {.density = 0};
    struct solid solid;
    if (read_keys(&s, keys_shape, k->shape, NULL, what, &b->reader)) return 1;
    if (read_solid(b, &solid, body, k, &s, k->shape, what)) return 1;
    if (isnan(body->mass)) {
        if (!(s.density > 0 && solid.volume > 0)) {
            diag_error(b->diags, k->shape, AT_VALUE, "E-missing-key", "%s: no 'mass', and no volume and density", what);
            return 1;
        }
        body->mass = s.density * solid.volume;
    } else if (s.density > 0) {
        diag_error(b->diags, node_find(k->shape, "density"), AT_KEY, "E-two-kinds", "%s: both mass and density", what);
        return 1;
    }
    warn_of_density(b, k->shape, body->mass, solid.volume, what);
    for (int i = 0; i < 3; i++) body->inertia[i] = body->mass * solid.i[i];
    return 0;
}

/* A place on a body: a vector, on a beam a station, of a body from a file the name of a node. */
static int read_spot(struct builder *b, struct scene_point *p, int body, const struct node *n, const char *what)
{
    if (n->type == NODE_MAP && b->draft[body]) return read_station(b, p, body, n, what);
    if (b->scene->body[body].whole) {
        diag_error(b->diags, n, AT_VALUE, "E-type", "%s of a beam in segments are at stations, {station: s}", what);
        return 1;
    }
    if (n->type == NODE_SCALAR && b->scene->body[body].flex) return read_node_name(b, p->at.p, body, n);
    if (n->type == NODE_SCALAR && body > 0 && is_from_file(b->scene->body[body].node)) return 1; /* nodes not known */
    return read_place(b, p->at.p, n, what);
}

static int read_points(struct builder *b, int body, const struct node *n, const char *what)
{
    struct scene *scene = b->scene;
    if (!n) return 0;
    if (read_map(n, what, &b->reader)) return 1;
    int errors = 0;
    for (int i = 0; i < n->count && !diags_full(b->diags); i++) {
        struct scene_point *p = &scene->point[scene->npoint];
        if (!text_is_name(n->item[i]->key)) {
            diag_error(b->diags, n->item[i], AT_KEY, "E-name", "'%.60s' is not a name", n->item[i]->key);
            errors++;
            continue;
        }
        if (!holds_point(b, body, n->item[i])) continue;
        const char *owner = scene->body[body].whole ? scene->body[body].whole : scene->body[body].name;
        p->name = arena_print(b->life, "%s.%s", owner, n->item[i]->key);
        p->at.body = body;
        if (read_spot(b, p, body, n->item[i], what))
            errors++;
        else
            scene->npoint++;
    }
    return errors;
}

/* Is it a rod that is given by its ends? */
static bool has_ends(const struct body_keys *k)
{
    const struct node *rod = k->shape && k->shape->type == NODE_MAP ? node_find(k->shape, "rod") : NULL;
    return rod && rod->type == NODE_MAP;
}

static int read_rigid(struct builder *b, struct scene_body *body, const struct node *n)
{
    struct body_keys k = {.mass = NAN, .inertia_check = 1};
    char what[100];
    snprintf(what, sizeof what, "body '%.60s'", n->key);
    static const char *const others[] = {"beam", "flexible", NULL};
    int errors = read_keys(&k, keys_body, n, others, what, &b->reader);
    body->mass = k.mass;
    if (k.at) errors += read_place(b, body->at, k.at, what);
    if (k.orient) errors += read_orientation(b, body->R, k.orient, what);
    if (k.shape) errors += read_shape(b, body, &k, what);
    if (k.inertia) errors += read_inertia(b, body->inertia, k.inertia, k.inertia_check, what);
    if (!errors && k.shape && k.inertia && !isnan(k.mass)) {
        diag_warn(b->diags, k.shape, AT_KEY, "W-unused", "%s: 'mass' and 'inertia' leave nothing for its shape to give",
                  what);
    }
    if (!errors && !k.at && !has_ends(&k)) {
        diag_error(b->diags, n, AT_KEY, "E-missing-key", "%s has no 'at'", what);
        diag_hint(b->diags, "at: centre of mass when drawn, world");
        errors++;
    }
    if (!errors && isnan(body->mass)) {
        diag_error(b->diags, n, AT_KEY, "E-missing-key", "%s has no 'mass'", what);
        errors++;
    }
    return errors;
}

/* Has it a key that only a beam has?  Its own word may be misspelt. */
static bool is_beam(const struct node *n)
{
    static const char *const keys[] = {"beam", "section", "sections", "material", "stress"};
    for (int i = 0; n->type == NODE_MAP && i < 5; i++)
        if (node_find(n, keys[i])) return true;
    return false;
}

/* A beam and a file at once: nothing is read of it. */
static bool is_both(const struct node *n)
{
    return n->type == NODE_MAP && node_find(n, "flexible") && node_find(n, "beam");
}

static int read_body(struct builder *b, int index, const struct node *n)
{
    struct scene_body *body = &b->scene->body[index];
    const bool placed = n->type != NODE_MAP || node_find(n, "at") || is_beam(n) || is_from_file(n);
    if (!placed && not_there(b, n, "bodies", "body")) return 1;
    if (is_both(n)) {
        diag_error(b->diags, node_find(n, "flexible"), AT_KEY, "E-two-kinds",
                   "body '%.60s' is a beam, or from a file: expected 'beam' or 'flexible'", n->key);
        diag_note(b->diags, node_find(n, "beam"), AT_KEY, "this makes it a beam");
        return 1;
    }
    if (is_from_file(n)) return read_reduced(b, body, n);
    if (is_beam(n)) return read_beam(b, body, index, n);
    return read_rigid(b, body, n);
}

static void read_ground(struct builder *b, const struct node *n)
{
    struct ground_keys k = {0};
    if (read_keys(&k, keys_ground, n, NULL, "the ground", &b->reader)) return;
    read_points(b, 0, k.points, "points of the ground");
}

static int count_points(const struct scene *scene, const struct node *bodies)
{
    int count = 0;
    for (int i = 1; i < scene->nbody; i++) count += scene->body[i].flex ? scene->body[i].flex->nnode : 0;
    for (int i = 0; i < bodies->count; i++) {
        const struct node *points = bodies->item[i]->type == NODE_MAP ? node_find(bodies->item[i], "points") : NULL;
        if (points) count += points->count;
    }
    return count;
}

/* Segments may have taken the name of another body. */
static void refuse_same_names(struct builder *b)
{
    const struct scene *scene = b->scene;
    for (int i = 1; i < scene->nbody; i++)
        for (int k = 1; k < i; k++) {
            if (strcmp(scene->body[i].name, scene->body[k].name) != 0) continue;
            const struct node *at = scene->body[i].whole ? scene->body[i].node : scene->body[k].node;
            diag_error(b->diags, at, AT_KEY, "E-duplicate-name", "a segment of '%s' has the name of body '%s'", at->key,
                       scene->body[i].name);
            return;
        }
}

void read_bodies(struct builder *b, const struct node *n)
{
    struct scene *scene = b->scene;
    const int most = n->count + 1 + (n->type == NODE_MAP ? more_segments(b, n) : 0);
    scene->body = TAKE(b->life, struct scene_body, most);
    b->draft = TAKE(b->life, struct draft *, most);
    scene->body[0].name = "ground";
    memcpy(scene->body[0].R, identity, sizeof identity);
    scene->nbody = 1;
    if (read_map(n, "'bodies'", &b->reader)) return;
    for (int i = 0; i < n->count && !diags_full(b->diags); i++) {
        const struct node *item = n->item[i];
        if (strcmp(item->key, "ground") == 0) continue;
        struct scene_body *body = &scene->body[scene->nbody];
        body->name = item->key;
        body->node = item;
        memcpy(body->R, identity, sizeof identity);
        if (wrong_name(b, item, "body"))
            diag_hint(b->diags,
                      "names are letters, digits and '_', a letter first; energy, momentum and step are taken");
        scene->nbody++; /* kept, right or wrong: joints may name it */
        read_body(b, scene->nbody - 1, item);
    }
    const struct node *ground = node_find(n, "ground");
    scene->point = TAKE(b->life, struct scene_point, count_points(scene, n));
    if (ground) read_ground(b, ground);
    for (int i = 1; i < scene->nbody; i++) {
        if (scene->body[i].node->type != NODE_MAP || is_both(scene->body[i].node)) continue;
        const struct node *points = node_find(scene->body[i].node, "points");
        if (scene->body[i].flex) name_nodes(b, i, points);
        read_points(b, i, points, "'points'");
    }
    if (most > n->count + 1) refuse_same_names(b);
    if (scene->nbody == 1 && !n->reported)
        diag_error(b->diags, n, AT_KEY, "E-no-bodies", "no bodies: nothing to simulate");
}
