/* tree.c -- libyaml's events become nodes; see tree.h.
 *
 * Recursive, 64 deep at most.  NULL on the way up means that there is no way on; all else that is wrong is reported and
 * left out of the tree. */
#include "deck/tree.h"

#include <assert.h>
#include <stdint.h>
#include <string.h>

#include "deck/tree_parts.h"

struct span tree_span(const struct builder *b, const yaml_event_t *e)
{
    return syntax_span(&b->syntax, e->start_mark, e->end_mark);
}

bool tree_within(struct builder *b, long nodes, struct span at)
{
    if (b->pool->nodes + nodes <= MAX_NODES) return true;
    diag_error_in(b->diags, at, "E-limit-nodes", "the deck holds more than %d values", MAX_NODES);
    return false;
}

bool tree_shallow(struct builder *b, int height, struct span at)
{
    if (b->depth + height <= MAX_DEPTH) return true;
    diag_error_in(b->diags, at, "E-limit-depth", "lists and maps are nested more than %d deep", MAX_DEPTH);
    return false;
}

static void push(struct builder *b, struct node *n)
{
    b->stack = arena_more(b->pool->arena, b->stack, b->top, &b->capacity, sizeof *b->stack);
    b->stack[b->top++] = n;
}

static bool next_event(struct builder *b, yaml_event_t *e)
{
    if (yaml_parser_parse(&b->parser, e)) return true;
    syntax_report(&b->syntax, &b->parser);
    return false;
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
    struct span at = tree_span(b, e);
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
        n->reported = true;
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

static bool comma_follows(const struct builder *b, const struct node *n)
{
    const struct source *s = b->syntax.source;
    size_t at = source_offset(s, n->end);
    while (at < s->len && strchr(" \t\r\n", s->text[at])) at++;
    return at < s->len && s->text[at] == ',';
}

/* In a flow collection a comma has cut an expression in pieces: the first is reported, those up to its ')' are dropped.
 * *open: brackets still open; a piece is a value and, in a map, a key before it. */
static bool is_piece(struct builder *b, int *open, struct node *n, int brackets)
{
    if (*open > 0) {
        *open += brackets;
        return true;
    }
    if (brackets <= 0 || !comma_follows(b, n)) return false;
    *open = brackets;
    n->reported = true;
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
        if (last) n->end = tree_span(b, &e).to;
        struct node *item = last ? NULL : build(b, &e);
        yaml_event_delete(&e);
        if (last) return close_collection(b, n, first);
        if (!item) return false;
        if (!n->flow || !is_piece(b, &open, item, parentheses(item))) push(b, item);
    }
}

/* len: as much of the text as is shown. */
static void report_colon(struct builder *b, const struct node *key, size_t len)
{
    diag_error(b->diags, key, AT_VALUE, "E-colon", "a space is missing after ':' in '%s'",
               diag_clip(b->diags, pool_text(b->pool, key->text, len)));
}

