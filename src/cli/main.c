/* main.c -- fmdsub: verbs, signals, the last word and the exit status */
#include <cjson/cJSON.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "base/limits.h"
#include "base/stop.h"
#include "base/text.h"
#include "cli/cli.h"
#include "study/auto.h"

/* Sanitizers read files of their own at the end. */
#if defined(__SANITIZE_ADDRESS__)
enum { UNCONFINED = 1 };
#else
enum { UNCONFINED = 0 };
#endif

const struct verb verbs[] = {
    {"run", "DECK", "simulate; records to stdout", verb_run},
    {"check", "DECK", "check a deck and print what it makes", verb_check},
    {"study", "DECK", "what accuracy costs: error against time over schemes, ratios, steps", verb_study},
    {"plot", "DECK or FILE.csv ...", "columns over time as a picture, by gnuplot", verb_plot},
    {"animate", "DECK", "the motion as moving pictures: a page for a browser, or glTF", verb_animate},
    {"sweep", "DECK", "one deck at many points: a table of what each run gives", verb_sweep},
    {"diff", "A B", "two records compared, column by column: files that run wrote, or decks", verb_diff},
    {"modes", "DECK", "frequencies of small motions and who takes part", verb_modes},
    {"stability", "DECK", "which steps a scheme can take: growth from step to step", verb_stability},
    {"list", "[schemes|joints|forces|effects|sections|columns DECK]", "what a deck may say", verb_list},
    {"schema", "", "the deck's grammar as a JSON Schema", verb_schema},
    {"explain", "CODE or DECK",
     "what a message means and how to cure it; a deck's effects: what each costs and changes", verb_explain},
    {"selftest", "", "this program against references that it has with it: status 0, or 70", verb_selftest},
    {"new", "pendulum|mechanism|beam|controller", "print a commented starter deck", verb_new},
    {0},
};

static const struct verb *find_verb(const char *name)
{
    for (const struct verb *v = verbs; v->name; v++)
        if (strcmp(v->name, name) == 0) return v;
    return NULL;
}

/* about: one verb and its options; NULL: all of them. */
static void help(FILE *to, const struct verb *about)
{
    if (about)
        fprintf(to, "usage: fmdsub %s [options] %s\n\n  %s\n", about->name, about->usage, about->brief);
    else
        fprintf(to, "usage: fmdsub VERB [options] [DECK]    (DECK '-': standard input)\n\n");
    for (const struct verb *v = verbs; v->name && !about; v++) fprintf(to, "  %-9s %s\n", v->name, v->brief);
    fprintf(to, "\noptions:\n");
    for (const struct cli_option *o = cli_options; o->name; o++) {
        if (about && !cli_serves(o, about->name)) continue;
        char left[60];
        const char *value = o->value ? o->value : "";
        char letter[4] = {'-', o->letter ? o->letter : ' ', o->letter ? ',' : ' ', 0};
        if (!o->letter) letter[0] = ' ';
        snprintf(left, sizeof left, "%s --%s%s%s", letter, o->name, o->value && value[0] != '[' ? " " : "",
                 value[0] == '[' ? "[=FILE]" : value);
        fprintf(to, "  %-34s %s\n", left, o->brief);
    }
    fprintf(to, "\nexit: 0 done, 1 negative verdict, 2 usage, 3 deck, 4 no start, 5 numerical stop, 6 file, 7 limit, "
                "70 bug\nmanual: fmdsub(1), fmdsub-deck(5), fmdsub-equations(7)\n");
}

bool cli_color(const struct request *request)
{
    const char *word = request->color ? request->color : "auto", *term = getenv("TERM");
    if (strcmp(word, "auto") != 0) return strcmp(word, "always") == 0;
    return isatty(STDERR_FILENO) && !getenv("NO_COLOR") && term && strcmp(term, "dumb") != 0;
}

enum status cli_load(struct scene **scene, struct diags **diags, const struct request *request, struct arena *life,
                     struct report *report)
{
    if (request->nword != 1)
        return fail(report, E_USAGE, "'fmdsub %s' takes one deck%s", request->verb,
                    request->nword ? "" : "; '-' is standard input");
    *diags = diags_open(life);
    if (!UNCONFINED) cli_confine(request, life);
    const struct deck_options options = {.nset = request->nset, .set = request->set, .option = request->option};
    return sim_load(scene, request->word[0], &options, *diags, life, report);
}

enum status cli_load_again(struct scene **scene, struct diags **diags, const struct request *request,
                           const struct scene *before, unsigned unheard, struct arena *life, struct report *report)
{
    const struct deck_options options = {.nset = request->nset,
                                         .set = request->set,
                                         .option = request->option,
                                         .again = diags_source(before->deck->diags, 0)};
    *diags = diags_open(life);
    return sim_load_with(scene, request->word[0], &options, unheard, *diags, life, report);
}

enum status cli_load_run(struct scene **scene, struct diags **diags, const struct request *request, struct arena *life,
                         struct report *report)
{
    TRY(cli_load(scene, diags, request, life, report));
    return auto_choose(*scene, life, report);
}

/* The handler stands for one signal only: the next ends the program at once.  What comes within a moment is the same
 * wish said twice: timeout(1) tells its child, then its whole group.  It is pending here, since a signal is blocked
 * in its own handler; SA_RESETHAND would let it through before that. */
static void on_signal(int signal)
{
    const struct timespec moment = {0, 50000000};
    const struct sigaction none = {.sa_handler = SIG_DFL};
    sigset_t same;
    int error = errno;
    stop = signal;
    sigemptyset(&same);
    sigaddset(&same, signal);
    sigtimedwait(&same, NULL, &moment);
    sigaction(signal, &none, NULL);
    errno = error;
}

