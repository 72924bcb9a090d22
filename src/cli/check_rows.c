/* check_rows.c -- fmdsub check --format csv: the object of --format json, a row for each of its values */
#include <string.h>

#include "base/text.h"
#include "cli/cli.h"
#include "out/facts.h"
#include "out/table.h"

/* Units of what has one always; coordinates tell their own. */
static const char *unit_of(const char *topic, const char *fact)
{
    static const struct {
        const char *topic, *fact, *unit;
    } units[] = {
        {"deck", "mass", "kg"},           {"deck", "centre.*", "m"},         {"deck", "omega.*", "rad/s"},
        {"bodies", "mass", "kg"},         {"bodies", "hertz.*", "Hz"},       {"bodies", "chosen.modes.*.hertz", "Hz"},
        {"steps", "step", "s"},           {"steps", "trial_until", "s"},     {"steps", "trial_of_steps_until", "s"},
        {"steps", "suggested_step", "s"}, {"advice", "suggested_step", "s"},
    };
    for (size_t i = 0; i < sizeof units / sizeof *units; i++)
        if (strcmp(topic, units[i].topic) == 0 && text_match(units[i].fact, fact)) return units[i].unit;
    return "";
}

/* A text as it stands in JSON, without what JSON needs of quotes; control characters stay escaped. */
static const char *unquoted(const char *json, struct arena *life)
{
    char *copy = TAKE(life, char, strlen(json) + 1), *to = copy;
    for (const char *c = json + 1; c[1]; c++) {
        if (*c == '\\' && (c[1] == '"' || c[1] == '\\')) c++;
        *to++ = *c;
    }
    return copy;
}

static const char *value_of(const cJSON *item, struct arena *life)
{
    if (cJSON_IsBool(item)) return cJSON_IsTrue(item) ? "true" : "false";
    if (cJSON_IsNull(item)) return "";
    return cJSON_IsRaw(item) && *item->valuestring == '"' ? unquoted(item->valuestring, life) : item->valuestring;
}

/* Where the rows are that come next: of what, of which one of them, what in it. */
struct place {
    const char *topic, *name, *fact;
};

/* Of what is under that key in an item.  A list of objects is a topic of its own, an object, too; within one of a list
 * all is a fact of that one. */
static struct place place_in(struct place at, const cJSON *item, const cJSON *in, const char *key, struct arena *life)
{
    const cJSON *name = cJSON_GetObjectItem(in, "name");
    if (!*at.name && cJSON_IsArray(item) && cJSON_IsObject(in))
        return (struct place){at.fact, name ? name->valuestring : key, ""};
    if (!*at.name && cJSON_IsObject(in)) return (struct place){key, "", ""};
    at.fact = *at.fact ? arena_print(life, "%s.%s", at.fact, key) : key;
    return at;
}

static void put_row(struct table *to, struct place at, const cJSON *item, struct arena *life)
{
    const char *cell[] = {at.topic, at.name, at.fact, value_of(item, life), unit_of(at.topic, at.fact)};
    for (size_t i = 0; i < sizeof cell / sizeof *cell; i++) table_text(to, cell[i]);
}

static void put_rows(struct table *to, struct place at, const cJSON *item, struct arena *life)
{
    int number = 0;
    if (!cJSON_IsObject(item) && !cJSON_IsArray(item)) {
        put_row(to, at, item, life);
        return;
    }
    for (const cJSON *in = item->child; in; in = in->next) {
        const char *key = in->string ? in->string : arena_print(life, "%d", ++number);
        const struct place next = place_in(at, item, in, key, life);
        if (!*at.name || strcmp(next.fact, "name") != 0) put_rows(to, next, in, life);
    }
}

enum status check_rows(const cJSON *object, struct arena *life, struct report *report)
{
    static const struct table_column columns[] = {
        {"topic", NULL, 0}, {"name", NULL, 0}, {"fact", NULL, 0}, {"value", NULL, 0}, {"unit", NULL, 0},
    };
    struct table *table = table_open(columns, sizeof columns / sizeof *columns, life);
    put_rows(table, (struct place){"deck", "", ""}, object, life);
    return table_print(table, TABLE_CSV, stdout, report);
}
