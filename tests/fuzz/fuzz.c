/* fuzz.c -- see fuzz.h */
#include "fuzz/fuzz.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[64];
static char put[8][128]; /* files in it */
static int nput;

_Noreturn void broken(const char *file, int line, const char *promise)
{
    fprintf(stderr, "%s:%d: broken: %s\n", file, line, promise);
    abort();
}

static void leave(void)
{
    for (int i = 0; i < nput; i++) unlink(put[i]);
    rmdir(folder);
}

static const char *path_of(const char *name)
{
    if (!*folder) {
        strcpy(folder, "/tmp/fmdsub-fuzz-XXXXXX");
        PROMISE(mkdtemp(folder));
        atexit(leave);
    }
    char path[sizeof *put];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    for (int i = 0; i < nput; i++)
        if (strcmp(put[i], path) == 0) return put[i];
    PROMISE(nput < (int)(sizeof put / sizeof *put));
    return strcpy(put[nput++], path);
}

const char *put_bytes(const char *name, const void *data, size_t size)
{
    const char *path = path_of(name);
    FILE *file = fopen(path, "wb");
    PROMISE(file && fwrite(data, 1, size, file) == size && fclose(file) == 0);
    return path;
}

const char *put_text(const char *name, const char *text)
{
    return put_bytes(name, text, strlen(text));
}

const char *put_copy(const char *name, const char *from)
{
    static char text[1 << 16];
    FILE *file = fopen(from, "rb");
    PROMISE(file);
    size_t size = fread(text, 1, sizeof text, file);
    fclose(file);
    return put_bytes(name, text, size);
}
