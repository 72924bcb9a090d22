/* tree.c -- see tree.h */
#include "deck/tree.h"

#include <assert.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <yaml.h>

/* ---- nodes ---- */

struct node *pool_node(struct pool *pool)
{
    if (pool->left == 0) {
        pool->left = 256;
        pool->node = TAKE(pool->arena, struct node, pool->left);
    }
    pool->left--;
    pool->nodes++;
    return pool->node++;
}

/* Bytes aligned for a pointer. */
static char *pool_bytes(struct pool *pool, size_t n)
{
    enum { CHUNK = 1 << 14 };
    n = (n + 7) & ~(size_t)7;
    if (n > CHUNK / 4) return TAKE(pool->arena, char, n);
    if (n > pool->room) {
        pool->byte = TAKE(pool->arena, char, CHUNK);
        pool->room = CHUNK;
    }
    char *bytes = pool->byte;
    pool->byte += n;
    pool->room -= n;
    return bytes;
}

char *pool_text(struct pool *pool, const char *text, size_t len)
{
    char *copy = pool_bytes(pool, len + 1);
    memcpy(copy, text, len);
    copy[len] = 0;
    return copy;
}

struct node **pool_items(struct pool *pool, struct node *const *items, int n)
{
    struct node **copy = (struct node **)(void *)pool_bytes(pool, (size_t)n * sizeof *copy);
    if (n) memcpy(copy, items, (size_t)n * sizeof *copy);
    return copy;
}

struct node *pool_scalar(struct pool *pool, const char *text, const struct node *place)
{
    struct node *n = pool_node(pool);
    *n = (struct node){.type = NODE_SCALAR,
                       .file = place->file,
                       .mark = place->mark,
                       .end = place->end,
                       .scope = place->scope,
                       .text = text,
                       .len = strlen(text)};
    return n;
}

struct node *tree_copy(struct pool *pool, const struct node *n, const struct scope *scope)
{
    struct node *copy = pool_node(pool);
    *copy = *n;
    copy->scope = scope;
    if (n->count) copy->item = pool_items(pool, n->item, n->count);
    for (int i = 0; i < n->count; i++) copy->item[i] = tree_copy(pool, n->item[i], scope);
    return copy;
}

long tree_size(const struct node *n)
{
    long size = 1;
    for (int i = 0; i < n->count; i++) size += tree_size(n->item[i]);
    return size;
}

void tree_append(struct pool *pool, struct node *map, struct node *member)
{
    for (int i = 0; i < map->count; i++)
        if (!strcmp(map->item[i]->key, member->key)) {
            map->item[i] = member;
            return;
        }
    struct node **items = (struct node **)(void *)pool_bytes(pool, (size_t)(map->count + 1) * sizeof *items);
    if (map->count) memcpy(items, map->item, (size_t)map->count * sizeof *items);
    items[map->count++] = member;
    map->item = items;
}

/* ---- duplicates ---- */

struct ranked {
    struct node *node;
    int rank;
};

static int by_key(const void *a, const void *b)
{
    const struct ranked *x = a, *y = b;
    int order = strcmp(x->node->key, y->node->key);
    return order ? order : x->rank - y->rank;
}

static bool same_key(const struct ranked *a, const struct ranked *b)
{
    return !strcmp(a->node->key, b->node->key);
}

/* Tells of the members whose key has been given and takes them out; sorted[0..n) are all members by key. */
static void drop_repeated(struct node *map, const struct ranked *sorted, struct diags *diags, struct arena *arena)
{
    bool *drop = TAKE(arena, bool, map->count);
    for (int i = 1, first = 0; i < map->count; i++) {
        if (!same_key(&sorted[first], &sorted[i])) {
            first = i;
            continue;
        }
        const struct node *n = sorted[i].node;
        drop[sorted[i].rank] = true;
        diag_error(diags, n, AT_KEY, "E-duplicate", "key '%s' is given twice", diag_clip(diags, n->key));
        diag_note(diags, sorted[first].node, AT_KEY, "first given here");
    }
    int kept = 0;
    for (int i = 0; i < map->count; i++)
        if (!drop[i]) map->item[kept++] = map->item[i];
    map->count = kept;
}

