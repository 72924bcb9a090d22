/* bytes.c -- decks with one byte changed, through `check`.
 *
 *     bytes PROGRAM FOLDER N SEED DECK...
 *
 * N times one byte of one of the decks is replaced, put in or left out, and the program checks what comes of it, in the
 * deck's own folder.  It has to end by itself within 10 CPU seconds with a status that the manual knows, and not 70.  Prints
 * the number, or what the first bad ones did; they stay in FOLDER as bad-1.yaml ... */
#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum { MOST = 1 << 16, SECONDS = 10, SHOWN = 10 };

static uint64_t throw(uint64_t * s)
{
    uint64_t z = (*s += 0x9e3779b97f4a7c15ULL); /* splitmix64 */

    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
}

/* What a deck is made of comes more often than other bytes. */
static char some_byte(uint64_t *s)
{
    static const char likely[] = "0123456789.-+*/^()[]{},:;\"'#&*!|>%@ \n\t_abcdexyzABC$~<=";
    uint64_t z = throw(s);

    return z % 4 ? likely[(z >> 8) % (sizeof likely - 1)] : (char)(z >> 8);
}

static size_t change(char *to, const char *from, size_t n, uint64_t *s)
{
    size_t at = throw(s) % n, how = throw(s) % 3;

    memcpy(to, from, at);
    if (how == 0) { /* left out */
        memcpy(to + at, from + at + 1, n - at - 1);
        return n - 1;
    }
    to[at] = some_byte(s);
    size_t rest = how == 1 ? at + 1 : at;
    memcpy(to + at + 1, from + rest, n - rest);
    return at + 1 + n - rest;
}

/* The deck comes by standard input, as from a file of its folder. */
static int check(const char *program, const char *path, const char *folder)
{
    int code;
    pid_t child = fork();

    if (child == 0) {
        int none = open("/dev/null", O_RDWR), in = open(path, O_RDONLY);
        dup2(in, 0), dup2(none, 1), dup2(none, 2);
        setrlimit(RLIMIT_CPU, &(struct rlimit){SECONDS, SECONDS});
        if (chdir(folder) == 0) execl(program, program, "check", "--no-trial", "-", (char *)NULL);
        _exit(127);
    }
    while (waitpid(child, &code, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(code) ? WEXITSTATUS(code) : 128 + WTERMSIG(code);
}

int main(int argc, char **argv)
{
    static char deck[MOST], changed[MOST + 1], folder[4000], path[4200];
    long bad = 0, by[256] = {0};

    if (argc < 6) return 2;
    uint64_t s = strtoull(argv[4], NULL, 10);
    for (long i = 0; i < atol(argv[3]); i++) {
        const char *name = argv[5 + throw(&s) % (uint64_t)(argc - 5)], *slash = strrchr(name, '/');
        FILE *f = fopen(name, "rb");
        size_t n = f ? fread(deck, 1, MOST, f) : 0;
        if (f) fclose(f);
        if (n == 0 || n == MOST) return printf("%s: cannot be read\n", name), 2;
        n = change(changed, deck, n, &s);
        snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - name) : 1, slash ? name : ".");
        snprintf(path, sizeof path, "%s/bad-%ld.yaml", argv[2], bad + 1);
        f = fopen(path, "wb");
        if (!f || fwrite(changed, 1, n, f) != n || fclose(f) != 0) return printf("%s: cannot be written\n", path), 2;
        int code = check(argv[1], path, folder);
        by[code & 255]++;
        if (code <= 4 || code == 6 || code == 7) continue;
        if (++bad <= SHOWN)
            printf("%s, change %ld of seed %s: status %d, kept as %s\n", name, i + 1, argv[4], code, path);
    }
    printf("%s decks with one byte changed:", argv[3]);
    for (int c = 0; c < 256; c++)
        if (by[c]) printf(" %ld end with %d", by[c], c);
    printf("; %ld wrong\n", bad);
    return bad > 0;
}