/* The key of a member; *fine = false: reported, and the member is to be dropped.  NULL: no way on. */
static struct node *build_key(struct builder *b, const yaml_event_t *e, bool *fine)
{
    struct node *key = build(b, e);
    *fine = false;
    if (!key || key->reported) return key;
    if (e->type != YAML_SCALAR_EVENT)
        diag_error(b->diags, key, AT_VALUE, "E-key", "expected a plain key, found %s",
                   e->type == YAML_ALIAS_EVENT ? "an alias" : node_type_name(key));
    else if (key->len == 0)
        diag_error(b->diags, key, AT_VALUE, "E-key", "a key is missing before ':'");
    else if (!key->quoted && !strcmp(key->text, "<<"))
        diag_error(b->diags, key, AT_VALUE, "E-merge", "'<<' is not read in decks");
    else if (!key->quoted && syntax_opens(key->text))
        report_colon(b, key, strcspn(key->text, ":") + 2);
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
    if (key->quoted || value->type != NODE_SCALAR || value->quoted || value->len ||
        !syntax_lacks_space(key->text, key->len))
        return false;
    report_colon(b, key, key->len);
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
    if (!fine || (map->flow && joined(b, &key, value))) {
        map->reported = true; /* it lacks a member now: enough has been said */
        return true;
    }
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
        if (last) n->end = tree_span(b, &e).to;
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
    struct span at = tree_span(b, e);
    struct node *n = pool_node(b->pool);
    *n = (struct node){.type = type, .file = b->file, .mark = at.from, .end = at.to, .flow = flow};
    if (!tree_shallow(b, 1, at)) return NULL;
    b->depth++;
    bool map = type == NODE_MAP;
    int anchor = anchor_open(b, map ? e->data.mapping_start.anchor : e->data.sequence_start.anchor, n, at);
    if (anchor < 0 || !(map ? fill_map(b, n) : fill_list(b, n))) return NULL;
    anchor_close(b, anchor);
    b->depth--;
    end_block(n);
    return n;
}

static struct node *anchored_scalar(struct builder *b, const yaml_event_t *e)
{
    struct node *n = scalar(b, e);
    int anchor = n ? anchor_open(b, e->data.scalar.anchor, n, tree_span(b, e)) : -1;
    if (anchor < 0) return NULL;
    anchor_close(b, anchor);
    return n;
}

/* The node that starts with an event.  NULL: reported, no way on. */
static struct node *build(struct builder *b, const yaml_event_t *e)
{
    struct span at = tree_span(b, e);
    if (!tree_within(b, 1, at)) return NULL;
    if (e->type == YAML_ALIAS_EVENT) return alias_node(b, e);
    if (e->type == YAML_SCALAR_EVENT) {
        check_tag(b, e->data.scalar.tag, at);
        return anchored_scalar(b, e);
    }
    if (e->type == YAML_SEQUENCE_START_EVENT) {
        check_tag(b, e->data.sequence_start.tag, at);
        return collection(b, e, NODE_LIST, e->data.sequence_start.style == YAML_FLOW_SEQUENCE_STYLE);
    }
    assert(e->type == YAML_MAPPING_START_EVENT);
    check_tag(b, e->data.mapping_start.tag, at);
    return collection(b, e, NODE_MAP, e->data.mapping_start.style == YAML_FLOW_MAPPING_STYLE);
}

/* ---- documents ---- */

static bool expect(struct builder *b, yaml_event_type_t *type, struct span *at)
{
    yaml_event_t e;
    if (!next_event(b, &e)) return false;
    *type = e.type;
    *at = tree_span(b, &e);
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
    if (!expect(b, &type, &at)) return NULL;
    if (!expect(b, &type, &at)) return NULL;
    if (type == YAML_STREAM_END_EVENT) return nothing(b);
    if (!next_event(b, &e)) return NULL;
    struct node *root = build(b, &e);
    yaml_event_delete(&e);
    if (!root || !expect(b, &type, &at)) return NULL;
    if (!expect(b, &type, &at)) return NULL;
    if (type != YAML_STREAM_END_EVENT) {
        diag_error_in(b->diags, at, "E-documents", "a second document; a deck is one");
        return NULL;
    }
    aliases_part(b);
    return root;
}

struct node *tree_parse(struct pool *pool, struct diags *diags, int file, size_t from)
{
    const struct source *s = diags_source(diags, file);
    struct builder b = {.pool = pool, .diags = diags, .file = file};
    b.syntax = (struct syntax){diags, pool->arena, s, file, source_mark(s, from).col - 1};
    if (!yaml_parser_initialize(&b.parser)) memory_ended();
    yaml_parser_set_encoding(&b.parser, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&b.parser, (const unsigned char *)s->text + from, s->len - from);
    struct node *root = document(&b);
    yaml_parser_delete(&b.parser);
    return root;
}
