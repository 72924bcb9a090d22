/* modes.c -- fmdsub modes: frequencies and participation at the start or at a time */
#include "probe/modes.h"

#include <math.h>
#include <stdlib.h>
#include <unistd.h>

#include "cli/cli.h"
#include "out/table.h"

static const double two_pi = 6.28318530717958647693;

static const char *participants(const struct sim *sim, const struct mode *m, struct arena *life)
{
    const char *text = "";
    for (int k = 0; k < 3; k++) {
        if (m->top[k] < 0 || (k && m->share[k] < 0.05)) break;
        text = arena_print(life, "%s%s%s %.0f%%", text, k ? ", " : "", sim_coordinate_name(sim, m->top[k]),
                           100 * m->share[k]);
    }
    return text;
}

static struct table *mode_table(const struct sim *sim, const struct modes *modes, struct arena *life)
{
    static const struct table_column columns[] = {
        {"mode", NULL, 6},    {"frequency", "f [Hz]", 6}, {"omega", "omega [rad/s]", 6},
        {"damping", NULL, 3}, {"fast", "fast share", 3},  {"coordinates", NULL, 0},
    };
    struct table *table = table_open(columns, sizeof columns / sizeof *columns, life);
    for (int i = 0; i < modes->n; i++) {
        const struct mode *m = &modes->mode[i];
        table_number(table, i + 1);
        table_number(table, m->omega / two_pi);
        table_number(table, m->omega);
        table_number(table, m->damping);
        table_number(table, m->fast);
        table_text(table, participants(sim, m, life));
    }
    return table;
}

static void warn_of_growth(const struct modes *modes)
{
    static const double little = 1e-6;
    bool flutter = false;
    for (int i = 0; i < modes->n; i++) flutter = flutter || modes->mode[i].damping < -little;
    if (modes->n && modes->mode[0].omega < -little * fabs(modes->mode[modes->n - 1].omega))
        fputs("negative frequencies are growth rates: this posture is no stable equilibrium\n", stderr);
    if (flutter) fputs("negative damping is growing vibration: this posture is no stable equilibrium\n", stderr);
}

static void warn_of_doubt(const struct modes *modes)
{
    static const double little = 1e-6;
    if (modes->doubt > little)
        fprintf(
            stderr,
            "warning: masses differ by so many decades that the highest frequencies, those of the light parts alone, "
            "may be off by up to %.2g %%\n",
            100 * modes->doubt);
}

enum status verb_modes(const struct request *request, struct arena *life, struct report *report)
{
    struct scene *scene;
    struct diags *diags = NULL;
    struct sim sim;
    struct modes modes;
    const struct sim_options options = {.version = FMDSUB_VERSION, .counting = true, .drawn = true};
    enum status status = cli_load(&scene, &diags, request, life, report);
    if (status == OK) status = sim_open(&sim, scene, &scene->integrate, &options, diags, life, report);
    if (status == OK) status = sim_without_contacts(&sim, "modes", report);
    TRY(cli_told(diags, request, status));
    TRY(cli_go_to(&sim, request, report));
    TRY(modes_find(&modes, &sim, life, report));
    if (!request->quiet) warn_of_growth(&modes);
    warn_of_doubt(&modes);
    return table_print(mode_table(&sim, &modes, life), table_form_of(request->format, isatty(STDOUT_FILENO)), stdout,
                       report);
}
