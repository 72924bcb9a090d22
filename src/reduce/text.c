/* text.c -- see text.h */
#include "reduce/text.h"

#include <errno.h>
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static enum status read_all(struct text *o, FILE *file, struct arena *life)
{
    struct stat about;
    if (fstat(fileno(file), &about) != 0 || !S_ISREG(about.st_mode))
        return fail(o->report, E_FILE, "%s: not a plain file", o->path);
    size_t size = (size_t)about.st_size;
    char *bytes = TAKE(life, char, size + 1);
    if (fread(bytes, 1, size, file) != size || ferror(file))
        return fail(o->report, E_FILE, "%s: cannot be read whole", o->path);
    o->next = bytes;
    o->end = bytes + size;
    for (const char *p = bytes; p < o->end && (p = memchr(p, '\n', (size_t)(o->end - p))); p++) o->lines++;
    o->lines += size && o->end[-1] != '\n';
    return OK;
}

enum status text_open(struct text *o, const char *path, struct arena *life, struct report *report)
{
    *o = (struct text){.path = path, .report = report};
    FILE *file = file_or_end(path, "rb");
    if (!file) return fail(report, E_FILE, "%s: %s", path, strerror(errno));
    enum status status = read_all(o, file, life);
    fclose(file);
    if (status == OK && o->end > o->next && memchr(o->next, 0, (size_t)(o->end - o->next)))
        return fail(report, E_DECK, "%s: error: not a text: it holds zero bytes", path);
    return status;
}

char *text_line(struct text *o)
{
    if (o->next >= o->end) return NULL;
    char *line = o->next, *stop = memchr(line, '\n', (size_t)(o->end - line));
    if (!stop) stop = o->end;
    o->next = stop + 1;
    o->line++;
    if (stop > line && stop[-1] == '\r') stop--;
    *stop = 0;
    return line;
}

enum status text_bad(const struct text *o, const char *format, ...)
{
    char words[700];
    va_list args;
    va_start(args, format);
    vsnprintf(words, sizeof words, format, args);
    va_end(args);
    return fail(o->report, E_DECK, "%.200s:%d: error: %s", o->path, o->line, words);
}

static char *past_blanks(char *at)
{
    return at + strspn(at, " \t");
}

bool word_int(char **at, int *value)
{
    char *start = past_blanks(*at), *end;
    errno = 0;
    long x = strtol(start, &end, 10);
    if (end == start || errno || x > INT_MAX || x < INT_MIN || !strchr(" \t,.", *end)) return false;
    *value = (int)x;
    *at = end;
    return true;
}

bool word_real(char **at, double *value)
{
    char *start = past_blanks(*at), *end;
    double x = strtod(start, &end);
    if (end == start || !strchr(" \t,", *end) || strcspn(start, "xX") < (size_t)(end - start)) return false;
    *value = x;
    *at = end;
    return true;
}

bool word_mark(char **at, char mark)
{
    char *start = past_blanks(*at);
    if (*start != mark) return false;
    *at = start + 1;
    return true;
}

bool word_end(char *at)
{
    return *past_blanks(at) == 0;
}
