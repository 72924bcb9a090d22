/* syntax.c -- what libyaml stopped at, in words a user of decks can act on.
 *
 * libyaml knows where it stopped and where the construct began, not what was meant; the commonest slips (a space
 * missing after ':', a tab, a bracket left open) are found again in the text and reported where they are. */
#include "deck/syntax.h"

#include <stdint.h>
#include <string.h>

static struct mark place(const struct syntax *b, yaml_mark_t m)
{
    return (struct mark){(int)m.line + 1, (int)m.column + 1 + (m.line == 0 ? b->shift : 0)};
}

struct span syntax_span(const struct syntax *b, yaml_mark_t from, yaml_mark_t to)
{
    return (struct span){b->file, place(b, from), place(b, to)};
}

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
bool syntax_lacks_space(const char *text, size_t len)
{
    const char *colon = memchr(text, ':', len);
    return colon && colon > text && colon + 1 < text + len && !strchr(" \t\r\n/", colon[1]) &&
           !memchr(text, ' ', (size_t)(colon - text));
}

bool syntax_opens(const char *text)
{
    const size_t name = strcspn(text, ": \t\r\n");
    return name && text[name] == ':' && (text[name + 1] == '{' || text[name + 1] == '[');
}

/* The same where it stands, in the line that libyaml stopped in. */
static bool report_opening(const struct syntax *b, int line)
{
    if (line < 1 || line > b->source->lines) return false;
    size_t start = b->source->line[line - 1];
    while (b->source->text[start] == ' ') start++;
    if (!syntax_opens(b->source->text + start)) return false;
    const size_t end = start + strcspn(b->source->text + start, ":") + 2;
    struct span at = {b->file, source_mark(b->source, start), source_mark(b->source, end)};
    diag_error_in(b->diags, at, "E-colon", "a space is missing after ':' in '%.*s'", (int)(end - start),
                  b->source->text + start);
    return true;
}

/* A key where none can be mostly means that the line above lacks a space: that line is reported. */
static bool report_space(const struct syntax *b, int line)
{
    size_t end, start = line_above(b->source, line, &end);
    if (end <= start || !syntax_lacks_space(b->source->text + start, end - start)) return false;
    struct span at = {b->file, source_mark(b->source, start), source_mark(b->source, end)};
    const char *text =
        arena_print(b->arena, "%.*s", (int)(end - start < 200 ? end - start : 200), b->source->text + start);
    diag_error_in(b->diags, at, "E-colon", "a space is missing after ':' in '%s'", diag_clip(b->diags, text));
    return true;
}

struct complaint {
    const char *problem, *code, *says, *note;
    bool at_opening; /* the mistake is where the construct began; note: what is here */
};

static const struct complaint complaints[] = {
    {"did not find expected ',' or ']'", "E-unclosed", "expected ',' or ']'", "the list is opened here", false},
    {"did not find expected ',' or '}'", "E-unclosed", "expected ',' or '}'", "the map is opened here", false},
    {"found unexpected end of stream", "E-unclosed", "this quote is not closed", "the text ends here", true},
    {"found unexpected document indicator", "E-unclosed", "this quote is not closed", "'---' or '...' ends the text",
     true},
    {"found unexpected ':'", "E-colon", "a space is missing after ':'", NULL, false},
    {"did not find expected key", "E-indent", "expected a key of the map around it", "the map begins here", false},
    {"did not find expected '-' indicator", "E-indent", "expected '-', the next item of the list around it",
     "the list begins here", false},
    {"block sequence entries are not allowed in this context", "E-indent", "a list cannot begin here", NULL, false},
    {"mapping values are not allowed in this context", "E-yaml", "a key cannot stand here", NULL, false},
    {"mapping keys are not allowed in this context", "E-yaml", "a key cannot stand here", NULL, false},
    {"could not find expected ':'", "E-yaml", "expected ':' after a key", "the key is here", false},
    {"found a tab character that violates indentation", "E-tab", "a tab cannot indent; use spaces", NULL, false},
    {"found a tab character where an indentation space is expected", "E-tab", "a tab cannot indent; use spaces", NULL,
     false},
    {"found incompatible YAML document", "E-yaml", "only YAML 1.1 and 1.2 are read", NULL, false},
    {"found invalid Unicode character escape code", "E-yaml", "this escape is no character", NULL, false},
    {"did not find expected node content", "E-yaml", "expected a value", NULL, false},
    {"found unknown escape character", "E-yaml", "unknown escape in a text in double quotes", NULL, false},
    {"did not find expected <document start>", "E-yaml", "the deck ends before this", NULL, false},
};

/* A character no token begins with. */
static void wrong_character(const struct syntax *b, struct span at)
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
void syntax_report(const struct syntax *b, const yaml_parser_t *p)
{
    if (p->error == YAML_MEMORY_ERROR) memory_ended();
    struct span at = syntax_span(b, p->problem_mark, p->problem_mark);
    const char *problem = p->problem ? p->problem : "not YAML";
    if (!strcmp(problem, "found character that cannot start any token")) {
        wrong_character(b, at);
        return;
    }
    bool key = strstr(problem, "not allowed in this context") || strstr(problem, "find expected ':'");
    if (key && (report_opening(b, at.from.line) || report_space(b, at.from.line))) return;
    const struct complaint *c = complaints, *end = complaints + sizeof complaints / sizeof *complaints;
    while (c < end && strcmp(c->problem, problem)) c++;
    struct span other = syntax_span(b, p->context_mark, p->context_mark);
    if (c < end && c->at_opening && p->context) {
        const struct span here = at;
        at = other;
        other = here;
    }
    diag_error_in(b->diags, at, c < end ? c->code : "E-yaml", "%s", c < end ? c->says : problem);
    if (c < end && c->note && p->context) diag_note_in(b->diags, other, "%s", c->note);
    if (key) diag_hint(b->diags, "a text that holds ': ' must be quoted; members of one map begin in the same column");
}
