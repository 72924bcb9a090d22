/* split_order.c -- in which order the loops of a component stand in C_qd, so that its band is narrow.
 *
 * Neighbours are loops that share a coordinate.  Breadth first from a loop at an end (Cuthill & McKee, Proc. 24th Nat.
 * Conf. ACM (1969) 157; the end as George & Liu, ACM Trans. Math. Softw. 5 (1979) 284), unless the deck's own order is
 * as good. */
#include <string.h>

#include "loop/split.h"

/* Loops of one component by coordinate and back, numbered as they come. */
struct web {
    int nloop, nk;
    int *loop;             /* [nloop] of the model */
    int *from, *k;         /* coordinates of loop i: k[from[i]] ... */
    int *loops_from, *of;  /* loops of coordinate j: of[loops_from[j]] ... */
    int *queue, *distance; /* [nloop] of the last search */
    bool *seen;            /* [nk] */
};

static void list_coordinates(struct web *w, const struct rows *o, const struct component *c, struct arena *a)
{
    const struct loops *l = o->loops;
    int entries = 0;
    w->loop = TAKE(a, int, c->nrow);
    for (int r = 0; r < c->nrow; r++) {
        const int loop = l->row[c->row[r]].loop;
        if (w->nloop && w->loop[w->nloop - 1] == loop) continue;
        w->loop[w->nloop++] = loop;
        entries += l->nk[loop];
    }
    w->from = TAKE(a, int, w->nloop + 1);
    w->k = TAKE(a, int, entries);
    for (int i = 0; i < w->nloop; i++) {
        const int loop = w->loop[i];
        w->from[i + 1] = w->from[i] + l->nk[loop];
        for (int k = 0; k < l->nk[loop]; k++) w->k[w->from[i] + k] = o->column[l->k[loop][k]];
    }
}

static void list_loops(struct web *w, struct arena *a)
{
    int *next = TAKE(a, int, w->nk);
    w->loops_from = TAKE(a, int, w->nk + 1);
    w->of = TAKE(a, int, w->from[w->nloop]);
    for (int e = 0; e < w->from[w->nloop]; e++) w->loops_from[w->k[e] + 1]++;
    for (int j = 0; j < w->nk; j++) {
        next[j] = w->loops_from[j];
        w->loops_from[j + 1] += w->loops_from[j];
    }
    for (int i = 0; i < w->nloop; i++)
        for (int e = w->from[i]; e < w->from[i + 1]; e++) w->of[next[w->k[e]]++] = i;
}

/* All loops, the nearest to `first` first; returns one of the farthest. */
static int search(struct web *w, int first)
{
    int tail = 0;
    memset(w->seen, 0, sizeof *w->seen * (size_t)w->nk);
    for (int i = 0; i < w->nloop; i++) w->distance[i] = -1;
    w->queue[tail++] = first;
    w->distance[first] = 0;
    for (int head = 0; head < tail; head++) {
        const int i = w->queue[head];
        for (int e = w->from[i]; e < w->from[i + 1]; e++) {
            const int j = w->k[e];
            if (w->seen[j]) continue;
            w->seen[j] = true;
            for (int f = w->loops_from[j]; f < w->loops_from[j + 1]; f++) {
                const int to = w->of[f];
                if (w->distance[to] >= 0) continue;
                w->distance[to] = w->distance[i] + 1;
                w->queue[tail++] = to;
            }
        }
    }
    return w->queue[tail - 1];
}

/* The farthest that two loops with a coordinate in common are apart. */
static int spread(const struct web *w, const int *place)
{
    int most = 0;
    for (int j = 0; j < w->nk; j++) {
        int first = w->nloop, last = 0;
        for (int f = w->loops_from[j]; f < w->loops_from[j + 1]; f++) {
            const int at = place[w->of[f]];
            if (at < first) first = at;
            if (at > last) last = at;
        }
        if (last - first > most) most = last - first;
    }
    return most;
}

/* place [nloop] */
static void find_places(struct web *w, int *place, int *other)
{
    int end = 0;
    for (int i = 0; i < w->nloop; i++) place[i] = i;
    for (int pass = 0; pass < 3; pass++) end = search(w, end);
    search(w, end);
    for (int i = 0; i < w->nloop; i++) other[w->queue[i]] = i;
    if (spread(w, other) < spread(w, place)) memcpy(place, other, sizeof *place * (size_t)w->nloop);
}

void split_order(struct split *o, struct part *p)
{
    enum { MOST_ROWS = 6 };
    const struct arena_mark mark = arena_mark(o->scratch);
    const struct component *c = p->of;
    if (c->nrow == 0) return; /* of joints that hold nothing */
    const struct loops *l = o->rows->loops;
    struct web w = {.nk = c->nk};
    list_coordinates(&w, o->rows, c, o->scratch);
    list_loops(&w, o->scratch);
    w.queue = TAKE(o->scratch, int, w.nloop);
    w.distance = TAKE(o->scratch, int, w.nloop);
    w.seen = TAKE(o->scratch, bool, w.nk);
    int *place = TAKE(o->scratch, int, w.nloop), *other = TAKE(o->scratch, int, w.nloop);
    find_places(&w, place, other);
    for (int j = 0; j < c->nk; j++) {
        p->loop_of[j] = w.nloop;
        for (int f = w.loops_from[j]; f < w.loops_from[j + 1]; f++)
            if (place[w.of[f]] < p->loop_of[j]) p->loop_of[j] = place[w.of[f]];
    }
    for (int r = 0, i = 0; r < c->nrow; r++) {
        const int loop = l->row[c->row[r]].loop;
        if (loop != w.loop[i]) i++;
        p->row_order[r] = MOST_ROWS * place[i] + c->row[r] - l->first[loop];
    }
    arena_rewind(o->scratch, mark);
}
