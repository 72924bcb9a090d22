/* parameters.c -- the parameters: of a deck, in whatever order they are given.
 *
 * A parameter that meets one without a value waits for it on a stack of our own; who meets one that waits already has
 * found a circle. */
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "deck/stages.h"

bool variable_name(const char *name, const struct node *n, const char *code, struct diags *diags)
{
    const char *why = NULL;
    if (!text_is_name(name)) why = "a name is letters, digits and '_', with a letter first";
    if (expr_is_word(name)) why = "it has a meaning in expressions";
    if (!strcmp(name, "t")) why = "it is the time";
    if (!why) return true;
    diag_error(diags, n, AT_KEY, code, "'%s' cannot be a parameter: %s", diag_clip(diags, name), why);
    diag_foreign(diags, name);
    return false;
}

static int by_name(const void *a, const void *b)
{
    return strcmp(((const struct parameter *)a)->name, ((const struct parameter *)b)->name);
}

static void collect(struct deck *deck, struct node *map)
{
    deck->parameter = TAKE(deck->arena, struct parameter, map->count);
    for (int i = 0; i < map->count; i++)
        if (variable_name(map->item[i]->key, map->item[i], "E-parameter", deck->diags))
            deck->parameter[deck->nparameter++] = (struct parameter){.name = map->item[i]->key, .node = map->item[i]};
    qsort(deck->parameter, (size_t)deck->nparameter, sizeof *deck->parameter, by_name);
    deck->parameter_name = TAKE(deck->arena, const char *, deck->nparameter);
    for (int i = 0; i < deck->nparameter; i++) deck->parameter_name[i] = deck->parameter[i].name;
}

/* stack[from..n) wait for each other. */
static void report_circle(struct deck *deck, const int *stack, int from, int n)
{
    const struct parameter *p = deck->parameter;
    char *chain = arena_print(deck->arena, "%s", p[stack[from]].name);
    for (int i = from + 1; i < n && strlen(chain) < 200; i++)
        chain = arena_print(deck->arena, "%s -> %s", chain, p[stack[i]].name);
    diag_error(deck->diags, p[stack[n - 1]].node, AT_VALUE, "E-cycle", "parameters in a circle: %s -> %s", chain,
               p[stack[from]].name);
    for (int i = from + 1; i < n; i++) diag_note(deck->diags, p[stack[i - 1]].node, AT_VALUE, "by way of this");
}

static void settle(struct deck *deck, struct parameter *p, enum evaluated how)
{
    bool known = how == EVALUATED && deck_number(&p->value, p->node, deck) == OK; /* keeps it for print, warns */
    p->state = known ? KNOWN : BROKEN;
}

/* Evaluates parameter i and all it needs; stack [nparameter]. */
static void resolve(struct deck *deck, int i, int *stack)
{
    int n = 0;
    stack[n++] = i;
    while (n > 0) {
        struct parameter *p = &deck->parameter[stack[n - 1]];
        struct lookup lookup = {.deck = deck};
        p->state = BUSY;
        enum evaluated how = evaluate(&p->value, p->node, &lookup);
        if (how != PENDING) {
            settle(deck, p, how);
            n--;
        } else if (deck->parameter[lookup.pending].state == WAITING) {
            stack[n++] = lookup.pending;
        } else {
            int from = n - 1;
            while (stack[from] != lookup.pending) from--;
            report_circle(deck, stack, from, n);
            for (; n > from; n--) deck->parameter[stack[n - 1]].state = BROKEN;
        }
    }
}

static bool is_name_part(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.';
}

/* Does a text below n hold the name as a word? */
static bool mentions(const struct node *n, const char *name)
{
    const size_t len = strlen(name);
    const char *text = n->type == NODE_SCALAR ? n->text : "";
    for (const char *p = text; (p = strstr(p, name)); p += len)
        if ((p == text || !is_name_part(p[-1])) && !is_name_part(p[len])) return true;
    for (int i = 0; i < n->count; i++)
        if (mentions(n->item[i], name)) return true;
    return false;
}

static bool was_used(const struct deck *deck, const char *name)
{
    for (const struct replaced *r = deck->replaced; r; r = r->before)
        if (mentions(&r->node, name)) return true;
    return false;
}

void deck_warn_unused(struct deck *deck)
{
    for (int i = 0; i < deck->nparameter; i++) {
        const struct parameter *p = &deck->parameter[i];
        if (p->used || (p->node->file != deck->root->file && !deck_was_set(deck, p->node))) continue;
        if (was_used(deck, p->name)) continue;
        diag_warn(deck->diags, p->node, AT_KEY, "W-unused", "parameter '%s' is used nowhere", p->name);
        const char *near = diag_nearest(p->name, deck->parameter_name, i);
        if (!near) near = diag_nearest(p->name, deck->parameter_name + i + 1, deck->nparameter - i - 1);
        if (near) diag_hint(deck->diags, "did you mean '%s'?", near);
    }
}

void parameters_evaluate(struct deck *deck)
{
    struct node *map = node_find(deck->root, "parameters");
    if (!map || map->reported || node_is_null(map)) return;
    if (map->type != NODE_MAP) {
        diag_error(deck->diags, map, AT_VALUE, "E-type", "parameters: expected a map, found %s", node_type_name(map));
        map->reported = true;
        return;
    }
    collect(deck, map);
    int *stack = TAKE(deck->arena, int, deck->nparameter);
    for (int i = 0; i < deck->nparameter; i++)
        if (deck->parameter[i].state == WAITING) resolve(deck, i, stack);
}
