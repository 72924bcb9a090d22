/* text.c -- see text.h */
#include "base/text.h"

#include <string.h>
#include <strings.h>

enum { LONGEST = 63 };

static int least(int a, int b)
{
    return a < b ? a : b;
}

bool text_same(const char *a, const char *b)
{
    return a == b || (a && b && strcmp(a, b) == 0);
}

int text_distance(const char *a, const char *b)
{
    int la = (int)strnlen(a, LONGEST + 1), lb = (int)strnlen(b, LONGEST + 1);
    if (la > LONGEST || lb > LONGEST) return 2 * LONGEST;
    int d[LONGEST + 1][LONGEST + 1]; /* d[i][j]: distance of the first i and the first j letters */
    for (int i = 0; i <= la; i++) d[i][0] = i;
    for (int j = 0; j <= lb; j++) d[0][j] = j;
    for (int i = 1; i <= la; i++) {
        for (int j = 1; j <= lb; j++) {
            int change = d[i - 1][j - 1] + (a[i - 1] != b[j - 1]);
            d[i][j] = least(change, 1 + least(d[i - 1][j], d[i][j - 1]));
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d[i][j] = least(d[i][j], 1 + d[i - 2][j - 2]);
        }
    }
    return d[la][lb];
}

static bool is_component(char c)
{
    return c >= 'x' && c <= 'z';
}

bool text_components(const char *a, const char *b)
{
    const size_t n = strlen(a);
    return n > 1 && strlen(b) == n && strncmp(a, b, n - 1) == 0 && is_component(a[n - 1]) && is_component(b[n - 1]);
}

const char *text_nearest(const char *word, const char *const *words, int n)
{
    const char *nearest = NULL;
    int best = 2 * (2 + (int)strlen(word) / 4);
    for (int i = 0; i < n; i++) {
        const int distance = strcasecmp(word, words[i]) ? text_distance(word, words[i]) : 0;
        const int apart = 2 * distance - text_components(word, words[i]);
        if (distance > 1 && 2 * distance > (int)strlen(words[i])) continue; /* more of it is wrong than right */
        if (apart < best) {
            best = apart;
            nearest = words[i];
        }
    }
    return nearest;
}

bool text_match(const char *pattern, const char *name)
{
    const char *star = NULL, *from = NULL; /* the last '*' and where its run starts in name */
    while (*name) {
        if (*pattern == '*') {
            star = ++pattern;
            from = name;
        } else if (*pattern == '?' || *pattern == *name) {
            pattern++;
            name++;
        } else if (star) {
            pattern = star;
            name = ++from;
        } else {
            return false;
        }
    }
    while (*pattern == '*') pattern++;
    return *pattern == 0;
}

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool text_ends(const char *text, const char *end)
{
    const size_t n = strlen(text), m = strlen(end);
    return n > m && strcasecmp(text + n - m, end) == 0;
}

bool text_is_name(const char *text)
{
    if (!is_letter(*text)) return false;
    while (is_letter(*text) || (*text >= '0' && *text <= '9') || *text == '_') text++;
    return *text == 0;
}

/* ---- characters ---- */

size_t text_character(unsigned *code, const char *p, const char *end)
{
    const unsigned char *b = (const unsigned char *)p;
    static const unsigned least[] = {0, 0, 0x80, 0x800, 0x10000}; /* shorter forms exist below */
    if (p >= end) return 0;
    size_t n = b[0] < 0x80 ? 1 : b[0] < 0xc0 ? 0 : b[0] < 0xe0 ? 2 : b[0] < 0xf0 ? 3 : b[0] < 0xf8 ? 4 : 0;
    if (n == 0 || n > (size_t)(end - p)) return 0;
    *code = n == 1 ? b[0] : b[0] & (0x7fu >> n);
    for (size_t i = 1; i < n; i++) {
        if ((b[i] & 0xc0) != 0x80) return 0;
        *code = *code << 6 | (b[i] & 0x3fu);
    }
    bool surrogate = *code >= 0xd800 && *code < 0xe000;
    return *code < least[n] || *code > 0x10ffff || surrogate ? 0 : n;
}

/* Columns a character takes on a terminal: East Asian wide forms two, combining marks none. */
static int width(unsigned c)
{
    static const unsigned wide[][2] = {{0x1100, 0x115f},   {0x2e80, 0x303e},   {0x3041, 0xa4cf},  {0xac00, 0xd7a3},
                                       {0xf900, 0xfaff},   {0xfe30, 0xfe6f},   {0xff00, 0xff60},  {0xffe0, 0xffe6},
                                       {0x1f300, 0x1f64f}, {0x1f900, 0x1f9ff}, {0x20000, 0x3fffd}};
    if ((c >= 0x300 && c <= 0x36f) || c == 0x200b || (c >= 0xfe00 && c <= 0xfe0f)) return 0;
    for (size_t i = 0; i < sizeof wide / sizeof *wide; i++)
        if (c >= wide[i][0] && c <= wide[i][1]) return 2;
    return 1;
}

bool text_hidden(unsigned c)
{
    return c < 0x20 || (c >= 0x7f && c < 0xa0) || (c >= 0x200b && c <= 0x200f) || (c >= 0x2028 && c <= 0x202e) ||
           (c >= 0x2066 && c <= 0x2069) || c == 0x61c || c == 0xfeff;
}

size_t text_shown(char out[16], int *columns, const char *p, const char *end)
{
    unsigned c;
    size_t n = text_character(&c, p, end);
    if (n && !text_hidden(c)) {
        memcpy(out, p, n);
        out[n] = 0;
        *columns = width(c);
        return n;
    }
    if (n == 0 || c < 0x100)
        snprintf(out, 16, "\\x%02x", n ? c : (unsigned char)*p);
    else
        snprintf(out, 16, "\\u%04x", c);
    *columns = (int)strlen(out);
    return n ? n : 1;
}

void text_put(FILE *to, const char *text)
{
    char out[16];
    int columns;
    for (const char *p = text, *end = text + strlen(text); p < end;) {
        p += text_shown(out, &columns, p, end);
        fputs(out, to);
    }
}
