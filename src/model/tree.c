/* tree.c -- the spanning tree: from the ground outwards, breadth first, joints in the deck's order.
 *
 * Where joints close loops, those whose coordinates the deck names, and fixed ones, come first, and those it marks
 * `loop: true` last; the joints that are left over become equations (2-2), as do ties, which never are in the tree.
 * Where their loops are many and long, the tree is grown again along joints that leave short ones (short.c).
 *
 * A joint met from its second body is turned round: with axes z -> -z, y -> -y its coordinate is still that
 * of the deck's second body against its first; a universal joint's two axes change places and sign.
 * Spherical, planar and free joints cannot be turned so: their coordinates are of the body farther from
 * the ground against the nearer one. */
#include <string.h>

#include "la/rot.h"
#include "la/vec3.h"
#include "model/parts.h"

static bool is_crossed(const struct joint_kind *kind)
{
    return joint_turning(kind, NULL) == TURNS_CROSSED;
}

static void turn_round(double *E, const double *E0, const struct joint_kind *kind)
{
    memcpy(E, E0, 9 * sizeof *E);
    if (is_crossed(kind)) {
        v3_scale(E, -1, E0 + 3);
        v3_scale(E + 3, -1, E0);
        v3_scale(E + 6, -1, E0 + 6);
    } else if (joint_has_one_axis(kind)) {
        v3_scale(E + 3, -1, E0 + 3);
        v3_scale(E + 6, -1, E0 + 6);
    }
}

/* Hangs body `child` of the scene on `parent` by a joint with axes E (world, drawn) at the world point at. */
static struct model_joint *hang(struct making *o, int parent, int child, enum joint_type type, const double *at,
                                const double *E)
{
    struct model *m = o->m;
    const struct scene_body *cb = &o->scene->body[child];
    double a[3], arm[3];
    int on = place_on(a, o, parent, at);
    int i = m->nbody++;
    struct model_joint *j = &o->joint[m->njoint];
    struct model_body *body = &o->body[i];
    o->body_of[child] = i;
    *body =
        (struct model_body){.name = cb->name, .mass = cb->mass, .parent = on, .joint = m->njoint++, .component = -1};
    memcpy(body->inertia, cb->inertia, sizeof cb->inertia);
    if (!cb->flex) body->held = TAKE(o->life, double, 6);
    v3_copy(body->at, cb->at);
    memcpy(body->R, cb->R, sizeof cb->R);
    if (cb->flex) make_flexible_body(o, i, cb, at);
    *j = (struct model_joint){.type = type, .parent = on, .child = i};
    j->nq = joint_size(model_kind(m, type), 0);
    j->nv = joint_size(model_kind(m, type), 1);
    v3_copy(j->a, a);
    v3_diff(arm, at, body->at);
    m3_tmul(j->b, cb->R, arm);
    m3_tmulm(j->Ea, o->body[on].R, E);
    m3_tmulm(j->Eb, cb->R, E);
    return j;
}

/* Axes of the reactions of a joint whose deck wants its own; in the plane x along the axis of a prismatic joint or
 * a line. */
static const double *own_axes(const struct making *o, const struct scene_joint *j)
{
    double E[9];
    if (!j->own) return NULL;
    memcpy(E, j->E, sizeof E);
    if (o->scene->space == 2) {
        v3_copy(E, joint_slide(j->kind, 2) ? j->E + 6 : j->E);
        v3_set(E + 6, 0, 0, 1);
        v3_cross(E + 3, E + 6, E);
    }
    double *own = TAKE(o->life, double, 9);
    m3_tmulm(own, o->scene->body[j->first].R, E);
    return own;
}

static void hang_by(struct making *o, int index, int parent, int child)
{
    const struct scene_joint *sj = &o->scene->joint[index];
    double E[9];
    bool reversed = child == sj->first;
    if (reversed)
        turn_round(E, sj->E, sj->kind);
    else
        memcpy(E, sj->E, sizeof E);
    struct model_joint *j = hang(o, parent, child, sj->kind->type, sj->at, E);
    j->name = sj->name;
    j->number = sj->number;
    j->reversed = reversed;
    j->exchanged = reversed && is_crossed(sj->kind);
    j->own = own_axes(o, sj);
    o->joint_of[index] = j->child - 1;
    o->scene_joint[j->child - 1] = index;
}

