/* beams.c -- a body that is a beam: its axis, damping, masses, points and stresses.
 *
 * The centre of mass of the undeformed beam is needed before the beam is made: from the axis, along which the area
 * is linear between the stations s0, s1 of sections,
 *
 *     m = rho L sum d (A0 + A1)/2,     m s_c = rho L sum d (s0 (A0 + A1)/2 + d (A0 + 2 A1)/6),     d = s1 - s0,
 *
 * and the masses it carries. */
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "la/rot.h"
#include "la/vec3.h"
#include "scene_flex/flexible.h"

/* Body axes: x along the beam, z towards up. */
static int read_axes(struct builder *b, struct scene_body *body, struct draft *o, const struct beam_keys *k,
                     const char *what)
{
    double axis[3], up[3];
    v3_diff(axis, o->beam.b, o->beam.a);
    o->length = v3_norm(axis);
    if (!(o->length > 0)) {
        diag_error(b->diags, k->to, AT_VALUE, "E-direction", "%s: a beam of length 0", what);
        return 1;
    }
    v3_copy(up, up_of(axis));
    if (k->up && read_direction(b, up, k->up, what)) return 1;
    if (!matrix_of_axes(body->R, 0, axis, 2, up)) {
        diag_error(b->diags, k->up, AT_VALUE, "E-direction", "%s: 'up' lies along the beam", what);
        return 1;
    }
    memcpy(o->beam.R, body->R, sizeof body->R);
    v3_copy(o->beam.up, body->R + 6);
    return 0;
}

/* Does the beam have this effect?  With its own key in `map`, or `auto` under `effects` of the deck: as `own` says; else as
 * `effects` says.  usual: a beam has it as a rule, so one that goes without is noted as left out (scene.off). */
static bool wants_effect(struct builder *b, const struct node *map, const char *key, enum effect_id id, bool own,
                         bool usual)
{
    const struct node *n = node_find(map, key);
    const int wish = b->scene->effects.wish[id];
    const bool wanted = (n && !n->implied) || wish == WISH_AUTO ? own : wish == WISH_ON;
    if (wanted) b->scene->in_beams |= effect_bit(id);
    if (wanted || !usual) return wanted;
    if (!(b->unheard & effect_bit(id))) b->scene->off |= effect_bit(id);
    return (b->unheard & effect_bit(id)) != 0;
}

static int read_axis(struct builder *b, struct scene_body *body, struct draft *o, const struct beam_body_keys *k,
                     const char *what)
{
    struct beam_keys a = {.shear = -1, .rotary = 1};
    int errors = read_keys(&a, keys_beam, k->beam, NULL, what, &b->reader);
    if (a.from) errors += read_place(b, o->beam.a, a.from, what);
    if (a.to) errors += read_place(b, o->beam.b, a.to, what);
    if (errors) return errors;
    const struct node *sections = k->section ? k->section : k->sections;
    o->beam.elements = a.elements;
    const bool given = sections && gives_shear(sections), shear = a.shear >= 0 ? a.shear : given;
    const bool denied = a.shear == 0 || b->denied & effect_bit(EFFECT_SHEAR);
    o->rotary = wants_effect(b, k->beam, "rotary", EFFECT_ROTARY, a.rotary, true);
    o->shear =
        wants_effect(b, k->beam, "shear", EFFECT_SHEAR, shear, given || (denied && knows_shear(sections, k->material)));
    o->unasked = !o->shear && a.shear < 0 && b->scene->effects.wish[EFFECT_SHEAR] == WISH_AUTO;
    return read_axes(b, body, o, &a, what);
}

static int read_damping(struct builder *b, struct draft *o, const struct node *n, const char *what)
{
    struct damping_keys k = {0};
    if (read_keys(&k, keys_damping, n, NULL, what, &b->reader)) return 1;
    if (k.ratio > 0 && (k.alpha > 0 || k.beta > 0)) {
        diag_error(b->diags, node_find(n, "ratio"), AT_KEY, "E-two-kinds",
                   "%s: damping by 'ratio' and by 'alpha', 'beta'", what);
        return 1;
    }
    o->beam.alpha = k.alpha;
    o->beam.beta = k.beta;
    o->beam.zeta = k.ratio;
    return 0;
}

