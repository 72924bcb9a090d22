/* options.c -- options, by getopt_long, with our own words for what is wrong; see options.h */
#include "reduce/options.h"

#include <getopt.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"

static const struct option options[] = {
    {"interface", required_argument, NULL, 'i'},
    {"modes", required_argument, NULL, 'n'},
    {"method", required_argument, NULL, 'M'},
    {"mesh", required_argument, NULL, 'm'},
    {"length", required_argument, NULL, 'L'},
    {"mass", required_argument, NULL, 'W'},
    {"time", required_argument, NULL, 'T'},
    {"zeta", required_argument, NULL, 'z'},
    {"alpha", required_argument, NULL, 'a'},
    {"beta", required_argument, NULL, 'b'},
    {"prestress", required_argument, NULL, 'p'},
    {"loads", required_argument, NULL, 'l'},
    {"load-mode", required_argument, NULL, 'k'},
    {"stress", required_argument, NULL, 's'},
    {"stiffening", no_argument, NULL, 'S'},
    {"material", required_argument, NULL, 'E'},
    {"output", required_argument, NULL, 'o'},
    {"quiet", no_argument, NULL, 'q'},
    {"help", no_argument, NULL, 'h'},
    {"version", no_argument, NULL, 'V'},
    {0},
};

const char *options_help(void)
{
    return "usage: fmdsub-reduce -i NAME=NODES [options] JOB\n"
           "       fmdsub-reduce -i NAME=NODES [options] K.mtx M.mtx NODES.csv\n\n"
           "  JOB                          CalculiX: JOB.inp, JOB.sti, JOB.mas, JOB.dof\n"
           "  -i, --interface NAME=NODES[@x,y,z][:rigid|:average]\n"
           "                               node set, or numbers joined by '+'; the first is the reference\n"
           "  -n, --modes N                fixed-interface modes (default 10)\n"
           "      --method craig-bampton|eigenmodes\n"
           "      --load-mode KIND         add the static answer to that load (accel-x ... twist-z)\n"
           "      --mesh FILE.inp          in place of JOB.inp\n"
           "      --length, --mass, --time X   SI units in one unit of the input: mm, t, s: 1e-3, 1e3, 1\n"
           "      --zeta X                 damping, share of critical in every mode\n"
           "      --alpha X, --beta X      damping alpha M + beta K [1/s], [s]\n"
           "      --stiffening             geometric stiffness of all loads; needs --material\n"
           "      --loads PREFIX           write the unit loads, PREFIX-KIND.inp, instead of reducing\n"
           "      --prestress KIND[:SCALE]=FILE.sti\n"
           "                               stiffness under SCALE times the load of that kind\n"
           "      --stress NAME=NODE       modal stresses there; needs --material\n"
           "      --material E,NU          Young's modulus (units of the input), Poisson's ratio\n"
           "  -o, --output FILE            default: standard output\n"
           "  -q, --quiet                  warnings and errors only\n"
           "  -h, --help, --version\n\n"
           "exit: 0 done, 2 usage, 3 wrong input, 4 no such body, 5 numerical stop, 6 file, 7 limit\n"
           "manual: fmdsub-reduce(1)\n";
}

static const char *option_name(int code)
{
    for (const struct option *o = options; o->name; o++)
        if (o->val == code) return o->name;
    return "";
}

static enum status real(double *value, int code, double low, bool above, struct report *report)
{
    char *end;
    double x = strtod(optarg, &end);
    if (*end || end == optarg || !isfinite(x) || x < low || (above && x == low))
        return fail(report, E_USAGE, "--%s expects a number %s %g, not '%.60s'", option_name(code),
                    above ? "above" : "of at least", low, optarg);
    *value = x;
    return OK;
}

static enum status count(int *value, struct report *report)
{
    char *end;
    long x = strtol(optarg, &end, 10);
    if (*end || end == optarg || x < 0 || x > 400)
        return fail(report, E_USAGE, "--modes expects a number from 0 to 400, not '%.60s'", optarg);
    *value = (int)x;
    return OK;
}

