/* contacts.c -- surfaces of bodies, and which of them touch: rigid contacts, see kind/contact.h */
#include <math.h>
#include <string.h>

#include "kind/outline.h"
#include "la/rot.h"
#include "la/vec3.h"
#include "scene_read/parts.h"

static const double USUAL_SLIP = 1e-3; /* of compliant contacts whose friction is a number [m/s] */

static const struct {
    const char *word, *brief;
    const struct key *keys;
} shapes[SHAPES] = {{"plane", "a plane, fixed in a body", keys_plane},
                    {"point", "a point of a body", keys_spot},
                    {"points", "several points of bodies", keys_spots},
                    {"sphere", "a ball; in 2-D a disc", keys_sphere},
                    {"hole", "the inside of a ball; in 2-D of a bore", keys_hole},
                    {"profile", "a curve of y over x, 2-D", keys_profile},
                    {"cam", "a closed curve of radius over angle, 2-D", keys_cam}};

struct surface {
    const struct node *node;
    enum shape shape;
    int n;
    struct marker *at;        /* [n] */
    const struct node **spot; /* [n] where the deck names them; NULL: it is no surface of points */
    double radius, normal[3], along[3];
    const struct outline *outline;
};

static int shape_of(struct builder *b, const struct node *n)
{
    const char *words[SHAPES];
    for (int i = 0; i < SHAPES; i++) {
        words[i] = shapes[i].word;
        if (node_find(n, words[i])) return i;
    }
    if (not_there(b, n, "surfaces", "surface")) return -1;
    unknown_name(b, n->count ? n->item[0] : n, AT_KEY, "E-unknown-surface", "kind of surface",
                 n->count ? n->item[0]->key : "", words, SHAPES);
    return -1;
}

/* Bodies that bend have contacts at bodies of their own. */
static int refuse_bending(struct builder *b, const struct node *n, int body, const char *what, const char *why)
{
    if (!b->draft[body] && !b->scene->body[body].flex) return 0;
    diag_error(b->diags, n, AT_VALUE, "E-contact-flexible", "%s: '%.60s' bends: %s", what, b->scene->body[body].name,
               why);
    diag_hint(b->diags, "fix a small rigid body at the place; points touch by contacts with a 'stiffness', too");
    return 1;
}

/* A place on a body, by default its centre. */
static int place_on_body(struct builder *b, struct marker *o, const struct surface_keys *k, const char *what)
{
    double world[3];
    const int body = find_body(b, k->on);
    if (body < 0 || refuse_bending(b, k->on, body, what, "planes, balls and curves are of rigid bodies")) return 1;
    *o = (struct marker){.body = body};
    if (!k->at) return 0;
    if (read_place(b, world, k->at, what)) return 1;
    marker_at(o, b->scene, body, world);
    return 0;
}

/* Directions when drawn into the body's axes. */
static int read_axes(struct builder *b, struct surface *o, const struct surface_keys *k, const char *what)
{
    double normal[3], along[3] = {0};
    const double *R = b->scene->body[o->at->body].R;
    if (read_direction(b, normal, k->normal, what)) return 1;
    if (k->along && read_direction(b, along, k->along, what)) return 1;
    if (fabs(v3_dot(normal, along)) > 1e-6) {
        diag_error(b->diags, k->along, AT_VALUE, "E-axes", "%s: 'along' does not lie in the plane", what);
        return 1;
    }
    m3_tmul(o->normal, R, normal);
    m3_tmul(o->along, R, along);
    return 0;
}

/* Of two points of one place each would bear any share of the push. */
static int refuse_twin(struct builder *b, const struct surface *o, int i, const struct node *n, const char *what)
{
    for (int k = 0; k < i; k++) {
        if (o->at[k].body != o->at[i].body || memcmp(o->at[k].p, o->at[i].p, sizeof o->at[i].p) != 0) continue;
        diag_error(b->diags, n, AT_VALUE, "E-points", "%s: points %d and %d are of one place", what, k + 1, i + 1);
        return 1;
    }
    return 0;
}