/* What is said of the body's modes is then said of each piece's, which are far quicker. */
static void warn_of_pieces(struct builder *b, const struct draft *o, const struct beam_body_keys *k, const char *what)
{
    const bool ratio = o->beam.zeta > 0;
    if (k->segments <= 1 || !(ratio || o->beam.alpha > 0)) return;
    diag_warn(b->diags, k->damping, AT_KEY, "W-damping",
              "%s: damping by '%s' is that of each of its %d segments in itself: the whole beam has far less of it",
              what, ratio ? "ratio" : "alpha", k->segments);
    diag_hint(b->diags, "'beta' is the same for pieces and whole: 2*z/omega gives the mode of omega rad/s the ratio z");
}

static bool named(struct builder *b, const struct node *n)
{
    if (text_is_name(n->key)) return true;
    diag_error(b->diags, n, AT_KEY, "E-name", "'%.60s' is not a name", n->key);
    return false;
}

static int read_masses(struct builder *b, struct draft *o, const struct node *n, const char *what)
{
    if (read_map(n, "'masses'", &b->reader)) return 1;
    struct flex_lump *lump = TAKE(b->life, struct flex_lump, n->count);
    int errors = 0;
    for (int i = 0; i < n->count; i++) {
        struct lump_keys k = {0};
        if (!named(b, n->item[i]) || read_keys(&k, keys_lump, n->item[i], NULL, what, &b->reader) ||
            (k.inertia && read_inertia(b, lump[i].inertia, k.inertia, true, what)))
            errors++;
        lump[i].station = k.station;
        lump[i].mass = k.mass;
    }
    o->beam.lump = lump;
    o->beam.nlump = n->count;
    return errors;
}

/* Corners as the deck names them, in half sizes of y and z. */
static int corner(struct builder *b, struct flex_probe *p, const struct draft *o, int word, const struct node *n,
                  const char *what)
{
    static const double y[] = {0, 0, 1, -1, 1, -1, 1, -1}, z[] = {1, -1, 0, 0, 1, 1, -1, -1};
    if (b->scene->space == 2) {
        if (word < 2) return p->y = z[word], 0;
        diag_error(b->diags, n, AT_VALUE, "E-dimension", "%s: a planar beam has a top and a bottom", what);
        return 1;
    }
    double size = word > 3 && o->round ? sqrt(0.5) : 1;
    p->y = size * y[word];
    p->z = size * z[word];
    return 0;
}

/* Are the half sizes known that the place needs? */
static bool sized(const struct draft *o, const struct flex_probe *p)
{
    bool known = true;
    for (int i = 0; i < o->beam.nsection; i++)
        known = known && (p->y == 0 || o->beam.section[i].y > 0) && (p->z == 0 || o->beam.section[i].z > 0);
    return known;
}

static int read_probe(struct builder *b, struct flex_probe *p, const struct draft *o, const struct node *n,
                      const char *what)
{
    struct probe_keys k = {.y = NAN, .z = NAN, .corner = -1};
    if (!named(b, n) || read_keys(&k, keys_probe, n, NULL, what, &b->reader)) return 1;
    bool places = !isnan(k.y) || !isnan(k.z);
    *p = (struct flex_probe){.name = n->key, .station = k.station, .y = k.y, .z = k.z};
    if (isnan(k.y)) p->y = 0;
    if (isnan(k.z)) p->z = 0;
    if (k.corner >= 0 && places) {
        diag_error(b->diags, node_find(n, "corner"), AT_KEY, "E-two-kinds", "%s: both 'corner' and 'y', 'z'", what);
        return 1;
    }
    if (k.corner >= 0 && corner(b, p, o, k.corner, node_find(n, "corner"), what)) return 1;
    if (o->wrong || sized(o, p)) return 0;
    diag_error(b->diags, n, AT_KEY, "E-section", "%s: stress at '%.60s' needs the section's half sizes", what, n->key);
    diag_hint(b->diags, "give %s in the section", b->scene->space == 2 ? "'y'" : "'y' and 'z'");
    return 1;
}

