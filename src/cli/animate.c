/* animate.c -- fmdsub animate: a run as moving pictures, in one file for a browser or a viewer */
#include "base/text.h"
#include "cli/cli.h"
#include "cli/curves.h"
#include "film/film.h"
#include "out/targets.h"

static const struct {
    const char *ending;
    enum status (*write)(const struct film *film, struct stream *stream, struct report *report);
} forms[] = {{".html", film_html}, {".glb", film_gltf}, {".svg", film_svg}, {".pvd", film_vtu}};
enum { FORMS = sizeof forms / sizeof *forms };

static int form_of(const char *path)
{
    int i = 0;
    while (i < FORMS && !text_ends(path, forms[i].ending)) i++;
    return i;
}

struct shooting {
    struct film *film;
    struct sim *sim;
};

static enum status add_row(struct sink *sink, const double *x, struct report *report)
{
    struct shooting *o = sink->self;
    (void)report;
    film_add(o->film, o->sim, x);
    return OK;
}

static enum status write_film(const struct film *film, const struct request *request, int form, struct arena *life,
                              struct report *report)
{
    struct stream stream;
    TRY(stream_create(&stream, request->output, life, report));
    return stream_finish(&stream, forms[form].write(film, &stream, report), report);
}

enum status verb_animate(const struct request *request, struct arena *life, struct report *report)
{
    static const struct sink_ops ops = {.row = add_row};
    const struct sim_options options = {.version = FMDSUB_VERSION, .warnings = stderr};
    const struct target file = {"--output", request->output, true};
    struct scene *scene;
    struct diags *diags = NULL;
    struct sim sim = {0};
    struct film film;
    struct shooting shooting = {&film, &sim};
    struct sink sink = {&ops, &shooting};
    const int form = request->output ? form_of(request->output) : FORMS;
    if (form == FORMS)
        return fail(report, E_USAGE, "'fmdsub animate' writes --output FILE.html, FILE.glb, FILE.pvd or FILE.svg");
    enum status status = cli_load_run(&scene, &diags, request, life, report);
    if (status == OK) status = targets_check(&file, 1, &scene->deck->read, life, report);
    if (status == OK) curves_refine(scene, request);
    if (status == OK) status = sim_open(&sim, scene, &scene->integrate, &options, diags, life, report);
    TRY(cli_told(diags, request, status));
    curves_refine_steps(&sim, request);
    film_open(&film, &sim, life);
    const enum status ended = sim_run(&sim, &sink, report);
    if (film.frames < 2) return ended != OK ? ended : fail(report, E_MODEL, "nothing moves: there is one record only");
    film_close(&film, &sim);
    struct report late = {0};
    status = write_film(&film, request, form, life, &late);
    if (status != OK) *report = late;
    if (status != OK) return status;
    if (!request->quiet)
        fprintf(stderr, "%s: %d frames of %d things, t = %.6g to %.6g s\n", request->output, film.frames, film.nactor,
                film.x[0], film.x[(size_t)(film.frames - 1) * (size_t)film.ncolumn]);
    return ended;
}