/* Does a rod or a line hold the body? */
static bool is_tied(const struct scene *scene, int body)
{
    for (int i = 0; i < scene->njoint; i++) {
        const struct scene_joint *j = &scene->joint[i];
        if (joint_is_tie(j->kind) && j->nterm == 0 && (j->first == body || j->second == body)) return true;
    }
    return false;
}

static void hang_free(struct making *o, int body)
{
    static const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const struct scene_body *sb = &o->scene->body[body];
    if (!is_tied(o->scene, body) && !sb->touches)
        diag_warn(o->diags, sb->node, AT_KEY, "W-unconnected", "body '%s' hangs on no joint: it moves freely",
                  sb->name);
    struct model_joint *j = hang(o, 0, body, JOINT_FREE, sb->at, identity);
    j->name = arena_print(o->life, "%s_free", sb->name);
    o->scene_joint[j->child - 1] = -1;
}

static struct threads thread_joints(struct making *o)
{
    const struct scene *scene = o->scene;
    struct threads t = {TAKE(o->life, int, scene->nbody), TAKE(o->life, int, 2 * scene->njoint)};
    for (int i = 0; i < scene->nbody; i++) t.first[i] = -1;
    for (int j = scene->njoint - 1; j >= 0; j--) {
        if (joint_is_tie(scene->joint[j].kind)) continue;
        const int ends[2] = {scene->joint[j].first, scene->joint[j].second};
        for (int side = 0; side < 2; side++) {
            t.next[2 * j + side] = t.first[ends[side]];
            t.first[ends[side]] = 2 * j + side;
        }
    }
    return t;
}

/* Does the output ask for one of its coordinates by name? */
static bool is_printed(const struct output *out, int joint)
{
    for (int i = 0; i < out->ncolumn; i++)
        if (out->column[i].joint == joint) return true;
    return false;
}

static int wish(const struct making *o, int joint)
{
    const struct scene *s = o->scene;
    for (int i = 0; i < s->nfast; i++)
        if (s->fast[i].joint == joint) return WANTED;
    for (int i = 0; i < s->nindependent; i++)
        if (s->independent[i].joint == joint) return WANTED;
    for (int i = 0; i < s->ninitial; i++)
        if (s->initial[i].joint == joint) return WANTED;
    for (int i = 0; i < s->nmeasure; i++)
        if (s->measure[i].type == MEASURE_COORDINATE && s->measure[i].joint == joint) return WANTED;
    for (int i = 0; i < s->njoint; i++)
        for (int k = 0; k < s->joint[i].nterm; k++)
            if (s->joint[i].term[k].joint == joint) return WANTED;
    for (int i = 0; i < s->nforce; i++)
        for (int k = 0; k < s->force[i].nslot; k++) {
            const struct scene_slot *slot = &s->force[i].slot[k];
            bool coordinate = slot->type == SCENE_COORDINATE || slot->type == SCENE_RATE;
            if (coordinate && slot->index == joint) return WANTED;
        }
    if (s->joint[joint].loop) return AVOIDED;
    if (joint_is_fixed(s->joint[joint].kind)) return WANTED;
    return is_printed(&s->output, joint) ? LIKED : PLAIN;
}

/* The bodies met so far, in the order they are to be looked at. */
struct search {
    struct threads threads;
    int *wish; /* [njoint]; all PLAIN while the joints make a tree: then the order is the deck's */
    int *queue, tail;
    int liked; /* bodies of the queue whose liked joints have been followed */
};

static void reach_liked(struct making *o, struct search *s);

/* Hangs on `body` what joins it by joints of one level.  Whole chains of wanted joints follow at once, then those of
 * liked ones, so that none of these is met by another way first. */
static void reach(struct making *o, struct search *s, int body, int level)
{
    const struct scene *scene = o->scene;
    for (int e = s->threads.first[body]; e >= 0; e = s->threads.next[e]) {
        int other = e & 1 ? scene->joint[e / 2].first : scene->joint[e / 2].second;
        if (s->wish[e / 2] != level || o->body_of[other] >= 0) continue;
        hang_by(o, e / 2, body, other);
        s->queue[s->tail++] = other;
        reach(o, s, other, WANTED);
        if (level == PLAIN) reach_liked(o, s);
    }
}

