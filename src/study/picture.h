/* picture.h -- a study as a script for gnuplot: error against CPU time, where that was taken, and against work. */
#ifndef FMDSUB_STUDY_PICTURE_H
#define FMDSUB_STUDY_PICTURE_H

#include "study/study.h"

/* Without `set terminal` and `set output`. */
void picture_script(const struct study *o, const char *title, FILE *to);

enum { PICTURE_WIDTH = 1100, PICTURE_HEIGHT = 520 };

#endif
