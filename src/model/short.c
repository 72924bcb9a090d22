/* short.c -- a spanning tree whose loops are short.
 *
 * A loop ties all coordinates between its two bodies.  In a scissor lift the tree that grows from the ground breadth
 * first runs up both strands, and every loop reaches down to the ground: as many numbers in C_q as the square of the
 * stages.  Where loops are many and so long, the joints of the tree are chosen anew: those that most short loops have
 * in common (each joint's shortest loop counts for all joints on it), by Kruskal's rule; to find the best of all trees
 * is hard (Deo, Prabhu & Krishnamoorthy, ACM Trans. Math. Softw. 8 (1982) 26).  Joints that the deck asks for stay
 * first. */
#include <string.h>

#include "model/parts.h"

enum { MANY = 8, LONG = 10 }; /* loops; joints in a loop, on average */

struct walk {
    const struct making *o;
    const struct threads *threads;
    int *from, *depth, *queue; /* [nbody] joint by which a body was met (-1: none), how far, in which order */
    const bool *in;            /* [njoint] joints that may be walked; NULL: all */
};

static bool is_tie(const struct making *o, int joint)
{
    return joint_is_tie(o->scene->joint[joint].kind);
}

static int across(const struct walk *w, int joint, int body)
{
    const struct scene_joint *j = &w->o->scene->joint[joint];
    return j->first == body ? j->second : j->first;
}

/* From a until b is met (b < 0: all), not by the joint `but`; returns how many bodies were met. */
static int walk_from(struct walk *w, int a, int b, int but)
{
    int tail = 0;
    w->queue[tail++] = a;
    w->from[a] = but;
    w->depth[a] = 0;
    for (int head = 0; head < tail && (b < 0 || w->depth[b] < 0); head++) {
        const int body = w->queue[head];
        for (int e = w->threads->first[body]; e >= 0; e = w->threads->next[e]) {
            const int joint = e / 2, other = across(w, joint, body);
            if (joint == but || (w->in && !w->in[joint]) || w->depth[other] >= 0) continue;
            w->from[other] = joint;
            w->depth[other] = w->depth[body] + 1;
            w->queue[tail++] = other;
        }
    }
    return tail;
}

static void forget(struct walk *w, int met)
{
    for (int i = 0; i < met; i++) w->depth[w->queue[i]] = -1;
}

/* Joints in all loops that the tree leaves, walked from the ground. */
static long tree_length(struct walk *w, const bool *tree, int *loops)
{
    const struct scene *scene = w->o->scene;
    long sum = 0;
    *loops = 0;
    w->in = tree;
    const int met = walk_from(w, 0, -1, -1);
    for (int i = 0; i < scene->njoint; i++) {
        int a = scene->joint[i].first, b = scene->joint[i].second;
        if (tree[i] || is_tie(w->o, i) || w->depth[a] < 0 || w->depth[b] < 0) continue;
        ++*loops;
        for (sum++; a != b; sum++) {
            int *deeper = w->depth[a] > w->depth[b] ? &a : &b;
            *deeper = across(w, w->from[*deeper], *deeper);
        }
    }
    forget(w, met);
    w->in = NULL;
    return sum;
}

/* shared[i]: how many joints' shortest loops go through joint i. */
static void count_short(struct walk *w, int *shared)
{
    const struct scene *scene = w->o->scene;
    for (int i = 0; i < scene->njoint; i++) {
        if (is_tie(w->o, i)) continue;
        const int a = scene->joint[i].first, b = scene->joint[i].second;
        const int met = walk_from(w, a, b, i);
        if (w->depth[b] > 0) {
            shared[i]++;
            for (int at = b; at != a; at = across(w, w->from[at], at)) shared[w->from[at]]++;
        }
        forget(w, met);
    }
}

static int root(int *above, int i)
{
    while (above[i] != i) i = above[i] = above[above[i]];
    return i;
}

/* Kruskal: joints by the deck's wish, then by what they share. */
static void choose_tree(const struct making *o, bool *tree, const int *wish, const int *shared)
{
    const struct scene *scene = o->scene;
    int *above = TAKE(o->life, int, scene->nbody), most = 0;
    for (int i = 0; i < scene->nbody; i++) above[i] = i;
    for (int i = 0; i < scene->njoint; i++)
        if (shared[i] > most) most = shared[i];
    for (int level = WANTED; level >= AVOIDED; level--)
        for (int share = most; share >= 0; share--)
            for (int i = 0; i < scene->njoint; i++) {
                if (wish[i] != level || shared[i] != share || is_tie(o, i)) continue;
                const int a = root(above, scene->joint[i].first), b = root(above, scene->joint[i].second);
                if (a == b) continue;
                tree[i] = true;
                above[a] = b;
            }
}

bool make_short(const struct making *o, const struct threads *threads, int *wish)
{
    const int nbody = o->scene->nbody, njoint = o->scene->njoint;
    for (int i = 0; i < nbody; i++) /* the bodies at their nodes stand already */
        if (o->scene->body[i].flex) return false;
    struct walk w = {.o = o, .threads = threads};
    int loops, *shared = TAKE(o->life, int, njoint);
    bool *now = TAKE(o->life, bool, njoint), *tree = TAKE(o->life, bool, njoint);
    w.from = TAKE(o->life, int, nbody);
    w.depth = TAKE(o->life, int, nbody);
    w.queue = TAKE(o->life, int, nbody);
    for (int i = 0; i < nbody; i++) w.depth[i] = -1;
    for (int i = 0; i < njoint; i++) now[i] = o->joint_of[i] >= 0;
    const long length = tree_length(&w, now, &loops);
    if (loops < MANY || length < (long)LONG * loops) return false;
    count_short(&w, shared);
    choose_tree(o, tree, wish, shared);
    if (2 * tree_length(&w, tree, &loops) > length) return false;
    for (int i = 0; i < njoint; i++)
        if (wish[i] == PLAIN && !tree[i]) wish[i] = AVOIDED;
    return true;
}
