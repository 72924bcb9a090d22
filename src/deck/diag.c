/* diag.c -- see diag.h */
#include "deck/diag.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/text.h"

enum level { ERROR, WARNING, TIP, LEVELS, NOTE = LEVELS };
enum { KEPT = 1000, TEXT = 600, WIDTH = 100, PLACES = 1 << 10, COMPARED = 300000 };

struct diag {
    enum level level;
    struct span at;
    const char *code, *text, *format;
    const struct scope *scope;
    int order, next;               /* next: of the same place in the table, -1: none */
    struct diag *note, *last_note; /* further places */
    const char *hints;             /* lines */
};

struct diags {
    struct arena *arena;
    int nsource, source_capacity;
    const struct source **source;
    int n, count[LEVELS]; /* messages kept; all, by level */
    int usage;            /* errors in options of the command line */
    int compared;         /* words, for suggestions: there is an end to it */
    bool limit;
    struct diag *item[KEPT];
    struct diag *last; /* NULL: the last one was not kept */
    int first[PLACES]; /* 1 + the newest message by the hash of its place; 0: none */
};

struct diags *diags_open(struct arena *arena)
{
    struct diags *d = TAKE(arena, struct diags, 1);
    d->arena = arena;
    return d;
}

int diags_add_source(struct diags *d, const struct source *s)
{
    d->source = arena_more(d->arena, d->source, d->nsource, &d->source_capacity, sizeof *d->source);
    d->source[d->nsource] = s;
    return d->nsource++;
}

const struct source *diags_source(const struct diags *d, int file)
{
    return file >= 0 && file < d->nsource ? d->source[file] : NULL;
}

/* ---- adding ---- */

struct span diag_span(const struct node *at, enum diag_at which)
{
    if (which == AT_KEY && at->key && at->key_mark.line) return (struct span){at->file, at->key_mark, at->key_end};
    return (struct span){at->file, at->mark, at->end};
}

static bool same_mark(struct mark a, struct mark b)
{
    return a.line == b.line && a.col == b.col;
}

static unsigned hash(const struct span *at)
{
    return ((unsigned)at->from.line * 40503u + (unsigned)at->from.col * 97u + (unsigned)at->file) % PLACES;
}

/* The same words at the same place, or for a further copy of a repeat, have been said. */
static bool said(const struct diags *d, const struct diag *x)
{
    for (int i = d->first[hash(&x->at)] - 1; i >= 0; i = d->item[i]->next) {
        const struct diag *y = d->item[i];
        if (y->at.file != x->at.file || !same_mark(y->at.from, x->at.from) || strcmp(x->code, y->code)) continue;
        if (y->format == x->format && y->scope != x->scope) return true;
        if (!strcmp(x->text, y->text)) return true;
    }
    return false;
}

/* An end of text behind the last line is shown as the end of the last line. */
static struct span inside(const struct diags *d, struct span at)
{
    const struct source *s = diags_source(d, at.file);
    if (!s || at.from.line <= s->lines) return at;
    at.from = at.to = source_mark(s, source_line_end(s, s->lines));
    return at;
}

static struct diag *make(struct diags *d, enum level level, struct span at, const char *format, va_list args)
{
    char text[TEXT];
    vsnprintf(text, sizeof text, format, args);
    struct diag *x = TAKE(d->arena, struct diag, 1);
    *x = (struct diag){.level = level, .at = inside(d, at), .format = format};
    x->text = arena_copy(d->arena, text, strlen(text));
    return x;
}

static bool by_option(const struct diags *d, int file)
{
    const struct source *s = diags_source(d, file);
    return s && s->option;
}

static void add(struct diags *d, enum level level, struct span at, const struct scope *scope, const char *code,
                const char *format, va_list args)
{
    int *count = &d->count[level];
    d->last = NULL;
    if (!strncmp(code, "E-limit", 7)) d->limit = true;
    if (d->n == KEPT) {
        ++*count;
        return;
    }
    struct arena_mark mark = arena_mark(d->arena);
    struct diag *x = make(d, level, at, format, args);
    x->code = code;
    x->scope = scope;
    if (said(d, x)) {
        arena_rewind(d->arena, mark);
        return;
    }
    ++*count;
    d->usage += level == ERROR && by_option(d, at.file);
    int *first = &d->first[hash(&x->at)];
    x->order = d->n;
    x->next = *first - 1;
    *first = d->n + 1;
    d->item[d->n++] = d->last = x;
}