static int read_spots(struct builder *b, struct surface *o, const struct node *list, const char *what)
{
    const bool one = o->shape == SHAPE_POINT;
    if (!one && read_list(list, what, &b->reader)) return 1;
    if (!one && list->count == 0) {
        diag_error(b->diags, list, AT_VALUE, "E-points", "%s: 'points' names none: nothing of it would touch", what);
        return 1;
    }
    o->n = one ? 1 : list->count;
    o->at = TAKE(b->life, struct marker, o->n);
    o->spot = TAKE(b->life, const struct node *, o->n);
    for (int i = 0; i < o->n; i++) {
        const struct node *n = o->spot[i] = one ? list : list->item[i];
        if (read_point(b, &o->at[i], n, what) || refuse_twin(b, o, i, n, what)) return 1;
    }
    return 0;
}

static int read_outline(struct builder *b, struct surface *o, const struct surface_keys *k, const char *what)
{
    static const double x_axis[3] = {1, 0, 0}, TURN = 2 * 3.14159265358979323846;
    const bool cam = o->shape == SHAPE_CAM;
    const struct points *p = &k->points;
    const struct node *n = node_find(o->node, "table");
    if (!n) n = node_find(o->node, "file");
    if (p->n < 2 + cam || (cam && !(p->x[p->n - 1] - p->x[0] < TURN))) {
        diag_error(b->diags, n, AT_VALUE, "E-table", "%s: %s", what,
                   cam ? "expected three points or more, within one turn, the first not repeated at its end"
                       : "expected two points or more");
        return 1;
    }
    o->outline = outline_make(p, cam, b->life);
    m3_tmul(o->normal, b->scene->body[o->at->body].R, x_axis);
    if (!cam || outline_least(o->outline) > 0) return 0;
    diag_error(b->diags, n, AT_VALUE, "E-table", "%s: its radius falls to %.3g m: it is above 0 all round", what,
               outline_least(o->outline));
    return 1;
}

static int read_surface(struct builder *b, struct surface *o, const struct node *n)
{
    char what[100];
    struct surface_keys k = {0};
    snprintf(what, sizeof what, "surface '%.60s'", n->key);
    if (read_map(n, what, &b->reader)) return 1;
    const int shape = shape_of(b, n);
    if (shape < 0) return 1;
    *o = (struct surface){.node = n, .shape = shape, .n = 1};
    if (read_keys(&k, shapes[shape].keys, n, NULL, what, &b->reader)) return 1;
    if ((shape == SHAPE_PROFILE || shape == SHAPE_CAM) && one_table(b, n)) return 1;
    if (shape == SHAPE_POINT || shape == SHAPE_POINTS) return read_spots(b, o, k.on, what);
    o->at = TAKE(b->life, struct marker, 1);
    o->radius = k.radius;
    if (place_on_body(b, o->at, &k, what)) return 1;
    if (shape == SHAPE_PROFILE || shape == SHAPE_CAM) return read_outline(b, o, &k, what);
    return shape == SHAPE_PLANE ? read_axes(b, o, &k, what) : 0;
}

/* ---- contacts ---- */

static bool is_text(const struct node *n, const char *text)
{
    return n->type == NODE_SCALAR && strcmp(n->text, text) == 0;
}

/* One of a pair; what the pair has already is not meant. */
static const struct surface *find_surface(struct builder *b, const struct surface *all, int n, const struct node *pair,
                                          int which)
{
    const struct node *name = pair->item[which], *other = pair->item[!which];
    const char **list = TAKE(b->life, const char *, n);
    int left = 0;
    for (int i = 0; i < n; i++) {
        const char *key = all[i].node->key;
        if (is_text(name, key)) return &all[i];
        if (!is_text(other, key)) list[left++] = key;
    }
    unknown_name(b, name, AT_VALUE, "E-unknown-surface", "surface",
                 name->type == NODE_SCALAR ? name->text : "(no name)", list, left);
    return NULL;
}

/* Others touch it, and it touches none of its like. */
static bool is_ground(const struct surface *o)
{
    return o->shape != SHAPE_SPHERE && o->shape != SHAPE_POINT && o->shape != SHAPE_POINTS;
}

