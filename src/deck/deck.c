/* deck.c -- the stages of a deck, in order; see deck.h */
#include "deck/deck.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <unistd.h>

#include "base/hash.h"
#include "base/stop.h"
#include "deck/stages.h"

void hash_text(struct deck *deck, const char *text, size_t len)
{
    deck->hash = hash_bytes(deck->hash, text, len);
}

void hash_file(struct deck *deck, const struct source *s)
{
    hash_text(deck, s->text, s->len + 1);
    deck->beside = hash_bytes(deck->beside, s->text, s->len + 1);
}

static void close_scratch(void *arena)
{
    arena_close(arena);
}

/* folder/name.yaml */
static void set_names(struct deck *deck, const char *path)
{
    bool stdin_ = !strcmp(path, "-");
    const char *slash = strrchr(path, '/'), *file = slash ? slash + 1 : path, *dot = strrchr(file, '.');
    size_t len =
        dot && dot > file && (!strcmp(dot, ".yaml") || !strcmp(dot, ".yml")) ? (size_t)(dot - file) : strlen(file);
    deck->path = stdin_ ? "<stdin>" : arena_copy(deck->arena, path, strlen(path));
    deck->name = stdin_ ? "stdin" : arena_copy(deck->arena, file, len);
    deck->folder = slash ? arena_copy(deck->arena, path, (size_t)(slash - path) + 1) : ".";
}

static struct deck *open_deck(const char *path, const struct deck_options *options, struct diags *diags,
                              struct arena *arena)
{
    struct deck *deck = TAKE(arena, struct deck, 1);
    *deck = (struct deck){.arena = arena,
                          .diags = diags,
                          .pool = {.arena = arena},
                          .read = {.arena = arena},
                          .hash = HASH_NOTHING,
                          .beside = HASH_NOTHING};
    deck->max_bytes = options && options->max_bytes ? options->max_bytes : DECK_BYTES;
    deck->scratch = arena_open();
    arena_defer(arena, close_scratch, deck->scratch);
    set_names(deck, path);
    return deck;
}

enum status deck_read(struct source **out, int fd, const char *path, struct deck *deck, struct report *report)
{
    files_add(&deck->read, fd);
    return source_read(out, fd, path, deck->max_bytes, deck->arena, report);
}

static enum status read_file(struct source **out, struct stat *self, const char *path, struct deck *deck,
                             struct report *report)
{
    bool stdin_ = !strcmp(path, "-");
    int fd = stdin_ ? STDIN_FILENO : open(path, O_RDONLY | O_CLOEXEC);
    if (fd < 0 && errno == EINTR && stop) return stop_status(); /* a named pipe that nobody writes */
    if (fd < 0) return fail(report, E_FILE, "%s: %s", path, strerror(errno));
    if (fstat(fd, self)) *self = (struct stat){0};
    enum status status = deck_read(out, fd, deck->path, deck, report);
    if (!stdin_) close(fd);
    return status;
}

/* ---- one text ---- */

static bool clean(struct deck *deck, int file, const struct source *s)
{
    static const struct {
        const char *code, *text;
    } flaws[] = {
        [SOURCE_UTF8] = {"E-encoding", "not UTF-8 text here"},
        [SOURCE_UTF16] = {"E-encoding", "this is UTF-16; save the deck as UTF-8"},
        [SOURCE_ZERO] = {"E-character", "a zero byte"},
        [SOURCE_CONTROL] = {"E-character", "a control character"},
    };
    size_t offset;
    enum source_flaw flaw = source_check(s, &offset);
    if (flaw == SOURCE_FINE) return true;
    struct mark at = source_mark(s, offset);
    diag_error_in(deck->diags, (struct span){file, at, at}, flaws[flaw].code, "%s", flaws[flaw].text);
    return false;
}

static bool is_map(struct deck *deck, const struct node *root, const char *what)
{
    if (root->type == NODE_MAP) return true;
    if (root->reported) return false;
    if (node_is_null(root)) {
        diag_error(deck->diags, root, AT_VALUE, "E-empty", "%s is empty", what);
        return false;
    }
    diag_error(deck->diags, root, AT_VALUE, "E-type", "%s: expected a map, found %s", what, node_type_name(root));
    if (root->type == NODE_SCALAR && strchr(root->text, ':')) diag_hint(deck->diags, "is a space missing after ':'?");
    return false;
}

struct node *deck_parse(struct deck *deck, const struct source *s, const char *what)
{
    int file = diags_add_source(deck->diags, s);
    hash_text(deck, s->text, s->len + 1);
    if (!clean(deck, file, s)) return NULL;
    struct node *root = tree_parse(&deck->pool, deck->diags, file, 0);
    return root && is_map(deck, root, what) ? root : NULL;
}

/* ---- files a deck names ---- */

int deck_open_file(const struct node *n, struct deck *deck)
{
    const char *why = "its name is empty or too long";
    int fd = -1;
    if (n->reported) return -1;
    if (n->type != NODE_SCALAR)
        why = "its name is not a text";
    else if (n->len > 0 && n->len < 4096)
        fd = source_open_beneath(deck->folder, n->text, &why);
    if (fd >= 0) return fd;
    diag_error(deck->diags, n, AT_VALUE, "E-path", "'%s': %s", n->text ? diag_clip(deck->diags, n->text) : "", why);
    return -1;
}

struct source *source_beside(const struct node *file, struct deck *deck)
{
    struct source *s;
    struct report report = {0};
    int fd = deck_open_file(file, deck);
    if (fd < 0) return NULL;
    const char *path = arena_print(deck->arena, "%s%s", strcmp(deck->folder, ".") ? deck->folder : "", file->text);
    enum status status = deck_read(&s, fd, path, deck, &report);
    close(fd);
    if (status == OK) return s;
    diag_error(deck->diags, file, AT_VALUE, status == E_LIMIT ? "E-limit-file" : "E-path", "%s", report.text);
    return NULL;
}

const struct node *deck_yaml(const struct node *file, struct deck *deck)
{
    struct source *s = source_beside(file, deck);
    return s ? deck_parse(deck, s, file->text) : NULL;
}

const char *deck_file(const struct node *file, struct deck *deck)
{
    struct source *s = source_beside(file, deck);
    if (!s) return NULL;
    hash_file(deck, s);
    return s->path;
}

/* ---- the whole ---- */

enum status deck_load(struct deck **out, const char *path, const struct deck_options *options, struct diags *diags,
                      struct arena *arena, struct report *report)
{
    struct deck *deck = open_deck(path, options, diags, arena);
    const struct source *s = options && strcmp(path, "-") == 0 ? options->again : NULL;
    struct source *file;
    struct stat self = {0};
    *out = NULL;
    if (!s) {
        TRY(read_file(&file, &self, path, deck, report));
        s = file;
    }
    deck->root = deck_parse(deck, s, "the deck");
    if (!deck->root) return diags_status(diags);
    include_all(deck, &self);
    struct set *set = set_open(options, deck);
    set_early(set, deck);
    parameters_evaluate(deck);
    repeat_all(deck);
    set_late(set, deck);
    repeat_rest(deck);
    *out = deck;
    return diags_status(diags) == E_LIMIT ? E_LIMIT : OK;
}
