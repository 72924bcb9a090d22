/* inp.c -- the cards of a CalculiX input file that describe a mesh; see mesh.h */
#include <ctype.h>
#include <libgen.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "reduce/mesh_parts.h"

enum { MOST_DEPTH = 8, MOST_GENERATED = 10000000 };

enum card { CARD_OTHER, CARD_NODE, CARD_NSET, CARD_ELEMENT };

struct state {
    struct mesh *mesh;
    struct text *text;
    struct arena *life;
    enum card card;
    bool generate;
    int set;     /* number of the set that nodes join; -1: none */
    int corners; /* of the elements of this card; 0: not a solid */
    char type[8];
    int filled; /* corners of the last element that are read */
    int depth;
};

/* The value of `key` on a card, up to the next comma, blanks cut off; len 0: not there. */
static const char *card_value(const char *card, const char *key, size_t *len)
{
    *len = 0;
    for (const char *p = strchr(card, ','); p; p = strchr(p, ',')) {
        p += 1 + strspn(p + 1, " \t");
        size_t n = strlen(key);
        if (strncasecmp(p, key, n) != 0) continue;
        const char *q = p + n + strspn(p + n, " \t");
        if (*q != '=') {
            if (*q == 0 || *q == ',') return *len = 1, p;
            continue;
        }
        q += 1 + strspn(q + 1, " \t");
        *len = strcspn(q, ",");
        while (*len && strchr(" \t", q[*len - 1])) --*len;
        return q;
    }
    return NULL;
}

/* That card, not one whose name goes on, as *NODE PRINT does. */
static bool is_card(const char *line, const char *name)
{
    size_t n = strlen(name);
    return strncasecmp(line, name, n) == 0 && strchr(",", line[n + strspn(line + n, " \t")]);
}

static int corners_of(const char *type)
{
    static const struct {
        const char *name;
        int corners;
    } known[] = {{"C3D4", 4},   {"C3D6", 6},    {"C3D8", 8},   {"C3D8R", 8},  {"C3D8I", 8},
                 {"C3D10", 10}, {"C3D10T", 10}, {"C3D15", 15}, {"C3D20", 20}, {"C3D20R", 20}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcmp(type, known[i].name) == 0) return known[i].corners;
    return 0;
}

static void open_element(struct state *s, const char *line)
{
    size_t len;
    const char *type = card_value(line, "TYPE", &len);
    memset(s->type, 0, sizeof s->type);
    for (size_t i = 0; type && i < len && i + 1 < sizeof s->type; i++) s->type[i] = (char)toupper(type[i]);
    s->card = CARD_ELEMENT;
    s->corners = corners_of(s->type);
    s->filled = s->corners;
}

static enum status open_set(struct state *s, const char *line, const char *key)
{
    size_t len, generate;
    const char *name = card_value(line, key, &len);
    s->set = -1;
    if (name && len) s->set = (int)(mesh_add_set(s->mesh, name, len, s->life) - s->mesh->set);
    s->generate = card_value(line, "GENERATE", &generate) != NULL;
    if (s->card == CARD_NSET && s->set < 0) return text_bad(s->text, "*NSET has no NSET=name");
    return OK;
}

static enum status read_file(struct state *s, const char *path, struct report *report);

/* *INCLUDE, INPUT=file: from the folder of the file that says so, else from here, as CalculiX does. */
static enum status include(struct state *s, const char *line)
{
    size_t len;
    const char *name = card_value(line, "INPUT", &len);
    if (!name || !len) return text_bad(s->text, "*INCLUDE has no INPUT=file");
    if (*name == '"' && len > 1) {
        name++;
        len -= 2;
    }
    if (s->depth + 1 >= MOST_DEPTH) return text_bad(s->text, "*INCLUDE goes deeper than %d files", MOST_DEPTH);
    char *folder = dirname(arena_copy(s->life, s->text->path, strlen(s->text->path)));
    const char *path = name[0] == '/' ? arena_print(s->life, "%.*s", (int)len, name)
                                      : arena_print(s->life, "%s/%.*s", folder, (int)len, name);
    struct text *outer = s->text, inner;
    s->text = &inner;
    s->depth++;
    enum status status = read_file(s, path, outer->report);
    s->text = outer;
    s->depth--;
    s->card = CARD_OTHER;
    return status;
}

static enum status open_card(struct state *s, const char *line)
{
    s->card = CARD_OTHER;
    if (is_card(line, "*INCLUDE")) return include(s, line);
    if (is_card(line, "*TRANSFORM")) return text_bad(s->text, "*TRANSFORM: nodes with axes of their own are not read");
    if (is_card(line, "*NODE")) {
        size_t len;
        if (card_value(line, "SYSTEM", &len)) return text_bad(s->text, "*NODE with SYSTEM is not read");
        s->card = CARD_NODE;
        return open_set(s, line, "NSET");
    }
    if (is_card(line, "*NSET")) {
        s->card = CARD_NSET;
        return open_set(s, line, "NSET");
    }
    if (is_card(line, "*ELEMENT")) open_element(s, line);
    return OK;
}

