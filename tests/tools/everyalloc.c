/* everyalloc.c -- a program whose allocations fail, one in each run.
 *
 *     everyalloc SHIM FOLDER MOST PROGRAM ARGUMENT...
 *
 * The program is run once whole, with badalloc.so told to count, then once for each k up to that count, or for MOST of them
 * spread over it, with the k-th allocation refused.  Each must end with status 7 and a line `PROGRAM: out of memory` on
 * standard error, or that a matrix would take more than is left (never 1e10 MB), or print what
 * the whole run printed.  Prints the number of runs, or what the first bad ones did.  Exit: 0 all good, 1 not, 2 nothing to see. */
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

struct probe {
    const char *shim, *folder;
    char *const *argv;
    char out[4000], err[4000], tell[4000];
};

static void become(const struct probe *o, long k)
{
    char number[40];
    int in = open("/dev/null", O_RDONLY), out = open(o->out, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    int err = open(o->err, O_WRONLY | O_CREAT | O_TRUNC, 0600);

    dup2(in, 0), dup2(out, 1), dup2(err, 2);
    snprintf(number, sizeof number, "%ld", k);
    setenv("LD_PRELOAD", o->shim, 1);
    setenv("BADALLOC", number, 1);
    if (k == 0) setenv("BADALLOC_TELL", o->tell, 1);
    alarm(60);
    execv(o->argv[0], o->argv);
    _exit(127);
}

static int run(const struct probe *o, long k)
{
    int code;
    pid_t child = fork();

    if (child == 0) become(o, k);
    while (waitpid(child, &code, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(code) ? WEXITSTATUS(code) : 128 + WTERMSIG(code);
}

/* Does a line of the file begin so? */
static int says(const char *path, const char *words)
{
    char line[4000];
    FILE *f = fopen(path, "r");
    int found = 0;

    while (f && !found && fgets(line, sizeof line, f)) found = strstr(line, words) != NULL;
    if (f) fclose(f);
    return found;
}

/* Have both files the same bytes, some? */
static int same(const char *a, const char *b)
{
    FILE *f = fopen(a, "r"), *g = fopen(b, "r");
    int x = 0, y = 0;
    long n = 0;

    while (f && g && (x = getc(f), y = getc(g), x == y) && x != EOF) n++;
    if (f) fclose(f);
    if (g) fclose(g);
    return f && g && x == y && n > 0;
}

int main(int argc, char **argv)
{
    static struct probe o;
    char words[200], first[4100];
    long n = 0, most, bad = 0, ran = 0;

    if (argc < 5) return 2;
    o.shim = argv[1], o.folder = argv[2], most = atol(argv[3]), o.argv = argv + 4;
    snprintf(o.out, sizeof o.out, "%s/out", o.folder);
    snprintf(o.err, sizeof o.err, "%s/err", o.folder);
    snprintf(o.tell, sizeof o.tell, "%s/tell", o.folder);
    const char *slash = strrchr(argv[4], '/');
    snprintf(words, sizeof words, "%s: out of memory", slash ? slash + 1 : argv[4]);
    int whole = run(&o, 0) | run(&o, 0); /* the second finds the files of the first, as all others do */
    snprintf(first, sizeof first, "%s.whole", o.out);
    rename(o.out, first);
    FILE *f = fopen(o.tell, "r");
    if (!f || fscanf(f, "%ld", &n) != 1 || n < 1 || whole > 1) {
        printf("the whole run ends with status %d after %ld allocations\n", whole, n);
        return 2;
    }
    fclose(f);
    for (long i = 0; i < n && i < most; i++) {
        long k = n <= most      ? i + 1
                 : i < most / 2 ? i + 1
                                : most / 2 + (n - most / 2) * (i - most / 2 + 1) / (most - most / 2);
        int code = run(&o, k);
        ran++;
        if (code == whole && same(o.out, first)) continue; /* done without it, as qsort(3) does */
        if (code == 7 && (says(o.err, words) || says(o.err, "more than is left")) && !says(o.err, "e+1")) continue;
        if (bad++ < 12)
            printf("allocation %ld of %ld: exit status %d%s\n", k, n, code, code == 7 ? ", other words" : "");
    }
    printf("%ld of %ld allocations refused, %ld runs wrong\n", ran, n, bad);
    return bad > 0;
}