void tree_unique(struct node *map, struct diags *diags, struct arena *arena)
{
    struct arena_mark mark = arena_mark(arena);
    struct ranked *sorted = TAKE(arena, struct ranked, map->count);
    bool repeated = false;
    for (int i = 0; i < map->count; i++) sorted[i] = (struct ranked){map->item[i], i};
    qsort(sorted, (size_t)map->count, sizeof *sorted, by_key);
    for (int i = 1; i < map->count; i++) repeated |= same_key(&sorted[i - 1], &sorted[i]);
    if (repeated)
        drop_repeated(map, sorted, diags, arena);
    else
        arena_rewind(arena, mark);
}

/* ---- building ---- */

struct anchor {
    const char *name;
    struct node *node;
    struct span at;
    bool open;  /* its node is being built */
    long nodes; /* in it, aliases counted in full */
};

struct builder {
    struct pool *pool;
    struct diags *diags;
    int file, shift; /* characters before the document in its first line */
    const struct source *source;
    size_t from;
    int depth, anchors, aliases;
    struct anchor *anchor; /* [MAX_ANCHORS], once there is one */
    struct node **alias;   /* [MAX_ANCHORS] copies whose children are still the anchor's */
    struct node **stack;   /* items of the open collections */
    int top, room;
    yaml_parser_t parser;
};

static struct mark place(const struct builder *b, yaml_mark_t m)
{
    return (struct mark){(int)m.line + 1, (int)m.column + 1 + (m.line == 0 ? b->shift : 0)};
}

static struct span between(const struct builder *b, yaml_mark_t from, yaml_mark_t to)
{
    return (struct span){b->file, place(b, from), place(b, to)};
}

static struct span event_span(const struct builder *b, const yaml_event_t *e)
{
    return between(b, e->start_mark, e->end_mark);
}

static void push(struct builder *b, struct node *n)
{
    if (b->top == b->room) {
        struct node **more = TAKE(b->pool->arena, struct node *, b->room = 2 * b->room + 256);
        if (b->top) memcpy(more, b->stack, (size_t)b->top * sizeof *more);
        b->stack = more;
    }
    b->stack[b->top++] = n;
}

static bool within(struct builder *b, long nodes, struct span at)
{
    if (b->pool->nodes + nodes <= MAX_NODES) return true;
    diag_error_in(b->diags, at, "E-limit-nodes", "the deck holds more than %d values", MAX_NODES);
    return false;
}

static bool shallow(struct builder *b, int height, struct span at)
{
    if (b->depth + height <= MAX_DEPTH) return true;
    diag_error_in(b->diags, at, "E-limit-depth", "lists and maps are nested more than %d deep", MAX_DEPTH);
    return false;
}

/* ---- syntax errors in words ---- */

/* The last line above `line` that holds something, as bytes of the source. */
static size_t line_above(const struct source *s, int line, size_t *end)
{
    for (line--; line >= 1; line--) {
        size_t start = s->line[line - 1], stop = source_line_end(s, line);
        while (start < stop && s->text[start] == ' ') start++;
        *end = stop;
        if (start < stop && s->text[start] != '#') return start;
    }
    return *end = 0;
}

/* `key:value` without the space, which YAML takes for one text. */
static bool lacks_space(const char *text, size_t len)
{
    const char *colon = memchr(text, ':', len);
    return colon && colon > text && colon + 1 < text + len && !strchr(" \t\r\n/", colon[1]) &&
           !memchr(text, ' ', (size_t)(colon - text));
}

/* A key where none can be mostly means that the line above lacks a space: that line is told. */
static bool tell_space(struct builder *b, int line)
{
    size_t end, start = line_above(b->source, line, &end);
    if (end <= start || !lacks_space(b->source->text + start, end - start)) return false;
    struct span at = {b->file, source_mark(b->source, start), source_mark(b->source, end)};
    const char *text =
        arena_print(b->pool->arena, "%.*s", (int)(end - start < 200 ? end - start : 200), b->source->text + start);
    diag_error_in(b->diags, at, "E-colon", "a space is missing after ':' in '%s'", diag_clip(b->diags, text));
    return true;
}

struct complaint {
    const char *problem, *code, *says, *note;
};

