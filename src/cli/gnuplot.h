/* gnuplot.h -- pictures by gnuplot, a process of its own that is given a script and gives back a picture.
 *
 * It is begun before the program confines itself (cli_confine()), waits for its script, and is told nothing else: names go
 * into the script between single quotes, where gnuplot reads nothing into them, data as numbers in it, and the file of
 * the picture is ours to write. */
#ifndef FMDSUB_CLI_GNUPLOT_H
#define FMDSUB_CLI_GNUPLOT_H

#include <stdbool.h>
#include <stdio.h>
#include <sys/types.h>

#include "base/arena.h"
#include "base/status.h"

struct gnuplot {
    pid_t pid;          /* 0: there is none */
    int to;             /* its script */
    int picture, words; /* files in memory: what it draws, what it says */
};

/* E_FILE: it is not installed, and which package has it. */
enum status gnuplot_open(struct gnuplot *o, struct report *report);

/* What it is to draw: written to `to`, a file in memory. */
struct gnuplot_script {
    FILE *to;
    char *text;
    size_t n;
    const char *path; /* of the picture; NULL: standard output */
    bool shown;       /* printed, for a person to run, in place of being drawn */
};

/* With `set terminal` for that path, width and height in pixels; without one for a terminal of so many lines. */
void gnuplot_begin(struct gnuplot_script *s, const char *path, bool shown, int width, int height, int lines);
/* Draws it, or prints it. */
enum status gnuplot_end(struct gnuplot *o, struct gnuplot_script *s, struct arena *life, struct report *report);
/* One that is not needed any more. */
void gnuplot_close(struct gnuplot *o);

/* --plot and --script as they were given, NULL: not. */
enum status gnuplot_check(const char *plot, bool script, struct report *report);

/* What a picture's file is by its ending: "svg", "png", "pdf"; NULL: something else. */
const char *gnuplot_ending(const char *path);

#endif
