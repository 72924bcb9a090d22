/* schema.c -- fmdsub schema: the key tables as a JSON Schema (draft-07), for editors */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/cli.h"
#include "kind/joint.h"
#include "multirate/schemes.h"
#include "out/facts.h"
#include "sim/load.h"

static cJSON *typed(const char *type)
{
    cJSON *o = cJSON_CreateObject();
    if (type) cJSON_AddStringToObject(o, "type", type);
    return o;
}

static cJSON *type_list(const char *a, const char *b)
{
    cJSON *o = cJSON_CreateObject(), *types = cJSON_AddArrayToObject(o, "type");
    cJSON_AddItemToArray(types, cJSON_CreateString(a));
    cJSON_AddItemToArray(types, cJSON_CreateString(b));
    return o;
}

static cJSON *words_schema(const char *words)
{
    cJSON *o = cJSON_CreateObject(), *list = cJSON_AddArrayToObject(o, "enum");
    for (const char *w = words; *w; w += strcspn(w, "|"), w += *w == '|') {
        char word[64];
        snprintf(word, sizeof word, "%.*s", (int)strcspn(w, "|"), w);
        const bool truth = strcmp(word, "true") == 0;
        if (truth || strcmp(word, "false") == 0)
            cJSON_AddItemToArray(list, cJSON_CreateBool(truth));
        else if (strspn(word, ".0123456789") == strlen(word)) /* a number, as editors read it */
            cJSON_AddItemToArray(list, cJSON_CreateRaw(word));
        else
            cJSON_AddItemToArray(list, cJSON_CreateString(word));
    }
    return o;
}

/* A number may always be an expression, which is a string. */
static cJSON *number_schema(const struct key *k)
{
    cJSON *o = type_list(k->type == KEY_INT ? "integer" : "number", "string");
    if (!isinf(k->lo)) cJSON_AddNumberToObject(o, k->flags & KEY_ABOVE ? "exclusiveMinimum" : "minimum", k->lo);
    if (!isinf(k->hi)) cJSON_AddNumberToObject(o, k->flags & KEY_BELOW ? "exclusiveMaximum" : "maximum", k->hi);
    return o;
}

static cJSON *key_schema(const struct key *k)
{
    cJSON *o = NULL;
    switch (k->type) {
    case KEY_REAL:
    case KEY_INT:
        o = number_schema(k);
        break;
    case KEY_BOOL:
        o = typed("boolean");
        break;
    case KEY_WORD:
        o = words_schema(k->words);
        break;
    case KEY_TEXT:
    case KEY_CSV:
        o = typed("string");
        break;
    case KEY_TABLE:
        o = type_list("array", "string");
        break;
    case KEY_VECTOR:
        o = k->flags & KEY_ABOUT ? cJSON_CreateObject() : typed("array");
        break;
    case KEY_NODE:
        o = cJSON_CreateObject();
        break;
    }
    const bool shaped = k->type == KEY_NODE || k->type == KEY_TABLE;
    char text[300];
    snprintf(text, sizeof text, "%s%s%s%s%s%s", k->brief, k->unit ? " [" : "", k->unit ? k->unit : "",
             k->unit ? "]" : "", shaped ? ": " : "", shaped ? k->words : "");
    cJSON_AddStringToObject(o, "description", text);
    if (k->fallback) cJSON_AddStringToObject(o, "default", k->fallback);
    return o;
}

static void allow_repeat(cJSON *properties)
{
    cJSON *repeat = typed("object");
    cJSON_AddStringToObject(repeat, "description", "copies for a loop variable: {i: [first, last]}");
    cJSON_AddItemToObject(properties, "repeat", repeat);
}

static cJSON *section_schema(const struct section *s)
{
    cJSON *o = typed("object"), *properties = cJSON_AddObjectToObject(o, "properties");
    cJSON *required = cJSON_CreateArray();
    const char *dot = strrchr(s->path, '.');
    if (s->word || *s->path) cJSON_AddStringToObject(o, "title", s->word ? s->word : dot ? dot + 1 : s->path);
    if (s->brief) cJSON_AddStringToObject(o, "description", s->brief);
    for (const struct key *k = s->keys; k && k->name; k++) {
        cJSON_AddItemToObject(properties, k->name, key_schema(k));
        if (k->flags & KEY_REQUIRED && !(k->flags & (KEY_SPATIAL | KEY_PLANAR)))
            cJSON_AddItemToArray(required, cJSON_CreateString(k->name));
    }
    if (s->word && !cJSON_HasObjectItem(properties, s->word)) { /* joints and laws: the kind's own word */
        cJSON_AddItemToObject(properties, s->word, cJSON_CreateObject());
        cJSON_AddItemToArray(required, cJSON_CreateString(s->word));
    }
    if (strstr(s->path, "NAME")) allow_repeat(properties);
    if (cJSON_GetArraySize(required) > 0)
        cJSON_AddItemToObject(o, "required", required);
    else
        cJSON_Delete(required);
    cJSON_AddFalseToObject(o, "additionalProperties");
    return o;
}