static const struct complaint complaints[] = {
    {"did not find expected ',' or ']'", "E-unclosed", "expected ',' or ']'", "the list is opened here"},
    {"did not find expected ',' or '}'", "E-unclosed", "expected ',' or '}'", "the map is opened here"},
    {"found unexpected end of stream", "E-unclosed", "the text ends inside a quote", "the quote is opened here"},
    {"found unexpected document indicator", "E-unclosed", "'---' or '...' inside a quote", "the quote is opened here"},
    {"did not find expected key", "E-indent", "expected a key of the map around it", "the map begins here"},
    {"did not find expected '-' indicator", "E-indent", "expected '-', the next item of the list around it",
     "the list begins here"},
    {"block sequence entries are not allowed in this context", "E-indent", "a list cannot begin here", NULL},
    {"mapping values are not allowed in this context", "E-yaml", "a key cannot stand here", NULL},
    {"mapping keys are not allowed in this context", "E-yaml", "a key cannot stand here", NULL},
    {"could not find expected ':'", "E-yaml", "expected ':' after a key", "the key is here"},
    {"found a tab character that violates indentation", "E-tab", "a tab cannot indent; use spaces", NULL},
    {"found a tab character where an indentation space is expected", "E-tab", "a tab cannot indent; use spaces", NULL},
    {"found incompatible YAML document", "E-yaml", "only YAML 1.1 and 1.2 are read", NULL},
    {"found invalid Unicode character escape code", "E-yaml", "this escape is no character", NULL},
    {"did not find expected node content", "E-yaml", "expected a value", NULL},
    {"found unknown escape character", "E-yaml", "unknown escape in a text in double quotes", NULL},
    {"did not find expected <document start>", "E-yaml", "the deck ends before this", NULL},
};

/* A character no token begins with. */
static void wrong_character(struct builder *b, struct span at)
{
    size_t offset = source_offset(b->source, at.from);
    char c = offset < b->source->len ? b->source->text[offset] : 0;
    if (c == '\t') {
        diag_error_in(b->diags, at, "E-tab", "a tab cannot indent; use spaces");
    } else {
        diag_error_in(b->diags, at, "E-yaml", "a value cannot begin with '%c'", c);
        diag_hint(b->diags, "put the text into quotes");
    }
}

/* What libyaml stopped at. */
static void tell_syntax(struct builder *b)
{
    const yaml_parser_t *p = &b->parser;
    if (p->error == YAML_MEMORY_ERROR) arena_take(b->pool->arena, SIZE_MAX, 2); /* says so and ends */
    struct span at = between(b, p->problem_mark, p->problem_mark);
    const char *problem = p->problem ? p->problem : "not YAML";
    if (!strcmp(problem, "found character that cannot start any token")) {
        wrong_character(b, at);
        return;
    }
    bool key = strstr(problem, "not allowed in this context") || strstr(problem, "expected ':'");
    if (key && tell_space(b, at.from.line)) return;
    const struct complaint *c = complaints, *end = complaints + sizeof complaints / sizeof *complaints;
    while (c < end && strcmp(c->problem, problem)) c++;
    diag_error_in(b->diags, at, c < end ? c->code : "E-yaml", "%s", c < end ? c->says : problem);
    if (c < end && c->note && p->context)
        diag_note_in(b->diags, between(b, p->context_mark, p->context_mark), "%s", c->note);
    if (key) diag_hint(b->diags, "a text that holds ': ' must be quoted; members of one map begin in the same column");
}

static bool next_event(struct builder *b, yaml_event_t *e)
{
    if (yaml_parser_parse(&b->parser, e)) return true;
    tell_syntax(b);
    return false;
}

/* ---- anchors and aliases ---- */

static struct anchor *find_anchor(struct builder *b, const char *name)
{
    for (int i = 0; i < b->anchors; i++)
        if (!strcmp(b->anchor[i].name, name)) return &b->anchor[i];
    return NULL;
}

/* Registers the anchor of an event, if it has one.  -1: no more of them; else its number + 1, 0: none. */
static int open_anchor(struct builder *b, const yaml_char_t *text, struct node *n, struct span at)
{
    const char *name = (const char *)text;
    if (!name) return 0;
    const struct anchor *first = find_anchor(b, name);
    if (first) {
        diag_error_in(b->diags, at, "E-anchor", "anchor '&%s' is given twice", diag_clip(b->diags, name));
        diag_note_in(b->diags, first->at, "first given here");
        return 0;
    }
    if (b->anchors == MAX_ANCHORS) {
        diag_error_in(b->diags, at, "E-limit-anchors", "more than %d anchors", MAX_ANCHORS);
        return -1;
    }
    if (!b->anchor) b->anchor = TAKE(b->pool->arena, struct anchor, MAX_ANCHORS);
    struct anchor *a = &b->anchor[b->anchors++];
    *a = (struct anchor){pool_text(b->pool, name, strlen(name)), n, at, true, b->pool->nodes};
    return b->anchors;
}

