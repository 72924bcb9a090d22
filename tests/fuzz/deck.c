/* deck.c -- a whole deck: read, checked, its modes taken; what is printed of a right one is the same deck again. */
#include <stdlib.h>
#include <string.h>

#include "fuzz/deck.h"

static char *printed(const struct scene *scene)
{
    char *text;
    size_t size;
    FILE *to = open_memstream(&text, &size);
    PROMISE(to);
    deck_print(to, scene->deck);
    fclose(to);
    return text;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *beside;
    struct arena *life = arena_open();
    struct scene *scene = NULL;
    if (!beside) {
        beside = put_copy("rod.json", "tests/decks/crank-rod.json");
        put_text("table.csv", "0,0\n1,1\n2,0\n");
        put_text("part.yaml", "bodies: {more: {mass: 1, inertia: 1, at: [3, 3]}}\n");
    }
    if (deck_read(&scene, put_bytes("deck.yaml", data, size), life) == OK) {
        char *once = printed(scene);
        PROMISE(deck_read(&scene, put_text("again.yaml", once), life) == OK);
        char *twice = printed(scene);
        PROMISE(strcmp(once, twice) == 0);
        free(once), free(twice);
    }
    arena_close(life);
    return 0;
}
