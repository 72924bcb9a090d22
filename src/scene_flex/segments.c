/* segments.c -- a beam cut into several flexible bodies, each with a frame of its own: for bending so large that one
 * frame cannot follow it.  Fixed joints hold them together; sections, masses and places of stresses go to the part
 * that holds their station. */
#include <math.h>
#include <string.h>

#include "la/vec3.h"
#include "scene_flex/flexible.h"

enum { MOST_SEGMENTS = 100 };

/* Does the part own this station of the whole?  Where two meet it is the first's. */
static bool owns(const struct draft *o, double station)
{
    return station <= o->to && (station > o->from || o->from == 0);
}

double station_in(const struct draft *o, double station)
{
    return (station - o->from) / (o->to - o->from);
}

bool holds_point(const struct builder *b, int body, const struct node *n)
{
    const struct draft *o = b->draft[body];
    double station;
    if (!o || !b->scene->body[body].whole) return true;
    const struct node *at = n->type == NODE_MAP ? node_find(n, "station") : NULL;
    if (!at || at->reported || deck_number(&station, at, b->reader.deck) != OK || !(station >= 0 && station <= 1))
        return o->from == 0; /* the first tells what is wrong with it */
    return owns(o, station);
}

static double between(double x, double y, double part)
{
    return x + part * (y - x);
}

/* behind: of a step there the far side, else the near one. */
static struct flex_section section_at(const struct flex_beam *beam, double station, bool behind)
{
    int i = 0;
    while (i + 2 < beam->nsection &&
           (beam->section[i + 1].station < station || (behind && beam->section[i + 1].station == station)))
        i++;
    const struct flex_section *s = &beam->section[i];
    struct flex_section o;
    section_between(&o, s, s + 1, (station - s[0].station) / (s[1].station - s[0].station));
    return o;
}

/* Sections at both ends of the part, and those between. */
static void cut_sections(struct draft *o, const struct flex_beam *whole, struct arena *life)
{
    struct flex_section *s = TAKE(life, struct flex_section, whole->nsection + 2);
    int n = 0;
    if (whole->nsection == 1) return;
    s[n++] = section_at(whole, o->from, true);
    for (int i = 0; i < whole->nsection; i++)
        if (whole->section[i].station > o->from && whole->section[i].station < o->to) s[n++] = whole->section[i];
    s[n++] = section_at(whole, o->to, false);
    for (int i = 0; i < n; i++) s[i].station = station_in(o, i == 0 ? o->from : i == n - 1 ? o->to : s[i].station);
    o->beam.section = s;
    o->beam.nsection = n;
}

static void cut_places(struct draft *o, const struct flex_beam *whole, struct arena *life)
{
    struct flex_lump *lump = TAKE(life, struct flex_lump, whole->nlump);
    struct flex_probe *probe = TAKE(life, struct flex_probe, whole->nprobe);
    o->beam.nlump = o->beam.nprobe = 0;
    for (int i = 0; i < whole->nlump; i++) {
        if (!owns(o, whole->lump[i].station)) continue;
        lump[o->beam.nlump] = whole->lump[i];
        lump[o->beam.nlump++].station = station_in(o, whole->lump[i].station);
    }
    for (int i = 0; i < whole->nprobe; i++) {
        if (!owns(o, whole->probe[i].station)) continue;
        probe[o->beam.nprobe] = whole->probe[i];
        probe[o->beam.nprobe++].station = station_in(o, whole->probe[i].station);
    }
    o->beam.lump = lump;
    o->beam.probe = probe;
}

static void cut_one(struct builder *b, int index, const struct draft *whole, const char *name, int k, int n)
{
    struct scene_body *body = &b->scene->body[index];
    struct draft *o = TAKE(b->life, struct draft, 1);
    *o = *whole;
    o->from = (double)k / n;
    o->to = k + 1 == n ? 1 : (double)(k + 1) / n;
    for (int i = 0; i < 3; i++) {
        o->beam.a[i] = between(whole->beam.a[i], whole->beam.b[i], o->from);
        o->beam.b[i] = between(whole->beam.a[i], whole->beam.b[i], o->to);
    }
    o->length = (o->to - o->from) * whole->length;
    o->beam.elements = (whole->beam.elements + n - 1) / n;
    cut_sections(o, &whole->beam, b->life);
    cut_places(o, &whole->beam, b->life);
    body->whole = name;
    body->name = arena_print(b->life, "%s%d", name, k + 1);
    b->draft[index] = o;
    weigh_beam(body, o);
}

void cut_beam(struct builder *b, int index, int n)
{
    struct scene *scene = b->scene;
    const struct draft *whole = b->draft[index];
    const struct scene_body first = scene->body[index];
    scene->nbody += n - 1;
    b->cut = true;
    for (int k = 0; k < n; k++) {
        scene->body[index + k] = first;
        cut_one(b, index + k, whole, first.name, k, n);
    }
}

/* How far a place is from the axis of a part. */
static double away(const struct draft *o, const double *place)
{
    double along[3], d[3];
    v3_diff(along, o->beam.b, o->beam.a);
    v3_diff(d, place, o->beam.a);
    const double s = fmin(1, fmax(0, v3_dot(d, along) / v3_dot(along, along)));
    v3_axpy(d, -s, along);
    return v3_norm(d);
}

const char *segment_at(const struct builder *b, const char *whole, const double *place)
{
    static const double same = 1e-9; /* of the part's length */
    const struct scene *scene = b->scene;
    const char *found = NULL;
    double least = INFINITY;
    for (int i = 1; b->cut && i < scene->nbody; i++) {
        const struct scene_body *body = &scene->body[i];
        if (!body->whole || !b->draft[i] || strcmp(body->whole, whole) != 0) continue;
        const double far = away(b->draft[i], place);
        if (far >= least - same * b->draft[i]->length) continue;
        least = far;
        found = body->name;
    }
    return found;
}

int more_segments(struct builder *b, const struct node *bodies)
{
    int more = 0;
    for (int i = 0; i < bodies->count; i++) {
        const struct node *body = bodies->item[i];
        const struct node *n = body->type == NODE_MAP ? node_find(body, "segments") : NULL;
        double x;
        if (!n || n->type != NODE_SCALAR || deck_number(&x, n, b->reader.deck) != OK) continue;
        if (x > 1 && x <= MOST_SEGMENTS) more += (int)x - 1;
    }
    return more;
}

void join_segments(struct builder *b)
{
    struct scene *scene = b->scene;
    for (int i = 1; i < scene->nbody; i++) {
        const struct draft *o = b->draft[i];
        if (!scene->body[i].whole || o->from == 0) continue;
        struct scene_joint *j = &scene->joint[scene->njoint++];
        const double *at = o->beam.a;
        *j = (struct scene_joint){.node = scene->body[i].node, .first = i - 1, .second = i};
        j->name = arena_print(b->life, "%s_%d", scene->body[i].whole, (int)lround(o->from / (o->to - o->from)));
        j->kind = joint_kind(JOINT_FIXED, scene->space == 3);
        v3_copy(j->at, at);
        v3_copy(j->from, at);
        m3_unit(j->E);
    }
}
