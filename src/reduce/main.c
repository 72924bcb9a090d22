/* main.c -- fmdsub-reduce: a finite-element body made into a few modes
 *
 *     matrices, mesh -> body -> interfaces -> basis -> integrals -> JSON */
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/text.h"
#include "flex/file.h"
#include "out/stream.h"
#include "out/targets.h"
#include "reduce/material.h"
#include "reduce/options.h"
#include "reduce/prestress.h"
#include "reduce/stress.h"
#include "reduce/summary.h"

#define REDUCE_VERSION "0.1.0"

static enum status make_ties(struct tie **out, const struct options *options, const struct fe *fe, struct arena *life,
                             struct report *report)
{
    struct tie *tie = TAKE(life, struct tie, options->ntie);
    for (int t = 0; t < options->ntie; t++) TRY(tie_make(tie + t, options->tie + t, fe, life, report));
    *out = tie;
    return tie_check(tie, options->ntie, fe, report);
}

static enum status put(const struct flex_body *body, const struct options *options, const struct fe *fe,
                       struct arena *life, struct report *report)
{
    struct stream stream;
    const char *text = flex_file_text(body, fe->centre, life);
    TRY(stream_to(&stream, options->output, life, report));
    return stream_finish(&stream, stream_put(&stream, text, strlen(text), report), report);
}

/* What is read is not written over. */
static enum status check_output(struct fe *fe, const struct options *options, struct arena *life, struct report *report)
{
    const struct target output = {"--output", options->output, true};
    for (int i = 0; i < options->nload; i++) fe_stiffness_files(&fe->read, options->load[i].path);
    return targets_check(&output, 1, &fe->read, life, report);
}

static enum status reduce(const struct options *options, struct arena *life, struct report *report)
{
    struct fe fe;
    struct tie *tie;
    struct basis basis;
    TRY(fe_read(&fe, &options->source, life, report));
    TRY(check_output(&fe, options, life, report));
    TRY(make_ties(&tie, options, &fe, life, report));
    if (options->write_loads) return loads_write(options->write_loads, &fe, tie, options->ntie, life, report);
    TRY(basis_make(&basis, &fe, tie, options->ntie, &options->basis, life, report));
    struct flex_body *body = body_make(&fe, &basis, tie, options->ntie, options->nprobe,
                                       options->nload > 0 || options->stiffening, &options->damping, life);
    TRY(prestress_read(body, options, &fe, &basis, tie, life, report));
    TRY(stress_make(body, options, &fe, &basis, report));
    summary_print(&fe, &basis, tie, options->quiet, life);
    material_check(&fe, options, life);
    return put(body, options, &fe, life, report);
}

int main(int argc, char **argv)
{
    struct arena *life = arena_open();
    struct report report = {0};
    struct options options;
    setvbuf(stdout, TAKE(life, char, BUFSIZ), _IOFBF, BUFSIZ); /* none is asked for later */
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
    enum status status = options_read(&options, argc, argv, life, &report);
    if (status == OK && options.version)
        printf("fmdsub-reduce %s\n", REDUCE_VERSION);
    else if (status == OK && options.help)
        fputs(options_help(), stdout);
    else if (status == OK)
        status = reduce(&options, life, &report);
    if (status == OK && fflush(stdout) != 0) status = fail(&report, E_FILE, "standard output: cannot write");
    if (report.text[0] && status != E_SIGPIPE) {
        fputs(strstr(report.text, ": error: ") ? "" : "fmdsub-reduce: ", stderr);
        text_put(stderr, report.text);
        fputc('\n', stderr);
    }
    (void)fflush(stdout);
    arena_close(life);
    return (int)status;
}