static void reach_liked(struct making *o, struct search *s)
{
    for (; s->liked < s->tail; s->liked++) reach(o, s, s->queue[s->liked], LIKED);
}

static void reach_from(struct making *o, struct search *s, int body)
{
    s->tail = s->liked = 0;
    s->queue[s->tail++] = body;
    reach(o, s, body, WANTED);
    reach_liked(o, s);
    for (int head = 0; head < s->tail; head++) reach(o, s, s->queue[head], PLAIN);
}

static int root(int *above, int i)
{
    while (above[i] != i) i = above[i] = above[above[i]];
    return i;
}

/* Do the joints close loops?  Unites bodies joint by joint. */
static bool closes_loops(const struct making *o)
{
    const struct scene *scene = o->scene;
    int *above = TAKE(o->life, int, scene->nbody);
    for (int i = 0; i < scene->nbody; i++) above[i] = i;
    for (int i = 0; i < scene->njoint; i++) {
        if (joint_is_tie(scene->joint[i].kind)) continue;
        int a = root(above, scene->joint[i].first), b = root(above, scene->joint[i].second);
        if (a == b) return true;
        above[a] = b;
    }
    return false;
}

/* Avoided joints come in only where nothing else joins their bodies to the ground. */
static void grow(struct making *o, struct search *s)
{
    reach_from(o, s, 0);
    for (bool more = true; more;) {
        more = false;
        for (int i = 0; i < o->scene->njoint; i++) {
            const struct scene_joint *j = &o->scene->joint[i];
            if (joint_is_tie(j->kind)) continue;
            bool first = o->body_of[j->first] >= 0, second = o->body_of[j->second] >= 0;
            if (first == second) continue;
            int from = first ? j->first : j->second, to = first ? j->second : j->first;
            hang_by(o, i, from, to);
            reach_from(o, s, to);
            more = true;
        }
    }
}

/* The tree of a state that the run starts from: which joints have coordinates, and their order, may have come from what
 * the deck no longer says.  Names that do not fit are passed over. */
static void grow_as_told(struct making *o, const char *tree)
{
    enum { FREE = 5 }; /* "_free", of a body without a joint */
    const struct scene *scene = o->scene;
    for (size_t len; *tree; tree += len + strspn(tree + len, " ")) {
        len = strcspn(tree, " ");
        const int i = scene_find_joint(scene, tree, len);
        if (i < 0 && len > FREE) {
            const int island = scene_find_body(scene, tree, len - FREE);
            if (island > 0 && o->body_of[island] < 0 && strncmp(tree + len - FREE, "_free", FREE) == 0)
                hang_free(o, island);
        }
        if (i < 0 || joint_is_tie(scene->joint[i].kind)) continue;
        const int first = scene->joint[i].first, second = scene->joint[i].second;
        if (o->body_of[first] >= 0 && o->body_of[second] < 0) hang_by(o, i, first, second);
        if (o->body_of[second] >= 0 && o->body_of[first] < 0) hang_by(o, i, second, first);
    }
}

/* Nothing hangs on the ground any more. */
static void fell(struct making *o)
{
    for (int i = 1; i < o->scene->nbody; i++) o->body_of[i] = -1;
    for (int i = 0; i < o->scene->njoint; i++) o->joint_of[i] = -1;
    o->m->nbody = 1;
    o->m->njoint = 0;
}

/* Gears and racks; a joint that is not in the tree has no coordinate to tie, and is reported elsewhere. */
static void add_terms(struct making *o, struct model_loop *l, const struct scene_joint *sj)
{
    l->nterm = sj->nterm;
    for (int i = 0; i < sj->nterm; i++) {
        const struct scene_term *t = &sj->term[i];
        int joint = o->joint_of[t->joint];
        if (joint < 0) continue;
        l->term[i] = (struct model_term){joint, model_rate(&o->joint[joint], t->k), t->angular, t->factor};
    }
    l->first = o->joint[l->term[0].joint].child;
    l->second = o->joint[l->term[sj->nterm - 1].joint].child;
}

