/* condense_turns.c -- whole turns of screws that close loops, at the start.
 *
 * A posture tells the turn of a thread up to whole turns.  In motion the nearest thread is the one it is on; what
 * `initial:` says may be any number of turns from the drawn position, and is followed from there. */
#include <math.h>
#include <string.h>

#include "loop/condense_parts.h"

void condense_count_turns(struct condense *o, const double *q)
{
    static const double SMALL = 1; /* of a way, in scales: no screw turns by more than half a turn */
    enum { MOST = 100000 };
    struct loops *l = o->rows.loops;
    double most = 0;
    if (!loops_have_screws(l)) return;
    memset(o->side[0], 0, sizeof *o->q * (size_t)o->model->nq);
    for (int i = 0; i < o->tree->moves.nturn; i++) o->side[0][o->tree->moves.turn[i].iq[0]] = 1;
    moves_diff(&o->tree->moves, o->dx, q, o->side[0]);
    for (int i = 0; i < o->rows.n; i++) most = fmax(most, fabs(o->dx[i]) * o->rows.per[i]);
    const int steps = (int)fmin(MOST, ceil(most / SMALL) + 1);
    for (int k = 0; k <= steps; k++) {
        moves_point(&o->tree->moves, o->side[1], o->side[0], o->dx, (double)k / steps);
        rows_place(&o->rows, o->side[1]);
        loops_count_turns(l, k ? COUNT_ON : COUNT_ANEW);
    }
}

/* Has the deck, or the state that it begins from, given all positions?  Then they tell the turns. */
static bool all_given(const struct model *m)
{
    for (int i = 0; i < m->ncoordinate; i++)
        if (m->coordinate[i].iv >= 0 && !(m->given_q && m->given_q[i])) return false;
    return true;
}

bool condense_closed(struct condense *o, const double *q0)
{
    static const double HOLDS = 1e-9; /* |C| of a whole state */
    int row;
    if (!all_given(o->model)) condense_count_turns(o, q0);
    const double miss = rows_misfit(o->C, &row, &o->rows, q0);
    loops_count_turns(o->rows.loops, COUNT_NEVER);
    return miss <= HOLDS;
}