/* All kinds of a path as one schema: the section itself, or any of its kinds. */
static cJSON *path_schema(const char *path)
{
    struct section s;
    struct arena *life = arena_open();
    cJSON *any = cJSON_CreateArray();
    for (int i = 0; sim_section(&s, i, life); i++)
        if (strcmp(s.path, path) == 0) cJSON_AddItemToArray(any, section_schema(&s));
    arena_close(life);
    if (cJSON_GetArraySize(any) == 1) {
        cJSON *only = cJSON_DetachItemFromArray(any, 0);
        cJSON_Delete(any);
        return only;
    }
    cJSON *o = cJSON_CreateObject();
    cJSON_AddItemToObject(o, "anyOf", any);
    return o;
}

/* {name: item of path} */
static void put_named(cJSON *properties, const char *key, const char *path)
{
    cJSON *o = cJSON_GetObjectItem(properties, key);
    cJSON_AddStringToObject(o, "type", "object");
    cJSON_AddItemToObject(o, "additionalProperties", path_schema(path));
}

static void put_nested(cJSON *properties, const char *key, const char *path)
{
    cJSON_ReplaceItemInObject(properties, key, path_schema(path));
}

/* A word besides the map. */
static void allow_word(cJSON *properties, const char *key, const char *word)
{
    cJSON *map = cJSON_DetachItemFromObject(properties, key), *o = cJSON_CreateObject();
    cJSON *any = cJSON_AddArrayToObject(o, "anyOf");
    cJSON_AddItemToArray(any, map);
    cJSON_AddItemToArray(any, words_schema(word));
    cJSON_AddItemToObject(properties, key, o);
}

/* {name: one of these types, or a map of path}; path NULL: any map. */
static void put_values(cJSON *properties, const char *key, const char *a, const char *b, const char *path)
{
    cJSON *value = cJSON_CreateObject(), *any = cJSON_AddArrayToObject(value, "anyOf");
    cJSON_AddItemToArray(any, type_list(a, b));
    if (path) cJSON_AddItemToArray(any, path_schema(path));
    cJSON *o = cJSON_GetObjectItem(properties, key);
    cJSON_AddStringToObject(o, "type", "object");
    cJSON_AddItemToObject(o, "additionalProperties", value);
}

static void put_schemes(cJSON *integrate)
{
    cJSON *scheme = cJSON_GetObjectItem(cJSON_GetObjectItem(integrate, "properties"), "scheme");
    cJSON *list = cJSON_AddArrayToObject(scheme, "enum");
    for (int i = 0; stepper_kinds[i]; i++) cJSON_AddItemToArray(list, cJSON_CreateString(stepper_kinds[i]->name));
    for (int i = 0; stepper_absent[i]; i++) cJSON_AddItemToArray(list, cJSON_CreateString(stepper_absent[i]->name));
    cJSON_AddItemToArray(list, cJSON_CreateString("auto"));
}

/* A deck that includes others may have from them what a deck needs. */
static void unless_included(cJSON *root)
{
    cJSON *included = cJSON_AddObjectToObject(root, "if"), *whole = cJSON_AddObjectToObject(root, "else");
    cJSON_AddItemToArray(cJSON_AddArrayToObject(included, "required"), cJSON_CreateString("include"));
    cJSON_AddItemToObject(whole, "required", cJSON_DetachItemFromObject(root, "required"));
}

static cJSON *deck_schema(void)
{
    cJSON *root = path_schema(""), *properties = cJSON_GetObjectItem(root, "properties");
    cJSON_AddStringToObject(root, "$schema", "http://json-schema.org/draft-07/schema#");
    cJSON_AddStringToObject(root, "title", "fmdsub deck");
    put_named(properties, "bodies", "bodies.NAME");
    cJSON *ground = cJSON_AddObjectToObject(cJSON_GetObjectItem(properties, "bodies"), "properties");
    cJSON_AddItemToObject(ground, "ground", path_schema("bodies.ground"));
    put_named(properties, "constraints", "constraints.NAME");
    put_named(properties, "measures", "measures.NAME");
    put_named(properties, "forces", "forces.NAME");
    put_named(properties, "surfaces", "surfaces.NAME");
    put_named(properties, "contacts", "contacts.NAME");
    put_named(properties, "drives", "drives.NAME");
    put_values(properties, "signals", "string", "number", "signals.NAME");
    put_values(properties, "tables", "array", "object", NULL);
    put_nested(properties, "partition", "partition");
    allow_word(properties, "partition", "auto");
    put_nested(properties, "integrate", "integrate");
    put_schemes(cJSON_GetObjectItem(properties, "integrate"));
    put_nested(properties, "output", "output");
    put_nested(properties, "checkpoint", "checkpoint");
    put_nested(properties, "energy", "energy");
    unless_included(root);
    return root;
}

enum status verb_schema(const struct request *request, struct arena *life, struct report *report)
{
    (void)life;
    if (request->nword) return fail(report, E_USAGE, "'fmdsub schema' takes no argument: it is the same for all decks");
    return facts_print(deck_schema(), true, report);
}