static enum status read_node(struct state *s, char *at)
{
    int id;
    double x[3] = {0};
    if (!word_int(&at, &id) || id < 1) return text_bad(s->text, "expected a node number and three coordinates");
    for (int k = 0; k < 3 && word_mark(&at, ',') && !word_end(at); k++)
        if (!word_real(&at, x + k) || !isfinite(x[k]))
            return text_bad(s->text, "node %d: a coordinate is not a finite number", id);
    if (word_mark(&at, ',') && !word_end(at)) return text_bad(s->text, "node %d has more than three coordinates", id);
    if (!word_end(at)) return text_bad(s->text, "node %d: expected 'number, x, y, z'", id);
    mesh_add_node(s->mesh, id, x, s->life);
    if (s->set >= 0) mesh_add_member(s->mesh->set + s->set, id, s->life);
    return OK;
}

static enum status read_generated(struct state *s, char *at)
{
    int first, last, step = 1;
    bool whole = word_int(&at, &first) && word_mark(&at, ',') && word_int(&at, &last);
    if (whole && word_mark(&at, ',') && !word_end(at)) whole = word_int(&at, &step);
    if (!whole || step < 1 || last < first) return text_bad(s->text, "GENERATE expects 'first, last, step'");
    if (((long)last - first) / step > MOST_GENERATED)
        return text_bad(s->text, "GENERATE makes more than %d nodes", MOST_GENERATED);
    for (long id = first; id <= last; id += step) mesh_add_member(s->mesh->set + s->set, (int)id, s->life);
    return OK;
}

/* Another set's name among the members. */
static enum status read_subset(struct state *s, char **at)
{
    char *name = *at + strspn(*at, " \t");
    size_t len = strcspn(name, ", \t");
    const struct mesh_set *other = mesh_set(s->mesh, arena_copy(s->life, name, len));
    if (!other || !len) return text_bad(s->text, "'%.*s' is neither a node number nor a node set", (int)len, name);
    for (int i = 0, n = other->n; i < n; i++) mesh_add_member(s->mesh->set + s->set, other->id[i], s->life);
    *at = name + len;
    return OK;
}

static enum status read_members(struct state *s, char *at)
{
    int id;
    if (s->generate) return read_generated(s, at);
    do {
        if (word_end(at)) break;
        if (word_int(&at, &id))
            mesh_add_member(s->mesh->set + s->set, id, s->life);
        else
            TRY(read_subset(s, &at));
    } while (word_mark(&at, ','));
    return word_end(at) ? OK : text_bad(s->text, "expected node numbers separated by commas");
}

static enum status read_element(struct state *s, char *at)
{
    int id;
    if (!s->corners) return OK;
    if (s->filled == s->corners) {
        if (!word_int(&at, &id)) return text_bad(s->text, "expected an element number and its nodes");
        struct mesh_element *new = mesh_add_element(s->mesh, s->life);
        new->id = id;
        new->nodes = s->corners;
        memcpy(new->type, s->type, sizeof s->type);
        s->filled = 0;
        if (word_mark(&at, ',') && word_end(at)) return OK;
    }
    struct mesh_element *e = s->mesh->element + s->mesh->nelement - 1;
    do {
        if (word_end(at)) return OK;
        if (s->filled == s->corners || !word_int(&at, &id))
            return text_bad(s->text, "element %d: expected %d nodes", e->id, s->corners);
        e->node[s->filled++] = id;
    } while (word_mark(&at, ','));
    return word_end(at) ? OK : text_bad(s->text, "element %d: expected %d nodes", e->id, s->corners);
}

static enum status read_data(struct state *s, char *line)
{
    switch (s->card) {
    case CARD_NODE:
        return read_node(s, line);
    case CARD_NSET:
        return read_members(s, line);
    case CARD_ELEMENT:
        return read_element(s, line);
    case CARD_OTHER:
        break;
    }
    return OK;
}

static enum status read_file(struct state *s, const char *path, struct report *report)
{
    TRY(text_open(s->text, path, s->life, report));
    files_add_path(&s->mesh->read, path);
    for (char *line; (line = text_line(s->text));) {
        if (line[0] == '*' && line[1] == '*') continue;
        if (word_end(line)) continue;
        if (line[0] == '*')
            TRY(open_card(s, line));
        else
            TRY(read_data(s, line));
    }
    return OK;
}

enum status mesh_read_inp(struct mesh *o, const char *path, struct arena *life, struct report *report)
{
    struct text text;
    struct state s = {.mesh = o, .text = &text, .life = life, .set = -1};
    *o = (struct mesh){.path = path, .read = {.arena = life}};
    TRY(read_file(&s, path, report));
    if (!o->n) return fail(report, E_DECK, "%s: error: there is no *NODE", path);
    if (s.filled < s.corners) return text_bad(&text, "the file ends within element %d", o->element[o->nelement - 1].id);
    mesh_sort(o, life);
    return OK;
}
