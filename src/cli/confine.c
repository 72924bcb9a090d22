/* confine.c -- from here on: files are read below the deck's folder only, and written beside the outputs only.
 *
 * Landlock, by the numbers of its calls: headers may be older than the kernel, and a kernel without it changes nothing.
 * What a deck may name is checked by itself (deck/source.c); this holds when that is wrong, or libyaml is. */
#include <fcntl.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "cli/cli.h"
#include "out/stream.h"

enum { CREATE_RULESET = 444, ADD_RULE, RESTRICT_SELF };
enum {
    EXECUTE = 1 << 0,
    WRITE = 1 << 1,
    READ = 1 << 2,
    READ_FOLDER = 1 << 3,
    REMOVE = 1 << 5,
    MAKE = 1 << 8,
    TRUNCATE = 1 << 14
};
enum { HANDLED_1 = 0x1fff, HANDLED_2 = 0x3fff, HANDLED_3 = 0x7fff }; /* by version of the interface */

struct ruleset {
    int fd;
    uint64_t handled;
};

/* A path that is not there needs no right. */
static void allow(const struct ruleset *o, const char *path, uint64_t rights)
{
    struct stat st;
    struct __attribute__((packed)) {
        uint64_t rights;
        int32_t fd;
    } rule = {rights & o->handled, open(path, O_PATH | O_CLOEXEC)};
    if (rule.fd < 0) return;
    if (fstat(rule.fd, &st) == 0 && !S_ISDIR(st.st_mode)) rule.rights &= EXECUTE | WRITE | READ | TRUNCATE;
    (void)syscall(ADD_RULE, o->fd, 1, &rule, 0); /* refused for pipes, which are free */
    close(rule.fd);
}

static void allow_folder(const struct ruleset *o, const char *path, uint64_t rights, struct arena *life)
{
    const char *slash = strrchr(path, '/');
    allow(o, slash ? arena_copy(life, path, (size_t)(slash - path) + 1) : ".", rights);
}

static void allow_output(const struct ruleset *o, const char *path, struct arena *life)
{
    const char *part = path ? stream_part(path, life) : NULL;
    if (path) allow(o, path, WRITE | TRUNCATE | READ);
    if (part) allow_folder(o, part, WRITE | READ | MAKE | REMOVE | TRUNCATE, life);
}

/* May the deck ask for checkpoints, which go into the folder where the run is started?  It is not read yet: the word tells,
 * in its text or in a setting, or that it includes others. */
static bool keeps_checkpoints(const struct request *request)
{
    static const char *const word[] = {"checkpoint", "include"};
    struct stat st;
    bool found = false;
    if (strcmp(request->verb, "run") != 0) return false;
    for (int i = 0; i < request->nset; i++) found = found || strstr(request->set[i], word[0]);
    if (found || stat(request->word[0], &st) != 0 || !S_ISREG(st.st_mode)) return found;
    const int fd = open(request->word[0], O_RDONLY | O_CLOEXEC);
    char *text = fd < 0 || st.st_size == 0 ? MAP_FAILED : mmap(NULL, (size_t)st.st_size, PROT_READ, MAP_PRIVATE, fd, 0);
    if (fd >= 0) close(fd);
    if (text == MAP_FAILED) return false;
    for (size_t i = 0; i < sizeof word / sizeof *word; i++)
        found = found || memmem(text, (size_t)st.st_size, word[i], strlen(word[i]));
    munmap(text, (size_t)st.st_size);
    return found;
}

/* A build that counts what is reached writes its counters at the end. */
static void allow_counters(const struct ruleset *o)
{
#if defined(COVERAGE)
    const char *counters = getenv("GCOV_PREFIX");
    if (counters) allow(o, counters, WRITE | READ | MAKE | TRUNCATE);
#else
    (void)o;
#endif
}

void cli_confine(const struct request *request, struct arena *life)
{
    const char *deck = request->word[0];
    const long version = syscall(CREATE_RULESET, NULL, 0, 1);
    if (version < 1) return;
    struct ruleset o = {.handled = version == 1 ? HANDLED_1 : version == 2 ? HANDLED_2 : HANDLED_3};
    o.fd = (int)syscall(CREATE_RULESET, &o.handled, sizeof o.handled, 0);
    if (o.fd < 0) return;
    if (strcmp(deck, "-") != 0) allow(&o, deck, READ);
    allow_folder(&o, strcmp(deck, "-") != 0 ? deck : "", READ | READ_FOLDER, life);
    allow_output(&o, request->output, life);
    allow_output(&o, request->plot, life);
    allow_output(&o, request->page, life);
    allow_output(&o, request->final_state, life);
    if (request->resume_from) allow(&o, request->resume_from, READ);
    if (keeps_checkpoints(request)) allow(&o, ".", WRITE | READ | MAKE | REMOVE | TRUNCATE);
    allow_output(&o, request->stats, life);
    allow_counters(&o);
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0) (void)syscall(RESTRICT_SELF, o.fd, 0);
    close(o.fd);
}