static void close_anchor(struct builder *b, int number)
{
    if (number <= 0) return;
    struct anchor *a = &b->anchor[number - 1];
    a->open = false;
    a->nodes = b->pool->nodes - a->nodes + 1;
}

/* A copy of what the anchor names; children stay shared until the whole is known to be small enough. */
static struct node *alias(struct builder *b, const yaml_event_t *e)
{
    const char *name = (const char *)e->data.alias.anchor;
    struct span at = event_span(b, e);
    struct node *n = pool_node(b->pool);
    *n = (struct node){.type = NODE_SCALAR, .file = b->file, .mark = at.from, .end = at.to, .text = "", .told = true};
    const struct anchor *a = find_anchor(b, name);
    if (!a || a->open) {
        diag_error_in(b->diags, at, "E-anchor",
                      a ? "alias '*%s' is inside of what it names" : "no anchor '&%s' before this alias",
                      diag_clip(b->diags, name));
        if (a) diag_note_in(b->diags, a->at, "it names this");
        return n;
    }
    if (b->aliases == MAX_ANCHORS) {
        diag_error_in(b->diags, at, "E-limit-anchors", "more than %d aliases", MAX_ANCHORS);
        return NULL;
    }
    if (!within(b, a->nodes, at) || !shallow(b, a->node->height, at)) return NULL;
    b->pool->nodes += a->nodes - 1;
    *n = *a->node;
    n->mark = at.from;
    n->end = at.to;
    n->key = NULL;
    if (!b->alias) b->alias = TAKE(b->pool->arena, struct node *, MAX_ANCHORS);
    b->alias[b->aliases++] = n;
    return n;
}

/* Gives every alias children of its own. */
static void part_aliases(struct builder *b)
{
    long nodes = b->pool->nodes; /* counted already */
    for (int i = 0; i < b->aliases; i++) {
        struct node *n = b->alias[i];
        if (n->count) n->item = pool_items(b->pool, n->item, n->count);
        for (int k = 0; k < n->count; k++) n->item[k] = tree_copy(b->pool, n->item[k], NULL);
    }
    b->pool->nodes = nodes;
}

/* ---- scalars, lists, maps ---- */

/* Of the tags only those that repeat what is known anyway. */
static void check_tag(struct builder *b, const yaml_char_t *text, struct span at)
{
    static const char *const fine[] = {"!", "str", "int", "float", "bool", "null", "map", "seq"};
    const char *tag = (const char *)text, *prefix = "tag:yaml.org,2002:";
    if (!tag) return;
    const char *rest = strncmp(tag, prefix, strlen(prefix)) ? tag : tag + strlen(prefix);
    for (size_t i = 0; i < sizeof fine / sizeof *fine; i++)
        if (!strcmp(rest, fine[i])) return;
    diag_error_in(b->diags, at, "E-tag", "a tag has no meaning in a deck: '%s'", diag_clip(b->diags, rest));
}

static struct node *scalar(struct builder *b, const yaml_event_t *e)
{
    const char *text = (const char *)e->data.scalar.value;
    size_t len = e->data.scalar.length;
    struct span at = event_span(b, e);
    struct node *n = pool_node(b->pool);
    bool plain = e->data.scalar.style == YAML_PLAIN_SCALAR_STYLE;
    if (len > MAX_SCALAR) {
        diag_error_in(b->diags, at, "E-limit-scalar", "a text of more than %d bytes", MAX_SCALAR);
        return NULL;
    }
    *n = (struct node){
        .type = NODE_SCALAR, .file = b->file, .mark = at.from, .end = at.to, .len = len, .quoted = !plain};
    n->text = pool_text(b->pool, text, len);
    if (e->data.scalar.tag) n->quoted |= strstr((const char *)e->data.scalar.tag, ":str") != NULL;
    if (strlen(n->text) != len) {
        diag_error_in(b->diags, at, "E-character", "a zero byte in a text");
        n->len = strlen(n->text);
        n->told = true;
    }
    return n;
}

/* Brackets opened less brackets closed. */
static int parentheses(const struct node *n)
{
    int open = 0;
    if (n->type != NODE_SCALAR || n->quoted) return 0;
    for (const char *p = n->text; *p; p++) open += (*p == '(') - (*p == ')');
    return open;
}

/* In a flow collection a comma has cut an expression in pieces: the first is told, those up to its ')' are dropped.
 * *open: brackets still open; a piece is a value and, in a map, a key before it. */