/* The pair, with the surface that has the spheres first; CONTACT_PAIRS: it is none. */
static enum contact_pair pair_of(const struct surface **first, const struct surface **second)
{
    const struct surface *a = *first, *b = *second;
    if (is_ground(a)) {
        *first = b;
        *second = a;
    }
    a = *first;
    b = *second;
    if (is_ground(a)) return CONTACT_PAIRS;
    if (b->shape == SHAPE_PLANE) return PAIR_PLANE;
    if (b->shape == SHAPE_HOLE) return PAIR_HOLE;
    if (b->outline) return PAIR_OUTLINE;
    if (a->shape != SHAPE_SPHERE) {
        *first = b;
        *second = a;
    }
    return (*first)->shape == SHAPE_SPHERE && (*second)->n == 1 ? PAIR_SPHERES : CONTACT_PAIRS;
}

static int read_friction(struct builder *b, struct contact_law *law, double *slip, const struct node *n,
                         const char *what)
{
    static const struct key number[] = {
        PARAM_REAL(struct contact_law, sliding, "friction", NULL, 0, INFINITY, KEY_BELOW, NULL, ""), KEYS_END};
    struct friction_keys k = {NAN, NAN, 0};
    *slip = USUAL_SLIP;
    if (!n) return 0;
    if (n->type != NODE_MAP) {
        if (read_number(&law->sliding, n, number, &b->reader)) return 1;
        law->holding = law->sliding;
        return 0;
    }
    if (read_keys(&k, keys_friction, n, NULL, "'friction'", &b->reader)) return 1;
    if (k.slip > 0) *slip = k.slip;
    return check_coefficients(b, law, k.kinetic, k.holding, n, what);
}

static void add(struct builder *b, const struct scene_contact *like, const struct surface *first,
                const struct surface *second, const struct contact_keys *k, double slip)
{
    struct scene *scene = b->scene;
    for (int i = 0; i < first->n; i++) {
        struct scene_contact o = *like;
        if (first->n > 1) o.name = arena_print(b->life, "%s.%d", like->name, i + 1);
        o.a = first->at[i];
        o.b = *second->at;
        if (k->push.k > 0)
            add_compliant(b, &o, k, slip);
        else
            scene->contact[scene->ncontact++] = o;
    }
}

/* A disc that is larger than a hollow touches it at two places, of which one is known. */
static int refuse_hollow(struct builder *b, const struct surface *disc, const struct surface *on, const char *what)
{
    double where, most = on->outline ? outline_hollow(on->outline, &where) : 0;
    if (!(disc->radius * most >= 1)) return 0;
    diag_error(b->diags, disc->node, AT_KEY, "E-hollow",
               "%s: the disc's radius is %.3g m, that of the hollow of '%.60s' at %.3g only %.3g m", what, disc->radius,
               on->node->key, where, 1 / most);
    diag_hint(b->diags,
              "a smaller disc reaches all of the curve; a wheel on a rough road has a smoother one, of its centre");
    return 1;
}

/* Rigid ones touch rigid bodies. */
static int refuse_bent_spots(struct builder *b, const struct surface *o)
{
    int errors = 0;
    char what[100];
    snprintf(what, sizeof what, "surface '%.60s'", o->node->key);
    for (int i = 0; o->spot && i < o->n; i++)
        errors += refuse_bending(b, o->spot[i], o->at[i].body, what, "rigid contacts are of rigid bodies");
    return errors;
}

