/* body.c -- a reduced body: what is read is written so that it reads back to the same text. */
#include <string.h>

#include "flex/file.h"
#include "fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct arena *life = arena_open();
    struct report report = {0};
    struct flex_body *o;
    double at[3];
    enum status status = flex_file_read(&o, at, put_bytes("body.json", data, size), life, &report);
    PROMISE((status == OK) == !report.text[0]);
    PROMISE(status == OK || status == E_DECK || status == E_FILE || status == E_LIMIT);
    if (status == OK) {
        const char *text = flex_file_text(o, at, life);
        PROMISE(flex_file_read(&o, at, put_text("again.json", text), life, &report) == OK);
        PROMISE(strcmp(flex_file_text(o, at, life), text) == 0);
    }
    arena_close(life);
    return 0;
}
