/* beam_sections.c -- cross-sections and materials of beams. */
#include <math.h>
#include <string.h>

#include "scene_flex/flexible.h"

/* Room-temperature values of common grades: E [Pa], nu, density [kg/m3]. */
static const struct {
    const char *name;
    double E, nu, density;
} materials[] = {
    {"steel", 210e9, 0.3, 7850},     {"stainless", 193e9, 0.29, 8000}, {"aluminium", 70e9, 0.33, 2700},
    {"titanium", 114e9, 0.34, 4430}, {"magnesium", 45e9, 0.35, 1770},  {"brass", 100e9, 0.34, 8500},
};
enum { MATERIALS = sizeof materials / sizeof *materials };

static int named_material(struct builder *b, struct draft *o, const struct node *n, const char *what)
{
    const char *names[MATERIALS];
    for (int i = 0; i < MATERIALS; i++) {
        names[i] = materials[i].name;
        if (strcmp(n->text, names[i]) != 0) continue;
        o->beam.E = materials[i].E;
        o->beam.G = materials[i].E / (2 * (1 + materials[i].nu));
        o->beam.density = materials[i].density;
        return 0;
    }
    diag_error(b->diags, n, AT_VALUE, "E-material", "%s: unknown material '%s'", what, diag_clip(b->diags, n->text));
    diag_suggest(b->diags, n->text, names, MATERIALS);
    return 1;
}

int read_material(struct builder *b, struct draft *o, const struct node *n, const char *what)
{
    struct material_keys k = {.nu = NAN, .G = NAN};
    if (n->type == NODE_SCALAR) return named_material(b, o, n, what);
    if (read_keys(&k, keys_material, n, NULL, what, &b->reader)) return 1;
    if (!isnan(k.nu) && !isnan(k.G)) {
        diag_error(b->diags, node_find(n, "G"), AT_KEY, "E-two-kinds", "%s: both 'nu' and 'G'", what);
        return 1;
    }
    o->beam.E = k.E;
    o->beam.G = !isnan(k.G) ? k.G : k.E / (2 * (1 + k.nu));
    o->beam.density = k.density;
    warn_of_density(b, node_find(n, "density"), k.density, 1, what);
    if (!isnan(o->beam.G) || (b->scene->space == 2 && !o->shear)) return 0;
    diag_error(b->diags, n, AT_VALUE, "E-missing-key", "%s: torsion and shear need 'nu' or 'G'", what);
    return 1;
}

static double nu_of(const struct draft *o)
{
    double nu = o->beam.E / (2 * o->beam.G) - 1;
    return isfinite(nu) ? nu : 0;
}

static int sizes(struct builder *b, double *a, int n, const struct node *node, const char *what)
{
    if (n == 1 ? read_number(a, node, NULL, &b->reader) : read_vector(a, n, node, what, &b->reader)) return 1;
    for (int i = 0; i < n; i++) {
        if (a[i] > 0) continue;
        diag_error(b->diags, n == 1 ? node : node->item[i], AT_VALUE, "E-range", "%s: sizes must be positive", what);
        return 1;
    }
    return 0;
}

static int rectangle(struct builder *b, struct flex_section *s, const struct draft *o, const struct node *n,
                     const char *what)
{
    double a[2], nu = nu_of(o);
    if (sizes(b, a, 2, n, what)) return 1;
    bool plane = b->scene->space == 2;
    section_rectangle(s, plane ? a[1] : a[0], plane ? a[0] : a[1], nu);
    return 0;
}

/* Between the radii a[0] and a[1], which may be 0. */
static int annulus(struct builder *b, struct flex_section *s, const struct draft *o, const double *a,
                   const struct node *n, const char *what)
{
    if (!(a[1] < a[0])) {
        diag_error(b->diags, n, AT_VALUE, "E-range", "%s: the inner radius is not smaller than the outer", what);
        return 1;
    }
    section_round(s, a[0], a[1], nu_of(o));
    return 0;
}

/* Any section by its numbers. */
static int general(struct builder *b, struct flex_section *s, const struct draft *o, const struct section_keys *k,
                   const struct node *n, const char *what)
{
    const struct {
        const char *name;
        double x;
        bool spatial, shear;
    } needed[] = {{"area", k->area, false, false}, {"Iz", k->Iz, false, false}, {"Iy", k->Iy, true, false},
                  {"J", k->J, true, false},        {"ky", k->ky, false, true},  {"kz", k->kz, true, true}};
    for (int i = 0; i < 6; i++) {
        if (!isnan(needed[i].x) || (needed[i].spatial && b->scene->space == 2)) continue;
        if (needed[i].shear && !o->shear) continue;
        diag_error(b->diags, n, AT_VALUE, "E-section", "%s: its section has no '%s'", what, needed[i].name);
        diag_hint(b->diags, "give a rectangle, a circle, a tube, or all of %s%s",
                  b->scene->space == 2 ? "area, Iz" : "area, Iy, Iz, J", o->shear ? ", and shear factors" : "");
        return 1;
    }
    s->A = k->area;
    s->Iz = k->Iz;
    s->Iy = isnan(k->Iy) ? 0 : k->Iy;
    s->J = isnan(k->J) ? 0 : k->J;
    return 0;
}

