/* check.c -- fmdsub check: what a deck makes, without running it */
#include "cli/cli.h"
#include "sim/sim.h"

static void print_bodies(FILE *to, const struct model *m)
{
    fprintf(to, "bodies: %d\n", m->nbody - 1);
    for (int i = 1; i < m->nbody; i++) {
        const struct model_body *b = &m->body[i];
        const struct model_joint *j = &m->joint[b->joint];
        fprintf(to, "  %-16s %8.4g kg, %s, on %s by %s (%s, %d freedom%s)\n", b->name, b->mass,
                b->fast ? "fast" : "slow", m->body[b->parent].name, j->name, joint_kind(j->type, m->space == 3)->name,
                j->nv, j->nv == 1 ? "" : "s");
    }
}

static void print_coordinates(FILE *to, const struct model *m)
{
    fprintf(to, "freedoms: %d, of these fast: %d\n", m->n, m->ns);
    for (int i = 0; i < m->ncoordinate; i++)
        fprintf(to, "  %-24s %s  start %.6g\n", m->coordinate[i].name, m->coordinate[i].fast ? "fast" : "slow",
                m->q0[m->coordinate[i].iq]);
}

static void print_forces(FILE *to, const struct model *m)
{
    if (m->nforce) fprintf(to, "forces: %d\n", m->nforce);
    for (int i = 0; i < m->nforce; i++)
        fprintf(to, "  %-16s %s\n", m->force[i].name, m->force[i].cls == FAST ? "fast" : "slow");
}

enum status verb_check(const struct request *request, struct arena *life, struct report *report)
{
    struct scene *scene;
    struct diags *diags = NULL;
    struct sim sim;
    const struct sim_options options = {.version = FMDSUB_VERSION};
    enum status status = cli_load(&scene, &diags, request, life, report);
    if (status == OK) status = sim_open(&sim, scene, &scene->integrate, &options, diags, life, report);
    if (diags) diags_print(stderr, diags, cli_color(request));
    TRY(status);
    if (request->expanded) {
        deck_print(stdout, scene->deck);
    } else {
        printf("%s: %s, %s\n", scene->deck->name, scene->title, sim.model->space == 2 ? "planar" : "spatial");
        print_bodies(stdout, sim.model);
        print_coordinates(stdout, sim.model);
        print_forces(stdout, sim.model);
        printf("records: %ld columns of %d, every %ld major steps, %ld major steps in all\n", (long)sim.chosen.n,
               sim.catalogue.n, sim.every, sim.majors);
    }
    if (request->strict && diags_warnings(diags))
        return fail(report, E_VERDICT, "--strict: %d warning(s) about the deck", diags_warnings(diags));
    return OK;
}
