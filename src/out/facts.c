/* facts.c -- see facts.h */
#include "out/facts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "out/number.h"

bool facts_add(cJSON *to, const char *key, cJSON *item)
{
    bool added = item && (key ? cJSON_AddItemToObject(to, key, item) : cJSON_AddItemToArray(to, item));
    if (!added) cJSON_Delete(item);
    return added;
}

/* One character of a JSON string: what a terminal would obey goes out as its number, as control characters must. */
static char *put_character(char *to, unsigned code, const char *text, size_t length)
{
    static const char plain[] = "\"\\\b\f\n\r\t", letter[] = "\"\\bfnrt";
    const char *known = code < 0x80 ? memchr(plain, (int)code, sizeof plain - 1) : NULL;
    if (known) return *to++ = '\\', *to++ = letter[known - plain], to;
    if (text_hidden(code)) return to + sprintf(to, "\\u%04x", code);
    memcpy(to, text, length);
    return to + length;
}

/* The text as a JSON string; bytes that are no character become U+FFFD. */
static const char *quoted(const char *text, struct arena *scratch)
{
    char *copy = TAKE(scratch, char, 6 * strlen(text) + 3), *to = copy;
    *to++ = '"';
    for (const char *end = text + strlen(text); text < end;) {
        unsigned code;
        size_t length = text_character(&code, text, end);
        to = length ? put_character(to, code, text, length) : put_character(to, 0xfffd, "\xef\xbf\xbd", 3);
        text += length ? length : 1;
    }
    *to = '"';
    return copy;
}

cJSON *facts_text(const char *text, struct arena *scratch)
{
    if (!text) return cJSON_CreateNull();
    struct arena_mark mark = arena_mark(scratch);
    cJSON *item = cJSON_CreateRaw(quoted(text, scratch));
    arena_rewind(scratch, mark);
    return item;
}

cJSON *facts_number(double x)
{
    if (!isfinite(x)) return cJSON_CreateNull();
    char text[NUMBER_MOST + 1];
    text[number_write(text, x)] = 0;
    return cJSON_CreateRaw(text);
}

cJSON *facts_columns(const struct run_meta *meta)
{
    cJSON *names = cJSON_CreateArray();
    for (int i = 0; i < meta->n; i++) {
        if (facts_add(names, NULL, cJSON_CreateString(meta->columns[i].name))) continue;
        cJSON_Delete(names);
        return NULL;
    }
    return names;
}

static cJSON *units(const struct run_meta *meta, struct arena *scratch)
{
    cJSON *object = cJSON_CreateObject();
    for (int i = 0; i < meta->n; i++) {
        const struct column *column = &meta->columns[i];
        if (facts_add(object, column->name, facts_text(column->unit, scratch))) continue;
        cJSON_Delete(object);
        return NULL;
    }
    return object;
}

static cJSON *value(const struct pair *pair, struct arena *scratch)
{
    switch (pair->kind) {
    case PAIR_NUMBER:
        return facts_number(pair->number);
    case PAIR_TEXT:
        return facts_text(pair->text, scratch);
    case PAIR_BOOL:
        return cJSON_CreateBool(pair->truth);
    }
    return NULL;
}

bool facts_pairs(cJSON *to, const struct pair *pairs, int n, struct arena *scratch)
{
    for (int i = 0; i < n; i++)
        if (!facts_add(to, pairs[i].key, value(&pairs[i], scratch))) return false;
    return true;
}

static cJSON *settings(const struct run_meta *meta, struct arena *scratch)
{
    cJSON *object = cJSON_CreateObject();
    if (facts_pairs(object, meta->settings, meta->nsettings, scratch)) return object;
    cJSON_Delete(object);
    return NULL;
}

bool facts_meta(cJSON *to, const struct run_meta *meta, struct arena *scratch)
{
    return facts_add(to, "program", cJSON_CreateString("fmdsub")) &&
           facts_add(to, "version", facts_text(meta->version, scratch)) &&
           facts_add(to, "title", facts_text(meta->title, scratch)) &&
           facts_add(to, "deck", facts_text(meta->deck, scratch)) &&
           facts_add(to, "hash", facts_text(meta->hash, scratch)) &&
           facts_add(to, "settings", settings(meta, scratch)) && facts_add(to, "units", units(meta, scratch));
}

bool facts_event(cJSON *to, double t, const char *kind, const char *text, struct arena *scratch)
{
    return facts_add(to, "t", facts_number(t)) && facts_add(to, "kind", facts_text(kind, scratch)) &&
           facts_add(to, "text", facts_text(text, scratch));
}

enum status facts_no_memory(struct stream *stream, struct report *report)
{
    TRY(stream_flush(stream, report));
    return stream->status = fail(report, E_LIMIT, "out of memory");
}

enum status facts_put(struct stream *stream, const char *before, cJSON *item, const char *after, struct report *report)
{
    char *text = item ? cJSON_PrintUnformatted(item) : NULL;
    cJSON_Delete(item);
    if (!text) return facts_no_memory(stream, report);
    char *to = stream_begin(stream, strlen(before) + strlen(text) + strlen(after));
    enum status status = stream_end(stream, stpcpy(stpcpy(stpcpy(to, before), text), after), report);
    cJSON_free(text);
    return status;
}

enum status facts_print(cJSON *item, bool lines, struct report *report)
{
    char *text = !item ? NULL : lines ? cJSON_Print(item) : cJSON_PrintUnformatted(item);
    cJSON_Delete(item);
    if (!text) return fail(report, E_LIMIT, "out of memory");
    puts(text);
    cJSON_free(text);
    return OK;
}
