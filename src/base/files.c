/* files.c -- see files.h */
#include "base/files.h"

#include <limits.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { LINKS = 40 }; /* from one to the next, as the kernel follows them */

/* The name behind a link that leads to nothing yet, by the link's own folder; NULL: it is no link. */
static const char *behind(const char *path, struct arena *arena)
{
    char name[PATH_MAX];
    const ssize_t n = readlink(path, name, sizeof name - 1);
    if (n < 0) return NULL;
    name[n] = 0;
    const char *slash = *name == '/' ? NULL : strrchr(path, '/');
    return arena_print(arena, "%.*s%s", slash ? (int)(slash + 1 - path) : 0, path, name);
}

bool file_identify(struct file_id *o, const char *path, struct arena *arena)
{
    struct stat st;
    *o = (struct file_id){0};
    for (int links = 0; links < LINKS && stat(path, &st) != 0; links++) {
        const char *next = behind(path, arena);
        if (!next) break;
        path = next;
    }
    if (stat(path, &st) == 0) {
        *o = (struct file_id){st.st_dev, st.st_ino, NULL};
        return S_ISREG(st.st_mode);
    }
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    const char *folder = slash ? arena_copy(arena, path, (size_t)(name - path)) : ".";
    if (stat(folder, &st) != 0) return false;
    *o = (struct file_id){st.st_dev, st.st_ino, name};
    return true;
}

bool file_same(const struct file_id *a, const struct file_id *b)
{
    if (a->device != b->device || a->inode != b->inode || !a->name != !b->name) return false;
    return !a->name || strcmp(a->name, b->name) == 0;
}

static void add(struct files *files, struct file_id id)
{
    files->id = arena_more(files->arena, files->id, files->n, &files->capacity, sizeof *files->id);
    files->id[files->n++] = id;
}

void files_add(struct files *files, int fd)
{
    struct stat st;
    if (fstat(fd, &st) == 0 && S_ISREG(st.st_mode)) add(files, (struct file_id){st.st_dev, st.st_ino, NULL});
}

void files_add_path(struct files *files, const char *path)
{
    struct file_id id;
    if (file_identify(&id, path, files->arena)) add(files, id);
}

bool files_hold(const struct files *files, const struct file_id *id)
{
    for (int i = 0; i < files->n; i++)
        if (file_same(&files->id[i], id)) return true;
    return false;
}
