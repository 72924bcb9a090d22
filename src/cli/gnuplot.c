/* gnuplot.c -- see gnuplot.h */
#include "cli/gnuplot.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/text.h"
#include "out/script.h"
#include "out/stream.h"

/* Never returns.  Of a group of its own: Ctrl-C is for us. */
static void be_gnuplot(int script, int picture, int words, int trouble)
{
    char *const argv[] = {"gnuplot", "-d", "-", NULL};
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    (void)setpgid(0, 0);
    signal(SIGPIPE, SIG_DFL);
    if (dup2(script, STDIN_FILENO) >= 0 && dup2(picture, STDOUT_FILENO) >= 0 && dup2(words, STDERR_FILENO) >= 0)
        execvp(argv[0], argv);
    const int error = errno;
    ssize_t told = write(trouble, &error, sizeof error);
    (void)told;
    _exit(127);
}

static enum status missing(int error, struct report *report)
{
    if (error == ENOENT)
        return fail(
            report, E_FILE,
            "pictures are drawn by gnuplot, which is not here: install the package gnuplot-nox (Debian: apt-get "
            "install gnuplot-nox), or print the script with --script");
    return fail(report, E_FILE, "gnuplot cannot be started: %s", strerror(error));
}

enum status gnuplot_open(struct gnuplot *o, struct report *report)
{
    int script[2], trouble[2], error = 0;
    *o = (struct gnuplot){.picture = memfd_create("picture", MFD_CLOEXEC), .words = memfd_create("words", MFD_CLOEXEC)};
    if (o->picture < 0 || o->words < 0 || pipe2(script, O_CLOEXEC) != 0 || pipe2(trouble, O_CLOEXEC) != 0)
        return fail(report, E_LIMIT, "no pipe to gnuplot: %s", strerror(errno));
    (void)fflush(NULL);
    o->pid = fork();
    if (o->pid == 0) be_gnuplot(script[0], o->picture, o->words, trouble[1]);
    if (o->pid < 0) error = errno;
    close(script[0]);
    close(trouble[1]);
    o->to = script[1];
    if (o->pid > 0 && read(trouble[0], &error, sizeof error) != sizeof error) error = 0;
    close(trouble[0]);
    if (error == 0) return OK;
    gnuplot_close(o);
    return missing(error, report);
}

/* Waits for its end; false: it was not content. */
static bool ends_well(struct gnuplot *o)
{
    int how = 1;
    close(o->to);
    while (waitpid(o->pid, &how, 0) < 0 && errno == EINTR) continue;
    o->pid = 0;
    return WIFEXITED(how) && WEXITSTATUS(how) == 0;
}

void gnuplot_close(struct gnuplot *o)
{
    if (o->pid > 0) (void)ends_well(o);
    if (o->picture > 0) close(o->picture);
    if (o->words > 0) close(o->words);
    *o = (struct gnuplot){0};
}

static const char *read_all(size_t *n, int file, struct arena *life)
{
    const off_t size = lseek(file, 0, SEEK_END);
    char *bytes = TAKE(life, char, size > 0 ? size + 1 : 1);
    *n = 0;
    for (ssize_t got; *n < (size_t)size && (got = pread(file, bytes + *n, (size_t)size - *n, (off_t)*n)) > 0;)
        *n += (size_t)got;
    return bytes;
}

static enum status write_script(const struct gnuplot *o, const char *script, size_t n)
{
    for (ssize_t sent; n > 0; script += sent, n -= (size_t)sent) {
        sent = write(o->to, script, n);
        if (sent < 0 && errno == EINTR) sent = 0;
        if (sent < 0) return E_FILE;
    }
    return OK;
}

static enum status write_picture(const char *bytes, size_t n, const char *path, struct arena *life,
                                 struct report *report)
{
    struct stream stream;
    TRY(stream_to(&stream, path, life, report));
    return stream_finish(&stream, stream_bytes(&stream, bytes, n, report), report);
}

static enum status draw(struct gnuplot *o, const struct gnuplot_script *s, struct arena *life, struct report *report)
{
    size_t size, said;
    const enum status told = write_script(o, s->text, s->n);
    const bool well = ends_well(o);
    const char *words = read_all(&said, o->words, life), *picture = read_all(&size, o->picture, life);
    enum status status = OK;
    if (told != OK || !well || size == 0)
        status =
            fail(report, E_FILE, "gnuplot has drawn nothing: %.300s",
                 said ? words + strspn(words, " \n\t^") : "it is too old, or was built without this form of picture");
    else
        status = write_picture(picture, size, s->path, life, report);
    gnuplot_close(o);
    return status;
}

const char *gnuplot_ending(const char *path)
{
    static const char *const endings[] = {"svg", "png", "pdf"};
    const char *dot = strrchr(path, '.');
    for (int i = 0; dot && i < 3; i++)
        if (strcasecmp(dot + 1, endings[i]) == 0) return endings[i];
    return NULL;
}

static void put_terminal(FILE *to, const char *path, int width, int height, int lines)
{
    const char *ending = path ? gnuplot_ending(path) : NULL;
    struct winsize window;
    if (!ending) {
        const bool known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 40;
        fprintf(to, "set terminal dumb noenhanced size %d,%d\n", known ? window.ws_col - 1 : 100, lines);
    } else if (strcmp(ending, "svg") == 0) {
        fprintf(to, "set terminal svg size %d,%d font 'Arial,13' background 'white'\n", width, height);
    } else if (strcmp(ending, "png") == 0) {
        fprintf(to, "set terminal pngcairo size %d,%d font 'Sans,11' background 'white'\n", width, height);
    } else {
        fprintf(to, "set terminal pdfcairo size %gin,%gin font 'Sans,9'\n", width / 100., height / 100.);
    }
}

void gnuplot_begin(struct gnuplot_script *s, const char *path, bool shown, int width, int height, int lines)
{
    *s = (struct gnuplot_script){.path = path, .shown = shown};
    s->to = words_open(&s->text, &s->n);
    put_terminal(s->to, path, width, height, lines);
    if (!shown || !path) return;
    fputs("set output ", s->to);
    script_put_text(s->to, path);
    fputc('\n', s->to);
}

enum status gnuplot_end(struct gnuplot *o, struct gnuplot_script *s, struct arena *life, struct report *report)
{
    enum status status = OK;
    words_close(s->to, &s->text);
    if (s->shown)
        fwrite(s->text, 1, s->n, stdout);
    else
        status = draw(o, s, life, report);
    free(s->text);
    return status;
}

enum status gnuplot_check(const char *plot, bool script, struct report *report)
{
    if (script && !plot) return fail(report, E_USAGE, "--script prints what draws --plot FILE");
    if (plot && !gnuplot_ending(plot))
        return fail(report, E_USAGE, "--plot: a file that ends in .svg, .png or .pdf, not '%.200s'", plot);
    return OK;
}