#define WITH_ARGS(format, call)                                                                                        \
    do {                                                                                                               \
        va_list args;                                                                                                  \
        va_start(args, format);                                                                                        \
        call;                                                                                                          \
        va_end(args);                                                                                                  \
    } while (0)

void diag_error(struct diags *d, const struct node *at, enum diag_at which, const char *code, const char *format, ...)
{
    WITH_ARGS(format, add(d, ERROR, diag_span(at, which), at->scope, code, format, args));
}

void diag_warn(struct diags *d, const struct node *at, enum diag_at which, const char *code, const char *format, ...)
{
    WITH_ARGS(format, add(d, WARNING, diag_span(at, which), at->scope, code, format, args));
}

void diag_tip(struct diags *d, const struct node *at, enum diag_at which, const char *code, const char *format, ...)
{
    WITH_ARGS(format, add(d, TIP, diag_span(at, which), at->scope, code, format, args));
}

void diag_error_in(struct diags *d, struct span at, const char *code, const char *format, ...)
{
    WITH_ARGS(format, add(d, ERROR, at, NULL, code, format, args));
}

static void add_note(struct diags *d, struct span at, const char *format, va_list args)
{
    if (!d->last) return;
    struct diag *x = make(d, NOTE, at, format, args);
    if (d->last->last_note)
        d->last->last_note->note = x;
    else
        d->last->note = x;
    d->last->last_note = x;
}

void diag_note(struct diags *d, const struct node *at, enum diag_at which, const char *format, ...)
{
    WITH_ARGS(format, add_note(d, diag_span(at, which), format, args));
}

void diag_note_in(struct diags *d, struct span at, const char *format, ...)
{
    WITH_ARGS(format, add_note(d, at, format, args));
}

void diag_hint(struct diags *d, const char *format, ...)
{
    char text[TEXT];
    if (!d->last) return;
    WITH_ARGS(format, vsnprintf(text, sizeof text, format, args));
    const char *before = d->last->hints;
    d->last->hints = arena_print(d->arena, "%s%s%s", before ? before : "", before ? "\n" : "", text);
}

void diag_foreign(struct diags *d, const char *word)
{
    unsigned c;
    for (const char *p = word, *end = word + strlen(word); p < end; p++)
        if ((unsigned char)*p >= 0x80 && text_character(&c, p, end)) {
            diag_hint(d, "it holds the letter U+%04X, which is not of a-z", c);
            return;
        }
}

bool diag_may_suggest(struct diags *d, int n)
{
    if (!d->last || d->compared > COMPARED) return false;
    d->compared += n;
    return true;
}

const char *diag_clip(struct diags *d, const char *text)
{
    size_t n = 0, chars = 0;
    for (; text[n] && chars < 40; chars++)
        for (n++; ((unsigned char)text[n] & 0xc0) == 0x80;) n++;
    return text[n] ? arena_print(d->arena, "%.*s...", (int)n, text) : text;
}

enum status diags_status(const struct diags *d)
{
    return d->limit ? E_LIMIT : !d->count[ERROR] ? OK : d->usage == d->count[ERROR] ? E_USAGE : E_DECK;
}

int diags_errors(const struct diags *d)
{
    return d->count[ERROR];
}

bool diags_full(const struct diags *d)
{
    return d->count[ERROR] >= KEPT;
}

const char *diags_first(const struct diags *d)
{
    for (int i = 0; i < d->n; i++)
        if (d->item[i]->level == ERROR) return d->item[i]->text;
    return NULL;
}

int diags_warnings(const struct diags *d)
{
    return d->count[WARNING];
}

/* ---- printing ---- */

static bool inside_character(const struct source *s, size_t offset)
{
    return offset < s->len && ((unsigned char)s->text[offset] & 0xc0) == 0x80;
}

/* The part of a long line that is shown: from is moved back from the caret's place, to is not beyond WIDTH. */
static void window(const struct source *s, size_t *from, size_t *to, size_t caret)
{
    if (caret - *from > WIDTH / 2 && *to - *from > WIDTH) *from = caret - WIDTH / 2;
    while (*from < caret && inside_character(s, *from)) ++*from;
    if (*to - *from > WIDTH) *to = *from + WIDTH;
    while (*to > caret && inside_character(s, *to)) --*to;
}