static bool is_piece(struct builder *b, int *open, struct node *n, int brackets)
{
    if (*open > 0) {
        *open += brackets;
        return true;
    }
    if (brackets <= 0) return false;
    *open = brackets;
    n->told = true;
    diag_error(b->diags, n, AT_VALUE, "E-comma", "'%s' has no ')'", diag_clip(b->diags, n->text));
    diag_hint(b->diags, "an expression with a comma must be quoted inside { } and [ ]");
    return false;
}

static struct node *build(struct builder *b, const yaml_event_t *e);

static bool close_collection(struct builder *b, struct node *n, int first)
{
    n->count = b->top - first;
    n->height = 1;
    n->item = pool_items(b->pool, b->stack + first, n->count);
    for (int i = 0; i < n->count; i++)
        if (n->item[i]->height >= n->height) n->height = n->item[i]->height + 1;
    b->top = first;
    return true;
}

static bool fill_list(struct builder *b, struct node *n)
{
    int first = b->top, open = 0;
    for (;;) {
        yaml_event_t e;
        if (!next_event(b, &e)) return false;
        bool last = e.type == YAML_SEQUENCE_END_EVENT;
        if (last) n->end = place(b, e.end_mark);
        struct node *item = last ? NULL : build(b, &e);
        yaml_event_delete(&e);
        if (last) return close_collection(b, n, first);
        if (!item) return false;
        if (!n->flow || !is_piece(b, &open, item, parentheses(item))) push(b, item);
    }
}

/* The key of a member; *fine = false: told, and the member is to be dropped.  NULL: no way on. */
static struct node *build_key(struct builder *b, const yaml_event_t *e, bool *fine)
{
    struct node *key = build(b, e);
    *fine = false;
    if (!key || key->told) return key;
    if (e->type != YAML_SCALAR_EVENT)
        diag_error(b->diags, key, AT_VALUE, "E-key", "expected a plain key, found %s",
                   e->type == YAML_ALIAS_EVENT ? "an alias" : node_type_name(key));
    else if (key->len == 0)
        diag_error(b->diags, key, AT_VALUE, "E-key", "a key is missing before ':'");
    else if (!key->quoted && !strcmp(key->text, "<<"))
        diag_error(b->diags, key, AT_VALUE, "E-merge", "'<<' is not read in decks");
    else
        *fine = true;
    return key;
}

/* A key is kept in its value's node; its own, the last one made, is free again. */
static void give_back(struct pool *pool, const struct node *key)
{
    if (key != pool->node - 1) return;
    pool->node--;
    pool->left++;
    pool->nodes--;
}

static void set_key(struct node *n, const struct node *key)
{
    n->key = key->text;
    n->key_mark = key->mark;
    n->key_end = key->end;
}

/* {a: 1, b:2} holds a key "b:2" without value. */
static bool joined(struct builder *b, const struct node *key, const struct node *value)
{
    if (key->quoted || value->type != NODE_SCALAR || value->quoted || value->len || !lacks_space(key->text, key->len))
        return false;
    diag_error(b->diags, key, AT_VALUE, "E-colon", "a space is missing after ':' in '%s'",
               diag_clip(b->diags, key->text));
    return true;
}

/* One member after its key's event: 1 to go on, 0 to give up. */
static bool member(struct builder *b, struct node *map, const yaml_event_t *key_event, int *open)
{
    yaml_event_t e;
    bool fine;
    const struct node *made = build_key(b, key_event, &fine);
    if (!made || !next_event(b, &e)) return false;
    struct node key = *made;
    if (fine && !key_event->data.scalar.anchor) give_back(b->pool, made);
    struct node *value = build(b, &e);
    yaml_event_delete(&e);
    if (!value) return false;
    if (map->flow && *open > 0) {
        is_piece(b, open, value, parentheses(&key) + parentheses(value));
        return true;
    }
    if (!fine || (map->flow && joined(b, &key, value))) return true;
    if (map->flow) is_piece(b, open, value, parentheses(value));
    set_key(value, &key);
    push(b, value);
    return true;
}

static bool fill_map(struct builder *b, struct node *n)
{
    int first = b->top, open = 0;
    for (;;) {
        yaml_event_t e;
        if (!next_event(b, &e)) return false;
        bool last = e.type == YAML_MAPPING_END_EVENT;
        if (last) n->end = place(b, e.end_mark);
        bool going = last || member(b, n, &e, &open);
        yaml_event_delete(&e);
        if (!going) return false;
        if (!last) continue;
        close_collection(b, n, first);
        tree_unique(n, b->diags, b->pool->arena);
        return true;
    }
}