static void read_contact(struct builder *b, const struct surface *all, int n, const struct node *node)
{
    char what[100];
    double slip;
    struct contact_keys k = {0};
    snprintf(what, sizeof what, "contact '%.60s'", node->key);
    if (read_map(node, what, &b->reader) || read_keys(&k, keys_contact, node, NULL, what, &b->reader)) return;
    if (k.between->type != NODE_LIST || k.between->count != 2) {
        diag_error(b->diags, k.between, AT_VALUE, "E-type", "%s: expected two surfaces, [first, second]", what);
        return;
    }
    const struct surface *first = find_surface(b, all, n, k.between, 0),
                         *second = find_surface(b, all, n, k.between, 1);
    if (!first || !second) return;
    struct scene_contact o = {.name = node->key, .node = node, .pair = pair_of(&first, &second), .measure = -1};
    if (o.pair == CONTACT_PAIRS) {
        diag_error(b->diags, k.between, AT_VALUE, "E-pair", "%s: %s and %s do not make a contact", what,
                   shapes[first->shape].word, shapes[second->shape].word);
        diag_hint(b->diags, "known pairs: point or sphere and plane, hole, profile or cam, sphere and sphere or point");
        return;
    }
    for (int i = 0; i < first->n; i++)
        if (first->at[i].body == second->at->body) {
            diag_error(b->diags, k.between, AT_VALUE, "E-same-body", "%s: both surfaces are on '%.60s'", what,
                       b->scene->body[second->at->body].name);
            return;
        }
    if (refuse_hollow(b, first, second, what)) return;
    o.outline = second->outline;
    o.law.restitution = k.restitution;
    o.law.speed = k.speed;
    o.radius = first->radius;
    o.other = second->radius;
    v3_copy(o.normal, second->normal);
    v3_copy(o.along, second->along);
    if (k.speed != 0 && o.pair != PAIR_PLANE) {
        diag_error(b->diags, node_find(node, "speed"), AT_KEY, "E-pair", "%s: 'speed' is that of a plane, a belt",
                   what);
        return;
    }
    if (read_friction(b, &o.law, &slip, k.friction, what) || check_compliant(b, &k, node, what)) return;
    if (!(k.push.k > 0) && refuse_bent_spots(b, first) + refuse_bent_spots(b, second)) return;
    add(b, &o, first, second, &k, slip);
}

static int count_spots(const struct surface *all, int n)
{
    int most = 1;
    for (int i = 0; i < n; i++) most = all[i].n > most ? all[i].n : most;
    return most;
}

/* Behind the stops; for compliant ones among the forces. */
static void make_room(struct builder *b, int more)
{
    struct scene *scene = b->scene;
    struct scene_contact *all = TAKE(b->life, struct scene_contact, scene->ncontact + more);
    if (scene->ncontact) memcpy(all, scene->contact, (size_t)scene->ncontact * sizeof *all);
    scene->contact = all;
    struct scene_force *forces = TAKE(b->life, struct scene_force, scene->nforce + 2 * more);
    if (scene->nforce) memcpy(forces, scene->force, (size_t)scene->nforce * sizeof *forces);
    scene->force = forces;
}

static void keep_surfaces(struct builder *b, const struct surface *all, int n)
{
    struct scene_surface *o = b->scene->surface = TAKE(b->life, struct scene_surface, n);
    for (int i = 0; i < n; i++) {
        for (int k = 0; k < all[i].n; k++) b->scene->body[all[i].at[k].body].touches = true;
        if (all[i].shape == SHAPE_POINT || all[i].shape == SHAPE_POINTS) continue;
        *o = (struct scene_surface){.name = all[i].node->key,
                                    .shape = all[i].shape,
                                    .at = *all[i].at,
                                    .radius = all[i].radius,
                                    .outline = all[i].outline};
        v3_copy(o->normal, all[i].normal);
        o++;
    }
    b->scene->nsurface = (int)(o - b->scene->surface);
}

void read_contacts(struct builder *b, const struct node *surfaces, const struct node *contacts)
{
    int n = 0;
    if (surfaces && read_map(surfaces, "'surfaces'", &b->reader)) return;
    if (contacts && read_map(contacts, "'contacts'", &b->reader)) return;
    struct surface *all = TAKE(b->life, struct surface, surfaces ? surfaces->count : 0);
    for (int i = 0; surfaces && i < surfaces->count && !diags_full(b->diags); i++)
        if (!read_surface(b, &all[n], surfaces->item[i])) n++;
    keep_surfaces(b, all, n);
    if (!contacts || (surfaces && n < surfaces->count)) return;
    make_room(b, contacts->count * count_spots(all, n));
    for (int i = 0; i < contacts->count && !diags_full(b->diags); i++) {
        const struct node *c = contacts->item[i];
        if (!wrong_name(b, c, "contact")) read_contact(b, all, n, c);
    }
}