/* The line and the caret below it. */
static void put_line(FILE *to, const struct source *s, const struct span *at, bool color)
{
    size_t start = s->line[at->from.line - 1], stop = source_line_end(s, at->from.line);
    size_t caret = source_offset(s, at->from), from = start, until = stop;
    if (caret > stop) caret = stop;
    size_t last = at->to.line == at->from.line ? source_offset(s, at->to) : stop;
    window(s, &from, &until, caret);
    char out[16], under[8 * WIDTH];
    int columns, n = 0;
    fprintf(to, "%5d | %s", at->from.line, from > start ? "..." : "");
    if (from > start) n += sprintf(under, "   ");
    for (size_t p = from; p < until;) {
        size_t here = p;
        if (s->text[p] == '\t')
            strcpy(out, " "), columns = 1, p++;
        else
            p += text_shown(out, &columns, s->text + p, s->text + until);
        fputs(out, to);
        if (here >= last && here > caret) continue;
        for (int i = 0; i < columns; i++) under[n++] = here < caret ? ' ' : here == caret && i == 0 ? '^' : '~';
    }
    if (caret >= until) under[n++] = '^';
    while (n > 0 && under[n - 1] == ' ') n--;
    fprintf(to, "%s\n      | %s%.*s%s\n", until < stop ? "..." : "", color ? "\033[32m" : "", n, under,
            color ? "\033[0m" : "");
}

static void put_hints(FILE *to, const char *hints)
{
    for (const char *p = hints; p && *p;) {
        const char *end = strchrnul(p, '\n');
        char line[TEXT + 1];
        snprintf(line, sizeof line, "%.*s", (int)(end - p), p);
        fputs("      | ", to);
        text_put(to, line);
        fputc('\n', to);
        p = *end ? end + 1 : end;
    }
}

static void put_diag(FILE *to, const struct diags *d, const struct diag *x, bool color)
{
    static const char *const words[] = {"error", "warning", "hint", "note"}, *const colors[] = {"\033[31m", "\033[35m",
                                                                                                "\033[36m", "\033[36m"};
    const struct source *s = diags_source(d, x->at.file);
    const bool placed = s && !s->option && x->at.from.line;
    if (s) text_put(to, s->path);
    if (placed) fprintf(to, ":%d:%d", x->at.from.line, x->at.from.col);
    fprintf(to, "%s%s%s%s: ", s ? ": " : "", color ? colors[x->level] : "", words[x->level], color ? "\033[0m" : "");
    text_put(to, x->text);
    if (x->code) fprintf(to, " [%s]", x->code);
    fputc('\n', to);
    if (placed) put_line(to, s, &x->at, color);
    put_hints(to, x->hints);
    if (x->note) put_diag(to, d, x->note, color);
}

static int by_place(const void *a, const void *b)
{
    const struct diag *x = *(struct diag *const *)a, *y = *(struct diag *const *)b;
    if (x->at.file != y->at.file) return x->at.file < y->at.file ? -1 : 1;
    if (x->at.from.line != y->at.from.line) return x->at.from.line < y->at.from.line ? -1 : 1;
    if (x->at.from.col != y->at.from.col) return x->at.from.col < y->at.from.col ? -1 : 1;
    return x->order < y->order ? -1 : 1;
}

static void put_more(FILE *to, int n, const char *what)
{
    if (n > 0) fprintf(to, "and %d more %s%s\n", n, what, n == 1 ? "" : "s");
}

void diags_print(FILE *to, const struct diags *d, bool color)
{
    struct diag *sorted[KEPT];
    int shown[LEVELS] = {0};
    if (d->n) memcpy(sorted, d->item, (size_t)d->n * sizeof *sorted);
    qsort(sorted, (size_t)d->n, sizeof *sorted, by_place);
    for (int i = 0; i < d->n; i++)
        if (shown[sorted[i]->level]++ < DIAGS_SHOWN) put_diag(to, d, sorted[i], color);
    put_more(to, d->count[ERROR] - DIAGS_SHOWN, "error");
    if (diags_full(d)) fprintf(to, "after %d errors the rest of the deck was not looked at\n", KEPT);
    put_more(to, d->count[WARNING] - DIAGS_SHOWN, "warning");
    put_more(to, d->count[TIP] - DIAGS_SHOWN, "hint");
}