static void add_loop(struct making *o, int index)
{
    const struct scene_joint *sj = &o->scene->joint[index];
    struct model_loop *l = &o->loop[o->m->nloop];
    *l = (struct model_loop){.name = sj->name, .type = sj->kind->type};
    o->loop_of[index] = o->m->nloop++;
    l->number = sj->number;
    if (sj->nterm) {
        add_terms(o, l, sj);
        return;
    }
    l->first = place_on(l->a, o, sj->first, sj->from);
    l->second = place_on(l->b, o, sj->second, sj->at);
    m3_tmulm(l->Ea, o->body[l->first].R, sj->E);
    m3_tmulm(l->Eb, o->body[l->second].R, sj->E);
    l->own = own_axes(o, sj);
}

/* Between the bodies of its measure. */
static void add_drive(struct making *o, const struct scene_drive *d)
{
    const struct scene_measure *s = &o->scene->measure[d->measure];
    struct model_loop *l = &o->loop[o->m->nloop++];
    *l = (struct model_loop){.name = d->name, .drive = &d->value, .measure = d->measure};
    if (s->type == MEASURE_COORDINATE) {
        const struct model_joint *j = &o->joint[o->joint_of[s->joint]];
        l->first = j->parent;
        l->second = j->child;
    } else {
        double p[3];
        l->first = marker_on(p, o, &s->a);
        l->second = marker_on(p, o, &s->b);
    }
    o->m->ndrive++;
}

static enum status add_loops(struct making *o)
{
    enum status status = OK;
    o->loop = TAKE(o->life, struct model_loop, o->scene->njoint + o->scene->ndrive);
    for (int i = 0; i < o->scene->njoint; i++) {
        const struct scene_joint *j = &o->scene->joint[i];
        if (o->joint_of[i] >= 0) continue;
        add_loop(o, i);
        if (joint_is_fixed(j->kind) || wish(o, i) != WANTED) continue;
        diag_error(o->diags, j->node, AT_KEY, "E-loop", "constraint '%s' closes a loop: it has no coordinates",
                   j->name);
        diag_hint(o->diags, "other joints of this loop are asked for too; put a measure in place of one of them");
        status = E_DECK;
    }
    for (int i = 0; status == OK && i < o->scene->ndrive; i++) add_drive(o, &o->scene->drive[i]);
    return status;
}

enum status make_tree(struct making *o)
{
    const struct scene *scene = o->scene;
    int n = scene->nbody, capacity = n + most_nodes(scene);
    o->body = TAKE(o->life, struct model_body, capacity);
    o->joint = TAKE(o->life, struct model_joint, capacity);
    o->body_of = TAKE(o->life, int, n);
    o->joint_of = TAKE(o->life, int, scene->njoint);
    o->loop_of = TAKE(o->life, int, scene->njoint);
    o->scene_joint = TAKE(o->life, int, capacity);
    for (int i = 1; i < n; i++) o->body_of[i] = -1;
    for (int i = 0; i < scene->njoint; i++) o->joint_of[i] = o->loop_of[i] = -1;
    o->body[0] = (struct model_body){.name = "ground", .parent = -1, .joint = -1, .component = -1};
    m3_unit(o->body[0].R);
    o->m->nbody = 1;
    struct search s = {thread_joints(o), TAKE(o->life, int, scene->njoint), TAKE(o->life, int, n), 0, 0};
    if (closes_loops(o))
        for (int i = 0; i < scene->njoint; i++) s.wish[i] = wish(o, i);
    if (scene->tree) grow_as_told(o, scene->tree);
    grow(o, &s);
    if (!scene->tree && make_short(o, &s.threads, s.wish)) {
        fell(o);
        grow(o, &s);
    }
    for (int i = 1; i < n; i++) { /* an island: free, with what hangs on it */
        if (o->body_of[i] >= 0) continue;
        hang_free(o, i);
        reach_from(o, &s, i);
        grow(o, &s);
    }
    TRY(add_loops(o));
    make_nodes(o);
    return OK;
}
