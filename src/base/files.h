/* files.h -- files by what they are, whatever they are called. */
#ifndef FMDSUB_BASE_FILES_H
#define FMDSUB_BASE_FILES_H

#include <stdbool.h>
#include <sys/types.h>

#include "base/arena.h"

/* A plain file that is there: its device and inode; one that is not yet: those of its folder, and its name there, behind
 * all links. */
struct file_id {
    dev_t device;
    ino_t inode;
    const char *name; /* NULL: the file is there */
};

/* false: it is something else than a plain file, or has no folder. */
bool file_identify(struct file_id *o, const char *path, struct arena *arena);
bool file_same(const struct file_id *a, const struct file_id *b);

/* A list of files; starts zeroed but for its arena. */
struct files {
    struct arena *arena;
    int n, capacity;
    struct file_id *id; /* [n] */
};

/* An open file; the file at a path, where there is one. */
void files_add(struct files *files, int fd);
void files_add_path(struct files *files, const char *path);
bool files_hold(const struct files *files, const struct file_id *id);

#endif
