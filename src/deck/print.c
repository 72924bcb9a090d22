/* print.c -- the tree as YAML that reads back to the same tree. */
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "deck/stages.h"

/* Shortest of 15 to 17 digits; with a point and a signed exponent, without which YAML 1.1 takes it for text. */
const char *number_text(char out[40], double x)
{
    char digits[32];
    for (int precision = 15; precision <= 17; precision++) {
        snprintf(digits, sizeof digits, "%.*g", precision, x);
        if (strtod(digits, NULL) == x) break;
    }
    char *e = strchr(digits, 'e');
    if (!e || strchr(digits, '.'))
        snprintf(out, 40, "%s", digits);
    else
        snprintf(out, 40, "%.*s.0%s", (int)(e - digits), digits, e);
    return out;
}

static bool is_word(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/* Can it stand without quotes, in a map in braces too? */
static bool safe(const char *text)
{
    size_t n = strlen(text);
    if (n == 0 || (!is_word(*text) && !strchr("+-.(/", *text)) || text[n - 1] == ' ') return false;
    if (*text == '-' && !is_word(text[1]) && text[1] != '(' && text[1] != '.') return false;
    if (!strncmp(text, "...", 3)) return false;
    for (const char *p = text; *p; p++)
        if (!is_word(*p) && !strchr("+-*/^().$=<> ", *p)) return false;
    return true;
}

static void put_quoted(FILE *to, const char *text, size_t len)
{
    fputc('"', to);
    for (const char *p = text, *end = text + len; p < end;) {
        unsigned c;
        size_t n = text_character(&c, p, end); /* never 0: the text has been checked */
        if (c == '"' || c == '\\')
            fprintf(to, "\\%c", (char)c);
        else if (text_hidden(c) || (c >= 0xfffe && c <= 0xffff))
            fprintf(to, c < 0x100 ? "\\x%02x" : "\\u%04x", c);
        else
            fwrite(p, 1, n, to);
        p += n;
    }
    fputc('"', to);
}

static void put_text(FILE *to, const char *text, bool quoted)
{
    if (!quoted && safe(text))
        fputs(text, to);
    else
        put_quoted(to, text, strlen(text));
}

/* ---- formulas: loop variables are gone in what is printed, so their values stand in their place ---- */

static const struct scope *in_scope(const struct scope *s, const char *name, size_t len)
{
    while (s && (strncmp(s->name, name, len) || s->name[len])) s = s->up;
    return s;
}

static void put_formula(FILE *to, const struct node *n)
{
    enum { LONGEST = 42 };
    char number[40], *text = memory_or_end(LONGEST * strlen(n->text) + 1), *end = text;
    for (const char *p = n->text; *p;) {
        size_t len = 0;
        while (is_word(p[len]) || (len && p[len] == '.')) len++;
        const struct scope *s = len ? in_scope(n->scope, p, len) : NULL;
        if (!len) len = 1;
        if (s)
            end += sprintf(end, s->value < 0 ? "(%s)" : "%s", number_text(number, s->value));
        else
            end = (char *)memcpy(end, p, len) + len;
        p += len;
    }
    *end = 0;
    put_text(to, text, n->quoted);
    free(text);
}

/* ---- nodes ---- */

static void put_scalar(FILE *to, const struct node *n)
{
    char number[40];
    if (n->has_value)
        fputs(number_text(number, n->value), to);
    else if (n->formula)
        put_formula(to, n);
    else if (node_is_null(n))
        fputs("null", to);
    else
        put_text(to, n->text, n->quoted);
}

/* A key; very long ones need a mark of their own in YAML. */
static void put_key(FILE *to, const char *key, const char *after)
{
    bool is_long = strlen(key) > 100;
    if (is_long) fputs("? ", to);
    put_text(to, key, node_is_null(&(struct node){.type = NODE_SCALAR, .text = key, .len = strlen(key)}));
    fputs(is_long ? after : ":", to);
}

static void put_flow(FILE *to, const struct node *n)
{
    if (n->type == NODE_SCALAR) {
        put_scalar(to, n);
        return;
    }
    fputc(n->type == NODE_MAP ? '{' : '[', to);
    for (int i = 0; i < n->count; i++) {
        if (i) fputs(", ", to);
        if (n->type == NODE_MAP) put_key(to, n->item[i]->key, " :"), fputc(' ', to);
        put_flow(to, n->item[i]);
    }
    fputc(n->type == NODE_MAP ? '}' : ']', to);
}

/* Maps of the first levels, and lists of lists or maps, go line by line. */
static bool is_block(const struct node *n, int level)
{
    if (n->count == 0 || level > 2) return false;
    if (n->type == NODE_MAP) return true;
    for (int i = 0; i < n->count; i++)
        if (n->item[i]->type != NODE_SCALAR) return true;
    return false;
}

static void put_block(FILE *to, const struct node *n, int level)
{
    char indent[8] = "      ";
    indent[2 * level] = 0;
    for (int i = 0; i < n->count; i++) {
        const struct node *x = n->item[i];
        char after[16];
        snprintf(after, sizeof after, "\n%s:", indent);
        fputs(indent, to);
        if (n->type == NODE_MAP)
            put_key(to, x->key, after);
        else
            fputc('-', to);
        bool block = n->type == NODE_MAP && is_block(x, level + 1);
        fputc(block ? '\n' : ' ', to);
        if (block) {
            put_block(to, x, level + 1);
        } else {
            put_flow(to, x);
            fputc('\n', to);
        }
    }
}

void deck_print(FILE *to, const struct deck *deck)
{
    if (deck->root->count)
        put_block(to, deck->root, 0);
    else
        fputs("{}\n", to);
}