static int read_shape(struct builder *b, struct flex_section *s, struct draft *o, const struct section_keys *k,
                      const struct node *n, const char *what)
{
    double a[2] = {0, 0};
    bool numbers = !isnan(k->area) || !isnan(k->Iy) || !isnan(k->Iz) || !isnan(k->J);
    if (!!k->rectangle + !!k->tube + !!k->circle + numbers > 1) {
        diag_error(b->diags, n, AT_VALUE, "E-two-kinds", "%s: expected one of rectangle, circle, tube, or numbers",
                   what);
        return 1;
    }
    if (k->rectangle) return rectangle(b, s, o, k->rectangle, what);
    if (!k->circle && !k->tube) return general(b, s, o, k, n, what);
    o->round = true;
    if (sizes(b, a, k->tube ? 2 : 1, k->tube ? k->tube : k->circle, what)) return 1;
    return annulus(b, s, o, a, n, what);
}

/* Bending about z shears along y, and about y along z. */
static void note_stout(struct draft *o, const struct flex_section *s, bool spatial)
{
    const double I[2] = {s->Iz, spatial ? s->Iy : 0}, kappa[2] = {s->ky, s->kz};
    const int soft = spatial && I[1] < I[0];
    for (int i = 0; i < 2; i++) {
        const double r = I[i] / (s->A * o->length * o->length), sheared = o->beam.E / (kappa[i] * o->beam.G) * r;
        if (isfinite(r)) o->stout[0] = fmax(o->stout[0], r);
        if (isfinite(sheared)) o->stout[1] = fmax(o->stout[1], sheared);
        if (i == soft && isfinite(sheared)) o->sheared = fmax(o->sheared, sheared);
    }
}

static int read_section(struct builder *b, struct flex_section *s, struct draft *o, const struct node *n,
                        const struct key *keys, const char *what)
{
    struct section_keys k = {.area = NAN, .Iy = NAN, .Iz = NAN, .J = NAN, .ky = NAN, .kz = NAN};
    *s = (struct flex_section){.rotary = o->rotary};
    if (read_keys(&k, keys, n, NULL, what, &b->reader)) return 1;
    if (read_shape(b, s, o, &k, n, what)) return 1;
    s->station = k.station;
    s->twist = k.twist;
    if (!isnan(k.ky)) s->ky = k.ky;
    if (!isnan(k.kz)) s->kz = k.kz;
    note_stout(o, s, b->scene->space == 3);
    if (!o->shear) s->ky = s->kz = 0;
    if (k.y > 0) s->y = k.y;
    if (k.z > 0) s->z = k.z;
    return 0;
}

/* From 0 to 1, ascending; between the ends two may stand at one station, which makes a step. */
static int check_stations(struct builder *b, const struct flex_section *s, const struct node *list, const char *what)
{
    for (int i = 1; i < list->count; i++) {
        const bool inside = i > 1 && i + 1 < list->count;
        if (s[i].station > s[i - 1].station) continue;
        if (inside && s[i].station == s[i - 1].station && s[i].station > s[i - 2].station) continue;
        diag_error(b->diags, list->item[i], AT_VALUE, "E-section", "%s: station %g does not come after %g", what,
                   s[i].station, s[i - 1].station);
        return 1;
    }
    if (list->count > 1 && s[0].station == 0 && s[list->count - 1].station == 1) return 0;
    diag_error(b->diags, list, AT_VALUE, "E-section", "%s: 'sections' go from station 0 to station 1", what);
    return 1;
}

bool gives_shear(const struct node *n)
{
    if (n->type == NODE_MAP) return node_find(n, "ky") || node_find(n, "kz");
    for (int i = 0; n->type == NODE_LIST && i < n->count; i++)
        if (n->item[i]->type == NODE_MAP && gives_shear(n->item[i])) return true;
    return false;
}

static bool knows_factors(const struct node *n)
{
    if (n->type == NODE_MAP)
        return gives_shear(n) || node_find(n, "rectangle") || node_find(n, "circle") || node_find(n, "tube");
    bool all = n->type == NODE_LIST;
    for (int i = 0; all && i < n->count; i++) all = n->item[i]->type == NODE_MAP && knows_factors(n->item[i]);
    return all;
}

bool knows_shear(const struct node *section, const struct node *material)
{
    return section && material && knows_factors(section) &&
           (material->type == NODE_SCALAR || node_find(material, "nu") || node_find(material, "G"));
}

int read_sections(struct builder *b, struct draft *o, const struct beam_body_keys *k, const struct node *n,
                  const char *what)
{
    if (!k->section == !k->sections) {
        diag_error(b->diags, n, AT_KEY, k->section ? "E-two-kinds" : "E-missing-key",
                   "%s: expected 'section' or 'sections'", what);
        return 1;
    }
    const struct node *list = k->sections;
    if (list && read_list(list, "'sections'", &b->reader)) return 1;
    struct flex_section *s = TAKE(b->life, struct flex_section, list ? list->count : 1);
    o->beam.section = s;
    o->beam.nsection = list ? list->count : 1;
    if (!list) return read_section(b, s, o, k->section, keys_section, what);
    int errors = 0;
    for (int i = 0; i < list->count; i++) errors += read_section(b, &s[i], o, list->item[i], keys_sections, what);
    return errors ? errors : check_stations(b, s, list, what);
}
