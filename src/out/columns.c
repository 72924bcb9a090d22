/* columns.c -- see columns.h */
#include "out/columns.h"

#include <assert.h>
#include <stdbool.h>
#include <string.h>

#include "base/text.h"

int columns_find(const struct column *all, int n, const char *name)
{
    for (int i = 0; i < n; i++)
        if (strcmp(all[i].name, name) == 0) return i;
    return -1;
}

static void choose(struct selection *to, bool *taken, int i)
{
    if (!taken[i]) to->index[to->n++] = i;
    taken[i] = true;
}

/* `pattern` with its text before the first wild card corrected, so that it matches one of all; NULL
 * if nothing is near. */
static const char *near_pattern(const char *pattern, const struct column *all, int n, struct arena *life)
{
    size_t head = strcspn(pattern, "*?");
    const char *nearest = NULL;
    int best = 2 * (2 + (int)head / 4);
    for (int i = 0; i < n; i++) {
        size_t length = strlen(all[i].name);
        for (size_t cut = head > 1 ? head - 1 : 1; cut <= head + 1 && cut <= length; cut++) {
            const char *word = arena_print(life, "%.*s", (int)cut, all[i].name);
            const char *wanted = arena_copy(life, pattern, head);
            const int distance = text_distance(word, wanted), apart = 2 * distance - text_components(word, wanted);
            if (distance > 1 && 2 * distance >= (int)head) continue; /* as much of it is wrong as right */
            const char *whole = arena_print(life, "%s%s", word, pattern + head);
            if (apart >= best || !text_match(whole, all[i].name)) continue;
            best = apart;
            nearest = whole;
        }
    }
    return nearest;
}

static const char *near_name(const char *pattern, const struct column *all, int n, struct arena *life)
{
    const char **names = TAKE(life, const char *, n);
    for (int i = 0; i < n; i++) names[i] = all[i].name;
    return text_nearest(pattern, names, n);
}

static enum status no_match(const char *pattern, const struct column *all, int n, enum status blame, struct arena *life,
                            struct report *report)
{
    struct arena_mark mark = arena_mark(life);
    bool wild = strpbrk(pattern, "*?") != NULL;
    const char *nearest = wild ? near_pattern(pattern, all, n, life) : near_name(pattern, all, n, life);
    enum status status = nearest ? fail(report, blame, "no column matches '%s'; did you mean '%s'?", pattern, nearest)
                                 : fail(report, blame, "no column matches '%s'", pattern);
    arena_rewind(life, mark);
    return status;
}

enum status columns_select(struct selection *to, const struct column *all, int n, const char *const *patterns,
                           int npatterns, enum status blame, struct arena *life, struct report *report)
{
    assert(n > 0);
    bool *taken = TAKE(life, bool, n);
    *to = (struct selection){.index = TAKE(life, int, n), .wrong = -1};
    choose(to, taken, 0);
    for (int p = 0; p < npatterns; p++) {
        bool found = false;
        for (int i = 0; i < n; i++) {
            if (!text_match(patterns[p], all[i].name)) continue;
            choose(to, taken, i);
            found = true;
        }
        if (found) continue;
        to->wrong = p;
        return no_match(patterns[p], all, n, blame, life, report);
    }
    return OK;
}

/* As far as the next comma that stands in no parentheses, or the end. */
static size_t item_length(const char *list)
{
    int depth = 0;
    size_t n = 0;
    for (; list[n] && (list[n] != ',' || depth > 0); n++) depth += (list[n] == '(') - (list[n] == ')');
    return n;
}

const char **columns_split(int *n, const char *list, struct arena *life)
{
    size_t most = 1;
    for (const char *c = list; *c; c++) most += *c == ',';
    const char **patterns = TAKE(life, const char *, most);
    *n = 0;
    for (const char *from = list;;) {
        const char *end = from + item_length(from), *first = from + strspn(from, " \t");
        const char *last = end;
        while (last > first && (last[-1] == ' ' || last[-1] == '\t')) last--;
        if (last > first) patterns[(*n)++] = arena_copy(life, first, (size_t)(last - first));
        if (!*end) return patterns;
        from = end + 1;
    }
}

const char *columns_item_name(const char *item, struct arena *life)
{
    size_t n = strcspn(item, "=");
    while (n > 0 && (item[n - 1] == ' ' || item[n - 1] == '\t')) n--;
    return arena_copy(life, item, n);
}

/* Between single quotes nothing but the quote itself has a meaning in YAML, and that is doubled. */
static char *put_quoted(char *to, const char *text)
{
    *to++ = '\'';
    for (; *text; text++) {
        if (*text == '\'') *to++ = '\'';
        *to++ = *text;
    }
    *to++ = '\'';
    return to;
}

const char *columns_setting(const char *const *item, int n, struct arena *life)
{
    static const char head[] = "output.columns=[";
    size_t most = sizeof head + 1;
    for (int i = 0; i < n; i++) most += 2 * strlen(item[i]) + sizeof ", {'': ''}";
    char *text = TAKE(life, char, most), *to = stpcpy(text, head);
    for (int i = 0; i < n; i++) {
        const char *formula = strchr(item[i], '=');
        if (i) to = stpcpy(to, ", ");
        if (formula) *to++ = '{';
        to = put_quoted(to, columns_item_name(item[i], life));
        if (!formula) continue;
        to = put_quoted(stpcpy(to, ": "), formula + 1);
        *to++ = '}';
    }
    stpcpy(to, "]");
    return text;
}
