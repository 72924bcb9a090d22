/* unread.c -- keys that are right, but mean nothing to the scheme that runs.
 *
 * They are reported where the scheme and they are the deck's, or the key is the command line's: a scheme that --set has put
 * in place of the deck's is there to be compared, and the deck's keys then wait for their own.
 *
 * Under `scheme: auto` they are reported where what was taken does not read them; what says what to aim at is read. */
#include <string.h>

#include "multirate/schemes.h"
#include "sim/parts.h"

static bool reads(const struct stepper_kind *kind, const char *key)
{
    if (strcmp(key, "step") == 0 || strcmp(key, "ratio") == 0 || strcmp(key, "guard") == 0)
        return !kind->adaptive; /* records fall on ratio * step; with a tolerance they are first guesses */
    return key_find(kind->keys, key) != NULL;
}

/* Does it say what every scheme does without it? */
static bool is_default(const struct integrate *p, const char *key)
{
    if (strcmp(key, "ratio") == 0) return p->ratio == 1;
    if (strcmp(key, "guard") == 0) return p->guard == GUARD_TELL;
    for (int i = 0; stepper_kinds[i]; i++) {
        const struct key *k = key_find(stepper_kinds[i]->keys, key);
        if (k) return k->flags & KEY_NEUTRAL && key_is_default(k, p->options);
    }
    return false;
}

/* Its records need a step where nothing else says when they are due. */
static bool paces_records(const struct sim *sim, const char *key)
{
    const struct output *out = &sim->scene->output;
    return sim->stepper.kind->adaptive && !(out->every > 0) && (strcmp(key, "step") == 0 || strcmp(key, "ratio") == 0);
}

bool scheme_is_compared(const struct sim *sim, const struct node *key)
{
    const struct deck *deck = sim->scene->deck;
    return deck_was_set(deck, node_find(sim->plan.node, "scheme")) && !deck_was_set(deck, key);
}

static bool has_rates(const struct stepper_kind *kind, const char *key)
{
    (void)key;
    return kind->two_rates;
}

static void warn(const struct sim *sim, const struct node *n, bool (*wanted)(const struct stepper_kind *, const char *),
                 struct diags *diags)
{
    char readers[200] = "";
    const bool starts = strcmp(n->key, "fast") == 0 && sim->model->nloop > sim->model->ndrive;
    const char *scheme = sim->plan.scheme, *chosen = sim->plan.because ? ", which 'auto' has taken" : "";
    for (int i = 0; stepper_kinds[i]; i++) {
        const size_t used = strlen(readers);
        if (wanted(stepper_kinds[i], n->key))
            snprintf(readers + used, sizeof readers - used, "%s%s", used ? ", " : "", stepper_kinds[i]->name);
    }
    diag_warn(diags, n, AT_KEY, "W-scheme", "'%.60s' means nothing to scheme %.60s%s: it is for %s%s", n->key, scheme,
              chosen, readers,
              starts ? "; in loops it still chooses what starts at 0, of what 'initial' does not set" : "");
}

static bool rubs(const struct sim *sim)
{
    for (int i = 0; i < sim->model->ncontact; i++)
        if (sim->model->contact[i].pair == PAIR_FRICTION) return true;
    return false;
}

/* Two rates, and nothing that takes the small step; coordinates to lead where nothing follows. */
static void warn_of_partition(const struct sim *sim, struct diags *diags)
{
    const struct integrate *p = &sim->plan;
    const struct node *leads = node_find(node_find(sim->scene->deck->root, "partition"), "independent");
    const struct ode2 *ode = system_ode2(sim->system);
    const bool two = sim->stepper.kind->two_rates && p->ratio > 1 && ode->n > 0;
    const double damps = ((const struct step_options *)p->options)->rho_infinity;
    if (two && ode->ns == 0)
        diag_warn(diags, node_find(p->node, "ratio"), AT_VALUE, "W-partition",
                  "no coordinate is fast: all of the deck takes steps of %g s", p->step * p->ratio);
    if (two && ode->ns == ode->n && sim->model->ndrive == 0) /* what is driven may be slow */
        diag_warn(diags, node_find(p->node, "ratio"), AT_VALUE, "W-partition",
                  "all coordinates are fast%s: the ratio saves nothing",
                  sim->model->nloop ? ", by name or by a loop with one that is" : "");
    if (two && rubs(sim))
        diag_warn(diags, node_find(p->node, "ratio"), AT_VALUE, "W-partition",
                  "joints rub, and so all coordinates take the minor step: the ratio saves nothing");
    if (sim->stepper.kind->two_rates && damps < 1 && ode->ns == 0 && ode->n > 0)
        diag_warn(diags, node_find(p->node, "rho_infinity"), AT_VALUE, "W-partition",
                  "no coordinate is fast, and %s damps what is fast: nothing is damped", p->scheme);
    if (leads && sim->model->nloop == 0)
        diag_warn(diags, leads, AT_KEY, "W-unused", "'independent' means nothing without loops or drives");
}

/* Does it say what auto is to aim at? */
static bool guides(const struct integrate *p, const char *key)
{
    const struct node *tolerance = node_find(p->node, "tolerance");
    return strcmp(key, "tolerance") == 0 || (strcmp(key, "step") == 0 && (!tolerance || tolerance->implied));
}

static void warn_of_unread_by_auto(const struct sim *sim, const struct stepper_kind *kind, struct diags *diags)
{
    const struct integrate *p = &sim->plan;
    const double tolerance = ((const struct step_options *)p->options)->tolerance;
    for (int i = 0; i < p->node->count; i++) {
        const struct node *n = p->node->item[i];
        const bool order = tolerance > 0 && strcmp(n->key, "order") == 0;
        const bool rates = strcmp(n->key, "ratio") == 0 && !kind->two_rates && strcmp(n->text, "1") != 0;
        if (n->implied || strcmp(n->key, "scheme") == 0 || strcmp(n->key, "until") == 0 || guides(p, n->key)) continue;
        if ((reads(kind, n->key) && !order && !rates) || (!rates && is_default(p, n->key))) continue;
        if (!paces_records(sim, n->key) && !scheme_is_compared(sim, n)) warn(sim, n, rates ? has_rates : reads, diags);
    }
}

void warn_of_unread(const struct sim *sim, struct diags *diags)
{
    const struct integrate *p = &sim->plan;
    const struct stepper_kind *kind = stepper_find(p->scheme);
    if (sim->options.counting || p->scheme != sim->scene->integrate.scheme || !kind) return;
    if (p->because) {
        warn_of_unread_by_auto(sim, kind, diags);
        return;
    }
    for (int i = 0; i < p->node->count; i++) {
        const struct node *n = p->node->item[i];
        if (n->implied || strcmp(n->key, "scheme") == 0 || strcmp(n->key, "until") == 0) continue;
        if (reads(kind, n->key) || is_default(p, n->key) || paces_records(sim, n->key) || scheme_is_compared(sim, n))
            continue;
        warn(sim, n, reads, diags);
    }
    warn_of_partition(sim, diags);
    const struct node *fast = node_find(node_find(sim->scene->deck->root, "partition"), "fast");
    if (fast && !has_rates(kind, fast->key) && !scheme_is_compared(sim, fast)) warn(sim, fast, has_rates, diags);
}
