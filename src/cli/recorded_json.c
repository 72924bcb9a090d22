/* recorded_json.c -- records from NDJSON and JSON (out/sink.h); see recorded.h */
#include <cjson/cJSON.h>
#include <math.h>
#include <string.h>

#include "cli/recorded.h"

static const char *text_of(const cJSON *item, struct arena *life)
{
    const char *text = cJSON_GetStringValue(item);
    return text ? arena_copy(life, text, strlen(text)) : NULL;
}

/* Names from a list, units from a map. */
static const char *read_meta(struct curves *o, const cJSON *columns, const cJSON *units, struct arena *life)
{
    const cJSON *item;
    int capacity = 0;
    if (o->n) return "";
    cJSON_ArrayForEach(item, columns)
    {
        const char *name = text_of(item, life);
        if (!name) return "columns that are no names";
        o->column = arena_more(life, o->column, o->n, &capacity, sizeof *o->column);
        o->column[o->n++] =
            (struct column){.name = name, .unit = text_of(cJSON_GetObjectItemCaseSensitive(units, name), life)};
    }
    return o->n ? "" : "no list of columns";
}

static const char *put_value(double *x, const cJSON *item)
{
    if (cJSON_IsNumber(item)) *x = cJSON_GetNumberValue(item);
    return cJSON_IsNumber(item) || cJSON_IsNull(item) ? "" : "a value that is no number";
}

/* {"type":"row","t":0,"hub.angle":0.5}, as a rule in the order of the columns */
static const char *read_row(struct curves *o, const cJSON *row, struct arena *life)
{
    const cJSON *item;
    int next = 0;
    if (!o->n) return "a row before the line of type meta, which names the columns";
    double *x = recorded_row(o, life);
    cJSON_ArrayForEach(item, row)
    {
        if (strcmp(item->string, "type") == 0) continue;
        const int i =
            next < o->n && strcmp(o->column[next].name, item->string) == 0 ? next : curves_find(o, item->string);
        if (i < 0) return "a row with a value that the line of type meta does not name";
        const char *wrong = put_value(&x[i], item);
        if (*wrong) return wrong;
        next = i + 1;
    }
    return "";
}

static const char *read_object(struct curves *o, const cJSON *object, struct arena *life)
{
    const char *type = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(object, "type"));
    if (!cJSON_IsObject(object) || !type) return "no object with a type, as `fmdsub run -f ndjson` writes them";
    if (strcmp(type, "row") == 0) return read_row(o, object, life);
    if (strcmp(type, "meta") != 0) return "";
    return read_meta(o, cJSON_GetObjectItemCaseSensitive(object, "columns"),
                     cJSON_GetObjectItemCaseSensitive(object, "units"), life);
}

const char *recorded_line(struct curves *o, const char *line, struct arena *life)
{
    cJSON *object = cJSON_Parse(line);
    const char *wrong = read_object(o, object, life);
    cJSON_Delete(object);
    return wrong;
}

static const char *read_list(struct curves *o, const cJSON *row, struct arena *life)
{
    const cJSON *item;
    int i = 0;
    double *x = recorded_row(o, life);
    cJSON_ArrayForEach(item, row)
    {
        if (i == o->n) return "a row with more values than there are columns";
        const char *wrong = put_value(&x[i++], item);
        if (*wrong) return wrong;
    }
    return i < o->n ? "a row with fewer values than there are columns" : "";
}

static const char *read_whole(struct curves *o, const cJSON *all, struct arena *life)
{
    const cJSON *row, *meta = cJSON_GetObjectItemCaseSensitive(all, "meta");
    const char *wrong = read_meta(o, cJSON_GetObjectItemCaseSensitive(all, "columns"),
                                  cJSON_GetObjectItemCaseSensitive(meta, "units"), life);
    cJSON_ArrayForEach(row, cJSON_GetObjectItemCaseSensitive(all, "rows"))
    {
        if (!*wrong) wrong = read_list(o, row, life);
    }
    return wrong;
}

const char *recorded_whole(struct curves *o, const char *text, struct arena *life)
{
    cJSON *all = cJSON_Parse(text);
    const char *wrong = all ? read_whole(o, all, life) : "no JSON";
    cJSON_Delete(all);
    return wrong;
}