static int read_probes(struct builder *b, struct draft *o, const struct node *n, const char *what)
{
    if (read_map(n, "'stress'", &b->reader)) return 1;
    struct flex_probe *p = TAKE(b->life, struct flex_probe, n->count);
    int errors = 0;
    for (int i = 0; i < n->count; i++) errors += read_probe(b, &p[i], o, n->item[i], what);
    o->beam.probe = p;
    o->beam.nprobe = n->count;
    return errors;
}

/* See the head. */
void weigh_beam(struct scene_body *body, struct draft *o)
{
    const struct flex_beam *beam = &o->beam;
    double mass = 0, moment = 0;
    for (int i = 0; i + 1 < beam->nsection; i++) {
        const struct flex_section *s = &beam->section[i];
        const double d = s[1].station - s[0].station;
        struct flex_section middle;
        section_between(&middle, s, s + 1, 0.5);
        mass += d * (s[0].A + 4 * middle.A + s[1].A) / 6;
        moment += d * (s[0].station * s[0].A + 4 * middle.station * middle.A + s[1].station * s[1].A) / 6;
    }
    if (beam->nsection == 1) {
        mass = beam->section->A;
        moment = mass / 2;
    }
    mass *= beam->density * o->length;
    moment *= beam->density * o->length;
    for (int i = 0; i < beam->nlump; i++) {
        mass += beam->lump[i].mass;
        moment += beam->lump[i].mass * beam->lump[i].station;
    }
    o->centre = moment / mass;
    body->mass = mass;
    v3_copy(body->at, beam->a);
    v3_axpy(body->at, o->centre * o->length, body->R);
}

int read_station(struct builder *b, struct scene_point *o, int body, const struct node *n, const char *what)
{
    const struct draft *d = b->draft[body];
    struct station_keys k = {0};
    if (read_keys(&k, keys_station, n, NULL, what, &b->reader)) return 1;
    o->statics = k.statics;
    v3_set(o->at.p, 0, 0, 0);
    if (k.offset && read_place(b, o->at.p, k.offset, what)) return 1;
    o->at.p[0] += (station_in(d, k.station) - d->centre) * d->length;
    return 0;
}

int read_beam(struct builder *b, struct scene_body *body, int index, const struct node *n)
{
    struct beam_body_keys k = {0};
    struct draft *o = TAKE(b->life, struct draft, 1);
    char what[100];
    snprintf(what, sizeof what, "body '%.60s'", n->key);
    b->draft[index] = o;
    o->to = 1;
    o->beam.space = b->scene->space;
    int errors = read_keys(&k, keys_beam_body, n, NULL, what, &b->reader);
    o->beam.G = NAN; /* sections are read without, too: their own errors are reported */
    if (k.beam) errors += read_axis(b, body, o, &k, what);
    if (k.material) errors += read_material(b, o, k.material, what);
    errors += read_sections(b, o, &k, n, what);
    if (k.damping) errors += read_damping(b, o, k.damping, what);
    if (k.masses) errors += read_masses(b, o, k.masses, what);
    o->wrong = errors > 0;
    if (k.stress) errors += read_probes(b, o, k.stress, what);
    if (errors) return errors;
    warn_of_beam(b, o, k.material, k.beam, k.section ? k.section : k.sections, what);
    o->modes = node_find(n, "modes");
    o->choose = k.modes == 0;
    o->beam.modes = body->nmode = o->choose ? MOST_CANDIDATES : k.modes;
    o->beam.stiffening = wants_effect(b, n, "stiffening", EFFECT_STIFFENING, k.stiffening, true);
    memcpy(body->stout, o->stout, sizeof body->stout);
    weigh_beam(body, o);
    warn_of_pieces(b, o, &k, what);
    if (k.segments > 1) cut_beam(b, index, k.segments);
    return 0;
}
