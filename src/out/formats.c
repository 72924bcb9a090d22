/* formats.c -- the writers by name; see sink.h */
#include <stddef.h>
#include <string.h>

#include "out/sink.h"

const struct format formats[] = {
    {"csv", "one header line, one line a row", csv_open},
    {"ndjson", "one JSON object a line: meta, rows, events, summary", ndjson_open},
    {"json", "one JSON object, for short runs", json_open},
    {0},
};

const struct format *format_find(const char *name)
{
    for (const struct format *f = formats; f->name; f++)
        if (strcmp(f->name, name) == 0) return f;
    return NULL;
}
