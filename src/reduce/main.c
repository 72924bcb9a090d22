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
#include "reduce/prestress.h"
#include "reduce/stress.h"
#include "reduce/wish.h"
#include "reduce/words.h"

#define REDUCE_VERSION "0.1.0"

static enum status make_ties(struct tie **out, const struct wish *wish, const struct fe *fe, struct arena *life,
                             struct report *report)
{
    struct tie *tie = TAKE(life, struct tie, wish->ntie);
    for (int t = 0; t < wish->ntie; t++) TRY(tie_make(tie + t, wish->tie + t, fe, life, report));
    *out = tie;
    return tie_check(tie, wish->ntie, fe, report);
}

static enum status put(const struct flex_body *body, const struct wish *wish, const struct fe *fe, struct arena *life,
                       struct report *report)
{
    struct stream stream;
    const char *text = flex_file_text(body, fe->centre, life);
    TRY(wish->output ? stream_create(&stream, wish->output, life, report)
                     : stream_open(&stream, STDOUT_FILENO, "standard output", life, report));
    enum status status = stream_put(&stream, text, strlen(text), report), last;
    last = stream_close(&stream, status == OK, report);
    return status != OK ? status : last;
}

/* What is read is not written over. */
static enum status check_output(struct fe *fe, const struct wish *wish, struct arena *life, struct report *report)
{
    const struct target output = {"--output", wish->output, true};
    for (int i = 0; i < wish->nload; i++) fe_stiffness_files(&fe->read, wish->load[i].path);
    return targets_check(&output, 1, &fe->read, life, report);
}

static enum status reduce(const struct wish *wish, struct arena *life, struct report *report)
{
    struct fe fe;
    struct tie *tie;
    struct basis basis;
    TRY(fe_read(&fe, &wish->source, life, report));
    TRY(check_output(&fe, wish, life, report));
    TRY(make_ties(&tie, wish, &fe, life, report));
    if (wish->write_loads) return loads_write(wish->write_loads, &fe, tie, wish->ntie, life, report);
    TRY(basis_make(&basis, &fe, tie, wish->ntie, &wish->basis, life, report));
    struct flex_body *body = body_make(&fe, &basis, tie, wish->ntie, wish->nprobe, wish->nload > 0 || wish->stiffening,
                                       &wish->damping, life);
    TRY(prestress_read(body, wish, &fe, &basis, tie, life, report));
    TRY(stress_make(body, wish, &fe, &basis, report));
    words_say(&fe, &basis, tie, wish->quiet, life);
    return put(body, wish, &fe, life, report);
}

int main(int argc, char **argv)
{
    struct arena *life = arena_open();
    struct report report = {0};
    struct wish wish;
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
    enum status status = wish_read(&wish, argc, argv, life, &report);
    if (status == OK && wish.version)
        printf("fmdsub-reduce %s\n", REDUCE_VERSION);
    else if (status == OK && wish.help)
        fputs(wish_help(), stdout);
    else if (status == OK)
        status = reduce(&wish, life, &report);
    if (status == OK && fflush(stdout) != 0) status = fail(&report, E_FILE, "standard output: cannot write");
    if (report.text[0] && status != E_SIGPIPE) {
        fputs(strstr(report.text, ": error: ") ? "" : "fmdsub-reduce: ", stderr);
        text_put(stderr, report.text);
        fputc('\n', stderr);
    }
    arena_close(life);
    return (int)status;
}
