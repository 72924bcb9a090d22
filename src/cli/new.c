/* new.c -- fmdsub new: a commented starter deck to change */
#include <string.h>
#include <unistd.h>

#include "base/text.h"
#include "cli/cli.h"

static const char pendulum[] =
    "fmdsub: 1\n"
    "title: A pendulum\n"
    "parameters: {L: 1, m: 1}                # numbers with names, for every expression below\n"
    "gravity: [0, -9.81]                     # two numbers make the deck planar, three spatial\n"
    "bodies:\n"
    "  rod:                                  # drawn lying along x, its centre at L/2\n"
    "    mass: m\n"
    "    inertia: m*L^2/12                   # about the centre of mass\n"
    "    at: [L/2, 0]\n"
    "    points: {tip: [L/2, 0]}             # from the centre, body axes\n"
    "constraints:\n"
    "  pin: {revolute: [ground, rod], at: [0, 0]}\n"
    "forces:\n"
    "  air: {damper: pin, damping: 0.01}\n"
    "initial: {pin.angle: -0.5}              # every coordinate is 0 in the drawn position\n"
    "integrate: {scheme: midpoint, step: 1.0e-3, until: 5}\n"
    "output: {every: 0.01, columns: [pin.angle, rod.tip.*, pin.f*, energy.residual]}\n";

static const char mechanism[] =
    "fmdsub: 1\n"
    "title: A driven arm with a stiff sprung mass at its end\n"
    "parameters: {k: 1.0e+5}\n"
    "gravity: [0, -9.81]\n"
    "bodies:\n"
    "  arm:  {mass: 2, inertia: 0.6667, at: [1, 0]}\n"
    "  load: {mass: 0.5, inertia: 1.0e-3, at: [2, 0]}\n"
    "constraints:\n"
    "  hub:   {revolute: [ground, arm], at: [0, 0]}\n"
    "  guide: {prismatic: [arm, load], at: [2, 0], axis: [1, 0]}\n"
    "forces:\n"
    "  spring: {spring: guide, stiffness: k, damping: 1}\n"
    "  motor:  {torque: hub, value: \"if(t < 1, 20*t, 20)\"}   # an expression with a comma needs quotes\n"
    "partition: {fast: [guide]}              # takes the minor step, all else the major one\n"
    "# Scheme, step and ratio by hand: `fmdsub study` tells what else would cost.  Without them and\n"
    "# the partition short trials choose all of it.\n"
    "integrate: {scheme: subcycle, step: 2.0e-4, ratio: 10, until: 2}\n"
    "output: {every: 0.01, columns: [hub.angle, guide.displacement, spring.force, \"energy.*\"]}\n";

static const char beam[] =
    "fmdsub: 1\n"
    "title: A flexible arm with a load, let go\n"
    "gravity: [0, -9.81]\n"
    "bodies:\n"
    "  arm:\n"
    "    beam: {from: [0, 0], to: [2, 0]}      # straight, drawn unbent\n"
    "    section: {rectangle: [0.03, 0.02]}    # width, height in the plane\n"
    "    material: aluminium                   # or {E: 70.0e+9, nu: 0.33, density: 2700}\n"
    "    modes: 4\n"
    "    damping: {ratio: 0.005}\n"
    "    points: {tip: {station: 1}}           # 0 ... 1 along the beam\n"
    "    stress: {root: {station: 0, corner: top}}\n"
    "  load: {mass: 0.5, inertia: 1.0e-3, at: [2, 0]}\n"
    "constraints:\n"
    "  shaft: {revolute: [ground, arm], at: [0, 0]}\n"
    "  grip:  {fixed: [arm, load], at: arm.tip}\n"
    "forces:\n"
    "  stay: {spring: shaft, stiffness: 500, damping: 2}\n"
    "partition: {fast: [arm]}                # its elastic coordinates take the minor step\n"
    "# Scheme, step and ratio by hand: `fmdsub study` tells what else would cost.  Without them and\n"
    "# the partition short trials choose all of it.\n"
    "integrate: {scheme: subcycle, step: 2.0e-4, ratio: 5, until: 2}\n"
    "output: {every: 0.01, columns: [shaft.angle, arm.tip.d*, arm.root.bending, grip.f*, \"energy.*\"]}\n";

static const char controller[] =
    "fmdsub: 1\n"
    "title: An arm that a controller turns\n"
    "parameters: {L: 1}\n"
    "bodies:\n"
    "  arm: {mass: 2, shape: {rod: {from: [0, 0], to: [L, 0]}}}\n"
    "constraints:\n"
    "  pin: {revolute: [ground, arm], at: [0, 0]}\n"
    "signals:                                # named expressions, each a column\n"
    "  goal: 0.8*smooth(t, 0, 1)             # from 0 to 0.8 rad, with no jump of the acceleration\n"
    "  late: goal - pin.angle\n"
    "forces:\n"
    "  motor: {torque: pin, value: \"max(-30, min(30, 40*late - 8*pin.angle_rate))\"}\n"
    "integrate: {scheme: dopri5, tolerance: 1.0e-6, until: 2}\n"
    "output: {every: 0.01, columns: [pin.angle, late, motor.force, energy.residual]}\n";

/* The schema as `make install` puts it beside this program; else where the line's reader may put it. */
static const char *schema_path(struct arena *life)
{
    enum { LONGEST = 3000 };
    char self[LONGEST + 1];
    const ssize_t n = readlink("/proc/self/exe", self, LONGEST);
    self[n > 0 ? n : 0] = 0;
    char *slash = strrchr(self, '/');
    if (slash) *slash = 0;
    if (slash && (slash = strrchr(self, '/'))) {
        *slash = 0;
        const char *path = arena_print(life, "%s/share/fmdsub/deck.schema.json", self);
        if (access(path, R_OK) == 0) return path;
    }
    return "deck.schema.json";
}

/* What editors look for, and where the schema comes from if it is not installed. */
static enum status put_deck(const char *deck, struct arena *life)
{
    const char *path = schema_path(life);
    if (printf("# yaml-language-server: $schema=%s\n", path) < 0) return E_FILE;
    if (*path != '/' && fputs("# (for editors: `fmdsub schema >deck.schema.json` beside this deck)\n", stdout) < 0)
        return E_FILE;
    return fputs(deck, stdout) < 0 ? E_FILE : OK;
}

enum status verb_new(const struct request *request, struct arena *life, struct report *report)
{
    static const char *const names[] = {"pendulum", "mechanism", "beam", "controller"};
    static const char *const decks[] = {pendulum, mechanism, beam, controller};
    if (request->nword > 1) return fail(report, E_USAGE, "'fmdsub new' takes one name");
    const char *name = request->nword ? request->word[0] : "pendulum";
    for (int i = 0; i < 4; i++)
        if (strcmp(names[i], name) == 0) return put_deck(decks[i], life);
    const char *nearest = text_nearest(name, names, 4);
    return fail(report, E_USAGE, "no starter deck '%.40s'%s%s%s (pendulum, mechanism, beam, controller)", name,
                nearest ? ": did you mean '" : "", nearest ? nearest : "", nearest ? "'?" : "");
}
