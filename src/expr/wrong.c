/* wrong.c -- what is wrong with the text of an expression, where, and what may have been meant. */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "expr/parse_parts.h"

enum made parse_wrong(struct parser *p, size_t offset, size_t length, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(p->error->text, sizeof p->error->text, format, args);
    va_end(args);
    p->error->offset = offset;
    p->error->length = length ? length : 1;
    return FAILED;
}

void parse_hint(struct parser *p, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(p->error->hint, sizeof p->error->hint, format, args);
    va_end(args);
}

enum made parse_expected(struct parser *p, const char *what)
{
    enum op op;
    size_t length, n = scan_relation(p, &op);
    const char *here = scan_found(p, &length);
    char c = p->text[p->at];
    if (n && !p->condition) return parse_wrong(p, p->at, n, "a comparison belongs into the condition of if(c, a, b)");
    parse_wrong(p, p->at, length, "expected %s, found %s", what, here);
    if (c == '?' || c == ':') parse_hint(p, "write if(c, a, b)");
    if (c == ',') parse_hint(p, "a decimal point is '.'");
    if (c == '*') parse_hint(p, "a power is written '^'");
    return FAILED;
}

enum made parse_unknown_function(struct parser *p, size_t start, const char *name)
{
    const char *names[64];
    int n = 0;
    for (const struct expr_function *f = expr_functions; f->name && n < 60; f++) names[n++] = f->name;
    names[n++] = "if";
    const char *near = text_nearest(name, names, n);
    parse_wrong(p, start, strlen(name), "unknown function '%.60s'", name);
    if (near) parse_hint(p, "did you mean '%s'?", near);
    return FAILED;
}

enum made parse_arity(struct parser *p, const struct expr_function *f, size_t start, int n)
{
    return parse_wrong(p, start, strlen(f->name), "'%s' takes %d%s argument%s, found %d", f->name, f->nmin,
                       f->nmax > f->nmin ? " or more" : "", f->nmin == 1 ? "" : "s", n);
}
