/* script.h -- what goes into a script for gnuplot: texts that it reads nothing into, and numbers. */
#ifndef FMDSUB_OUT_SCRIPT_H
#define FMDSUB_OUT_SCRIPT_H

#include <stdio.h>

/* 'text' between single quotes, where gnuplot knows no escapes, no substitution and no commands: only the quote itself
 * is doubled, and what a terminal would obey is shown as its code. */
void script_put_text(FILE *to, const char *text);

/* x, or ? where it is not finite: `set datafile missing '?'`. */
void script_put_number(FILE *to, double x);

/* The i-th of eight colours that are told apart by most eyes, and on paper. */
const char *script_color(int i);

#endif