/* NAME=rest: the name, checked; *rest behind the '='. */
static enum status named(const char **name, char **rest, int code, struct arena *life, struct report *report)
{
    const char *equal = optarg + strcspn(optarg, "=");
    *name = arena_copy(life, optarg, (size_t)(equal - optarg));
    if (!*equal || !equal[1] || !text_is_name(*name)) {
        return fail(report, E_USAGE, "--%s expects NAME=..., a name of letters, digits and '_', not '%.60s'",
                    option_name(code), optarg);
    }
    *rest = arena_copy(life, equal + 1, strlen(equal + 1));
    return OK;
}

static enum status read_point(double *x, char *at, struct report *report)
{
    for (int k = 0; k < 3; k++)
        if ((k && !word_mark(&at, ',')) || !word_real(&at, x + k) || !isfinite(x[k]))
            return fail(report, E_USAGE, "--interface: the place behind '@' should be x,y,z");
    return word_end(at) ? OK : fail(report, E_USAGE, "--interface: the place behind '@' should be x,y,z");
}

static enum status read_tie(struct options *o, struct arena *life, struct report *report)
{
    char *rest;
    if (o->ntie == MOST_TIES) return fail(report, E_LIMIT, "more than %d interfaces", MOST_TIES);
    struct tie_options *tie = o->tie + o->ntie;
    *tie = (struct tie_options){.rigid = true};
    TRY(named(&tie->name, &rest, 'i', life, report));
    for (int i = 0; i < o->ntie; i++)
        if (strcmp(o->tie[i].name, tie->name) == 0)
            return fail(report, E_USAGE, "interface '%s' is given twice", tie->name);
    char *kind = strrchr(rest, ':');
    if (kind) {
        *kind++ = 0;
        tie->rigid = strcmp(kind, "rigid") == 0;
        if (!tie->rigid && strcmp(kind, "average") != 0)
            return fail(report, E_USAGE, "interface '%s': '%.40s' is neither rigid nor average", tie->name, kind);
    }
    char *place = strchr(rest, '@');
    if (place) {
        *place++ = 0;
        tie->placed = true;
        TRY(read_point(tie->at, place, report));
    }
    tie->where = rest;
    o->ntie++;
    return OK;
}

static enum status read_load(struct options *o, struct arena *life, struct report *report)
{
    if (o->nload == MOST_LOADS) return fail(report, E_LIMIT, "more than %d prestressed matrices", MOST_LOADS);
    struct load_options *load = o->load + o->nload++;
    char *text = arena_copy(life, optarg, strlen(optarg)), *path = strchr(text, '='), *end;
    if (!path || !path[1]) return fail(report, E_USAGE, "--prestress expects KIND[:SCALE]=FILE, not '%.60s'", optarg);
    *path++ = 0;
    char *scale = strrchr(text, ':');
    load->scale = 1;
    if (scale && (scale[1] == '-' || scale[1] == '+' || scale[1] == '.' || (scale[1] >= '0' && scale[1] <= '9'))) {
        *scale++ = 0;
        load->scale = strtod(scale, &end);
        if (*end || !isfinite(load->scale) || load->scale == 0)
            return fail(report, E_USAGE, "--prestress: the scale '%.40s' is no number but 0", scale);
    }
    load->kind = text;
    load->path = path;
    return OK;
}

static enum status read_probe(struct options *o, struct arena *life, struct report *report)
{
    char *rest;
    if (o->nprobe == MOST_PROBES) return fail(report, E_LIMIT, "more than %d stress points", MOST_PROBES);
    struct probe_options *probe = o->probe + o->nprobe++;
    TRY(named(&probe->name, &rest, 's', life, report));
    if (!word_int(&rest, &probe->node) || !word_end(rest))
        return fail(report, E_USAGE, "--stress expects NAME=NODE, a node number, not '%.60s'", optarg);
    return OK;
}

static enum status read_material(struct options *o, struct arena *life, struct report *report)
{
    char *at = arena_copy(life, optarg, strlen(optarg));
    o->material = word_real(&at, &o->E) && word_mark(&at, ',') && word_real(&at, &o->nu) && word_end(at);
    if (!o->material || !(o->E > 0) || !isfinite(o->E) || !(o->nu > -1 && o->nu < 0.5))
        return fail(report, E_USAGE, "--material expects E,NU with E above 0 and NU below 0.5, not '%.60s'", optarg);
    return OK;
}

