/* scan.c -- words and signs of the text of an expression. */
#include <string.h>

#include "expr/parse_parts.h"

bool scan_is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

bool scan_is_digit(char c)
{
    return c >= '0' && c <= '9';
}

char scan_next(struct parser *p)
{
    while (p->text[p->at] == ' ' || p->text[p->at] == '\t' || p->text[p->at] == '\n' || p->text[p->at] == '\r') p->at++;
    return p->text[p->at];
}

bool scan_accept(struct parser *p, char c)
{
    if (scan_next(p) != c) return false;
    p->at++;
    return true;
}

size_t scan_name(const char *text)
{
    size_t n = 0;
    if (!scan_is_letter(text[0])) return 0;
    while (scan_is_letter(text[n]) || scan_is_digit(text[n]) || (text[n] == '.' && scan_is_letter(text[n + 1]))) n++;
    return n;
}

bool scan_word(struct parser *p, const char *word)
{
    scan_next(p);
    size_t n = scan_name(p->text + p->at);
    if (n != strlen(word) || strncmp(p->text + p->at, word, n)) return false;
    p->at += n;
    return true;
}

const char *scan_found(struct parser *p, size_t *length)
{
    const char *here = p->text + p->at;
    size_t n = scan_name(here);
    *length = 1;
    if (!*here) return "the end";
    if (!n) n = scan_is_digit(*here) ? strspn(here, "0123456789.") : 1;
    while (((unsigned char)here[n] & 0xc0) == 0x80) n++; /* the whole of a UTF-8 character */
    *length = n;
    return arena_print(p->arena, "'%.*s'", (int)(n < 40 ? n : 40), here);
}

size_t scan_relation(struct parser *p, enum op *op)
{
    static const struct {
        char text[3];
        enum op op;
    } relations[] = {{"<=", OP_LE}, {">=", OP_GE}, {"==", OP_EQ}, {"!=", OP_NE}, {"<", OP_LT}, {">", OP_GT}};
    scan_next(p);
    for (size_t i = 0; i < sizeof relations / sizeof *relations; i++) {
        size_t n = strlen(relations[i].text);
        *op = relations[i].op;
        if (!strncmp(p->text + p->at, relations[i].text, n)) return n;
    }
    return 0;
}