/* A block ends where its last item does, not where the next token starts. */
static void end_block(struct node *n)
{
    if (!n->flow && n->count) n->end = n->item[n->count - 1]->end;
}

static struct node *collection(struct builder *b, const yaml_event_t *e, enum node_type type, bool flow)
{
    struct span at = event_span(b, e);
    struct node *n = pool_node(b->pool);
    *n = (struct node){.type = type, .file = b->file, .mark = at.from, .end = at.to, .flow = flow};
    if (!shallow(b, 1, at)) return NULL;
    b->depth++;
    bool map = type == NODE_MAP;
    int anchor = open_anchor(b, map ? e->data.mapping_start.anchor : e->data.sequence_start.anchor, n, at);
    if (anchor < 0 || !(map ? fill_map(b, n) : fill_list(b, n))) return NULL;
    close_anchor(b, anchor);
    b->depth--;
    end_block(n);
    return n;
}

static struct node *anchored_scalar(struct builder *b, const yaml_event_t *e)
{
    struct node *n = scalar(b, e);
    int anchor = n ? open_anchor(b, e->data.scalar.anchor, n, event_span(b, e)) : -1;
    if (anchor < 0) return NULL;
    close_anchor(b, anchor);
    return n;
}

/* The node that starts with an event.  NULL: told, no way on. */
static struct node *build(struct builder *b, const yaml_event_t *e)
{
    struct span at = event_span(b, e);
    if (!within(b, 1, at)) return NULL;
    switch (e->type) {
    case YAML_ALIAS_EVENT:
        return alias(b, e);
    case YAML_SCALAR_EVENT:
        check_tag(b, e->data.scalar.tag, at);
        return anchored_scalar(b, e);
    case YAML_SEQUENCE_START_EVENT:
        check_tag(b, e->data.sequence_start.tag, at);
        return collection(b, e, NODE_LIST, e->data.sequence_start.style == YAML_FLOW_SEQUENCE_STYLE);
    default:
        assert(e->type == YAML_MAPPING_START_EVENT);
        check_tag(b, e->data.mapping_start.tag, at);
        return collection(b, e, NODE_MAP, e->data.mapping_start.style == YAML_FLOW_MAPPING_STYLE);
    }
}

/* ---- documents ---- */

static bool expect(struct builder *b, yaml_event_type_t *type, struct span *at)
{
    yaml_event_t e;
    if (!next_event(b, &e)) return false;
    *type = e.type;
    *at = event_span(b, &e);
    yaml_event_delete(&e);
    return true;
}

static struct node *nothing(struct builder *b)
{
    struct node *n = pool_node(b->pool);
    *n = (struct node){.type = NODE_SCALAR, .file = b->file, .mark = {1, 1}, .end = {1, 1}, .text = ""};
    return n;
}

/* stream start, [document start, node, document end], stream end */
static struct node *document(struct builder *b)
{
    yaml_event_type_t type;
    struct span at;
    yaml_event_t e;
    if (!expect(b, &type, &at) || !expect(b, &type, &at)) return NULL;
    if (type == YAML_STREAM_END_EVENT) return nothing(b);
    if (!next_event(b, &e)) return NULL;
    struct node *root = build(b, &e);
    yaml_event_delete(&e);
    if (!root || !expect(b, &type, &at) || !expect(b, &type, &at)) return NULL;
    if (type != YAML_STREAM_END_EVENT) {
        diag_error_in(b->diags, at, "E-documents", "a second document; a deck is one");
        return NULL;
    }
    part_aliases(b);
    return root;
}

struct node *tree_parse(struct pool *pool, struct diags *diags, int file, size_t from)
{
    const struct source *s = diags_source(diags, file);
    struct builder b = {.pool = pool, .diags = diags, .file = file, .source = s, .from = from};
    b.shift = source_mark(s, from).col - 1;
    if (!yaml_parser_initialize(&b.parser)) arena_take(pool->arena, SIZE_MAX, 2); /* out of memory: says so and ends */
    yaml_parser_set_encoding(&b.parser, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&b.parser, (const unsigned char *)s->text + from, s->len - from);
    struct node *root = document(&b);
    yaml_parser_delete(&b.parser);
    return root;
}