static enum status read_load_mode(struct options *o, struct report *report)
{
    int kind = load_kind(optarg);
    if (kind < 0) return fail(report, E_USAGE, "--load-mode: '%.60s' is none of %s", optarg, load_list());
    for (int k = 0; k < o->basis.nload; k++)
        if (o->extra[k] == kind) return fail(report, E_USAGE, "--load-mode %s is given twice", optarg);
    o->extra[o->basis.nload++] = kind;
    return OK;
}

static enum status read_method(struct options *o, struct report *report)
{
    if (strcmp(optarg, "craig-bampton") == 0) return o->basis.method = CRAIG_BAMPTON, OK;
    if (strcmp(optarg, "eigenmodes") == 0) return o->basis.method = EIGENMODES, OK;
    return fail(report, E_USAGE, "--method is craig-bampton or eigenmodes, not '%.60s'", optarg);
}

static enum status read_option(struct options *o, int code, struct arena *life, struct report *report)
{
    switch (code) {
    case 'i':
        return read_tie(o, life, report);
    case 'n':
        return count(&o->basis.modes, report);
    case 'M':
        return read_method(o, report);
    case 'm':
        return o->source.mesh = optarg, OK;
    case 'L':
        return real(&o->source.units.length, code, 0, true, report);
    case 'W':
        return real(&o->source.units.mass, code, 0, true, report);
    case 'T':
        return real(&o->source.units.time, code, 0, true, report);
    case 'z':
        return real(&o->damping.zeta, code, 0, false, report);
    case 'a':
        return real(&o->damping.alpha, code, 0, false, report);
    case 'b':
        return real(&o->damping.beta, code, 0, false, report);
    case 'p':
        return read_load(o, life, report);
    case 'l':
        return o->write_loads = optarg, OK;
    case 'k':
        return read_load_mode(o, report);
    case 's':
        return read_probe(o, life, report);
    case 'S':
        return o->stiffening = true, OK;
    case 'E':
        return read_material(o, life, report);
    case 'o':
        return o->output = optarg, OK;
    case 'q':
        return o->quiet = true, OK;
    case 'h':
        return o->help = true, OK;
    default:
        return o->version = true, OK;
    }
}

static enum status unknown(int code, char **argv, struct report *report)
{
    const char *names[32], *word = argv[optind - 1];
    int n = 0;
    if (code == ':') return fail(report, E_USAGE, "option '%.60s' needs a value", word);
    for (const struct option *o = options; o->name; o++) names[n++] = o->name;
    const char *nearest = strncmp(word, "--", 2) == 0 ? text_nearest(word + 2, names, n) : NULL;
    if (nearest) return fail(report, E_USAGE, "unknown option '%.60s': did you mean '--%s'?", word, nearest);
    return fail(report, E_USAGE, "unknown option '%.60s' (fmdsub-reduce --help)", word);
}

static enum status read_words(struct options *o, int n, char **word, struct report *report)
{
    if (o->help || o->version) return OK;
    if (n == 1)
        o->source.job = word[0];
    else if (n == 3) {
        o->source.K = word[0];
        o->source.M = word[1];
        o->source.table = word[2];
    } else
        return fail(report, E_USAGE, "expected one CalculiX job, or K.mtx M.mtx NODES.csv (fmdsub-reduce --help)");
    if (n == 3 && o->source.mesh) return fail(report, E_USAGE, "--mesh belongs to a CalculiX job");
    if (!o->ntie) return fail(report, E_USAGE, "name at least one interface: --interface NAME=NODES");
    if (o->nprobe && !o->material) return fail(report, E_USAGE, "--stress needs --material E,NU");
    if (o->stiffening && !o->material) return fail(report, E_USAGE, "--stiffening needs --material E,NU");
    if (o->stiffening && o->nload) return fail(report, E_USAGE, "--stiffening and --prestress: one of both");
    return OK;
}

enum status options_read(struct options *o, int argc, char **argv, struct arena *life, struct report *report)
{
    *o = (struct options){.source.units = {1, 1, 1}, .basis = {.modes = 10, .load = o->extra}};
    opterr = 0;
    for (int code; (code = getopt_long(argc, argv, ":i:n:o:qh", options, NULL)) != -1;) {
        if (code == '?' || code == ':') return unknown(code, argv, report);
        TRY(read_option(o, code, life, report));
    }
    return read_words(o, argc - optind, argv + optind, report);
}