/* What the caller ignores, as nohup(1) does, stays ignored. */
static void set_signals(void)
{
    static const int ends[] = {SIGHUP, SIGINT, SIGTERM, SIGXCPU};
    struct sigaction once = {.sa_handler = on_signal}, was;
    struct sigaction ignore = {.sa_handler = SIG_IGN};
    for (size_t i = 0; i < sizeof ends / sizeof *ends; i++)
        if (sigaction(ends[i], NULL, &was) == 0 && was.sa_handler != SIG_IGN) sigaction(ends[i], &once, NULL);
    sigaction(SIGPIPE, &ignore, NULL);
    sigaction(SIGXFSZ, &ignore, NULL);
}

/* Descriptors 0 to 2 are open before anything else is, so that no file of ours takes their place: a closed one
 * becomes one that fails when used. */
static void hold_descriptors(void)
{
    for (int fd = 0; fd < 3; fd++)
        if (fcntl(fd, F_GETFD) < 0) (void)open("/dev/null", fd == 0 ? O_WRONLY : O_RDONLY);
}

/* What stdio still holds goes out.  When it cannot, did the reader leave (`| head`)? */
static enum status flush_words(struct report *report)
{
    struct pollfd out = {.fd = STDOUT_FILENO};
    if (fflush(stdout) == 0 && !ferror(stdout)) return OK;
    if (poll(&out, 1, 0) == 1 && out.revents & POLLERR) return E_SIGPIPE;
    return fail(report, E_FILE, "standard output: cannot write");
}

static enum status dispatch(const struct request *request, struct arena *life, struct report *report)
{
    const char *names[32] = {"help"};
    int n = 1;
    if (request->version) return printf("fmdsub %s\n", FMDSUB_VERSION), OK;
    const bool asked = request->verb && strcmp(request->verb, "help") == 0;
    const char *about = asked ? request->nword ? request->word[0] : NULL : request->verb;
    if (request->help || (asked && (!about || find_verb(about)))) {
        help(stdout, about ? find_verb(about) : NULL);
        return OK;
    }
    if (!request->verb) {
        help(stderr, NULL);
        return E_USAGE;
    }
    for (const struct verb *v = verbs; v->name; v++) {
        if (strcmp(v->name, request->verb) == 0) {
            TRY(request_check(request, report));
            return v->run(request, life, report);
        }
        names[n++] = v->name;
    }
    const char *nearest = text_nearest(about, names, n);
    if (nearest) return fail(report, E_USAGE, "unknown verb '%.40s': did you mean '%s'?", about, nearest);
    return fail(report, E_USAGE, "unknown verb '%.40s' (fmdsub --help)", about);
}

/* "500M"; 0: it is no size.  Units are those of disks: k, M, G, T of 1000. */
static double read_size(const char *word)
{
    static const char units[] = "kMGT";
    char *end;
    double size = strtod(word, &end);
    const char *unit = *end ? strchr(units, *end) : NULL;
    if (unit) size *= pow(1000, (double)(unit - units + 1)), end++;
    if (*end == 'B') end++;
    return end > word && !*end && size > 0 && size < 1e18 ? size : 0;
}

/* Nothing of a deck has been looked at yet. */
static enum status set_limits(const struct request *request, struct report *report)
{
    double bytes = limit_memory_default(), seconds = 0;
    char *end;
    if (request->max_memory) {
        bytes = read_size(request->max_memory);
        if (!(bytes >= 1e7))
            return fail(report, E_USAGE, "--max-memory takes a size from 10M, such as 500M or 4G, not '%.40s'",
                        request->max_memory);
    }
    if (isfinite(bytes) && !limit_memory(bytes) && request->max_memory)
        return fail(report, E_USAGE, "--max-memory: this system takes no such limit");
    if (!request->max_time) return OK;
    seconds = strtod(request->max_time, &end);
    if (*end || !(seconds > 0 && seconds < 1e9))
        return fail(report, E_USAGE, "--max-time takes seconds, not '%.40s'", request->max_time);
    if (!limit_time(seconds)) return fail(report, E_USAGE, "--max-time: this system takes no such limit");
    return OK;
}

/* What libraries take for themselves: all of it, or the program ends as it does without memory. */
static void hold_memory(struct arena *life)
{
    cJSON_InitHooks(&(cJSON_Hooks){memory_or_end, free});
    setvbuf(stdout, TAKE(life, char, BUFSIZ), isatty(STDOUT_FILENO) ? _IOLBF : _IOFBF, BUFSIZ);
}

int main(int argc, char **argv)
{
    struct arena *life = arena_open();
    struct report report = {0};
    struct request request;
    hold_descriptors();
    hold_memory(life);
    set_signals();
    enum status status = request_read(&request, argc, argv, life, &report);
    if (status == OK) status = set_limits(&request, &report);
    if (status == OK) status = dispatch(&request, life, &report);
    if (status == OK) status = flush_words(&report);
    if (status == E_LIMIT && !report.text[0] && stop_limit())
        (void)fail(&report, status, "the limit of %s is reached", stop_limit());
    if (report.text[0] && status != E_SIGPIPE) {
        bool placed = strstr(report.text, ": error: ") != NULL;
        fputs(placed ? "" : "fmdsub: ", stderr);
        text_put(stderr, report.text);
        fputc('\n', stderr);
    }
    (void)fflush(stdout);
    arena_close(life);
    return (int)status;
}
