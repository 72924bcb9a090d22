/* cputime.c -- CPU time of commands, the least of several interleaved runs.
 *
 *     cputime [-n REPEATS] COMMAND ...
 *
 * Each command is a shell word list given as one argument.  Prints one line per command: the least
 * user + system time in seconds [s] of its runs, from getrusage of the child.  The commands take
 * turns, so a busy machine is busy for all of them; the least of many is what the work costs.
 * Exit 1 when a command fails. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

static double seconds(struct timeval t)
{
    return (double)t.tv_sec + 1e-6 * (double)t.tv_usec;
}

/* CPU time of one run; < 0 when it failed.  The shell execs the command, so its own start is the
 * only thing added. */
static double run(const char *command)
{
    char *exec = malloc(strlen(command) + 6);
    struct rusage use;
    int status;

    sprintf(exec, "exec %s", command);
    pid_t child = fork();
    if (child == 0) {
        execl("/bin/sh", "sh", "-c", exec, (char *)NULL);
        _exit(127);
    }
    free(exec);
    if (child < 0 || wait4(child, &status, 0, &use) < 0) return -1;
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return -1;
    return seconds(use.ru_utime) + seconds(use.ru_stime);
}

int main(int argc, char **argv)
{
    int repeats = 5, first = 1;

    if (argc > 2 && strcmp(argv[1], "-n") == 0) {
        repeats = atoi(argv[2]);
        first = 3;
    }
    int n = argc - first;
    if (n < 1 || repeats < 1) {
        fputs("usage: cputime [-n REPEATS] COMMAND ...\n", stderr);
        return 2;
    }
    double *least = malloc((size_t)n * sizeof *least);
    for (int r = 0; r < repeats; r++)
        for (int i = 0; i < n; i++) {
            double t = run(argv[first + i]);
            if (t < 0) {
                fprintf(stderr, "cputime: failed: %s\n", argv[first + i]);
                return 1;
            }
            if (r == 0 || t < least[i]) least[i] = t;
        }
    for (int i = 0; i < n; i++) printf("%.6f\n", least[i]);
    free(least);
    return 0;
}
