/* t-writer.c -- from rows to bytes: the stream under faults, the three writers, the table. */
#include "base/arena.h"
#include "out/sink.h"
#include "out/table.h"
#include "unit/faults.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <cjson/cJSON.h>
#include <limits.h>
#include <math.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

static char folder[] = "/tmp/fmdsub-writer-XXXXXX";
static struct arena *life;
static struct report report;
static struct stream stream;

/* ---- helpers ---- */

static const char *in_folder(const char *name)
{
    return arena_print(life, "%s/%s", folder, name);
}

static bool exists(const char *path)
{
    struct stat st;
    return lstat(path, &st) == 0;
}

static const char *text_of(const char *path)
{
    size_t size;
    char *text = slurp(path, &size);
    if (!text) return NULL;
    const char *copy = arena_copy(life, text, size);
    free(text);
    return copy;
}

static void write_text(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

static int fresh(void **state)
{
    (void)state;
    life = arena_open();
    report = (struct report){0};
    memset(&plan, 0, sizeof plan);
    return 0;
}

static int done(void **state)
{
    (void)state;
    arena_close(life);
    return 0;
}

static int make_folder(void **state)
{
    (void)state;
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
    return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    char command[sizeof folder + 16];
    snprintf(command, sizeof command, "rm -r %s", folder);
    return system(command);
}

/* A record of changing length: its number, then dots. */
static enum status put_record(int i)
{
    static const char dots[] = "..................................................................................";
    char text[128];
    int n = snprintf(text, sizeof text, "%d %.*s\n", i, i * 7 % 80, dots);
    return stream_put(&stream, text, (size_t)n, &report);
}

static enum status put_records(int n)
{
    for (int i = 0; i < n; i++) TRY(put_record(i));
    return OK;
}

/* What put_records(n) should leave behind. */
static const char *records(int n)
{
    const char *path = in_folder("records");
    assert_int_equal(stream_create(&stream, path, life, &report), OK);
    assert_int_equal(put_records(n), OK);
    assert_int_equal(stream_close(&stream, true, &report), OK);
    const char *text = text_of(path);
    unlink(path);
    return text;
}

static void is_whole_beginning(const char *text, const char *all)
{
    size_t n = strlen(text);
    assert_true(n < strlen(all));
    assert_memory_equal(text, all, n);
    assert_true(n == 0 || text[n - 1] == '\n');
}

/* ---- stream: when bytes leave ---- */

static void full_buffers_leave_and_ticks_send_the_rest(void **state)
{
    (void)state;
    const char *path = in_folder("ticks");
    assert_int_equal(stream_create(&stream, path, life, &report), OK);
    stream.write = planned_write;
    assert_int_equal(put_record(0), OK);
    assert_int_equal(plan.calls, 0);
    assert_int_equal(stream_tick(&stream, 1000.0, &report), OK); /* the first is sent at once */
    assert_int_equal(plan.calls, 1);
    assert_int_equal(put_record(1), OK);
    assert_int_equal(stream_tick(&stream, 1000.19, &report), OK);
    assert_int_equal(plan.calls, 1);
    assert_int_equal(stream_tick(&stream, 1000.21, &report), OK);
    assert_int_equal(plan.calls, 2);
    assert_int_equal(stream_tick(&stream, 1001, &report), OK); /* nothing waits */
    assert_int_equal(plan.calls, 2);
    assert_int_equal(put_record(2), OK);
    assert_int_equal(stream_tick(&stream, 1001.01, &report), OK); /* and nothing was sent for long */
    assert_int_equal(plan.calls, 3);
    assert_int_equal(put_records(20000), OK);
    assert_in_range(plan.largest, STREAM_FULL, STREAM_FULL + 127);
    assert_in_range(plan.calls, 3 + stream.written / (STREAM_FULL + 127), 3 + stream.written / STREAM_FULL);
    assert_int_equal(plan.cut, 0);
    assert_int_equal(stream_close(&stream, true, &report), OK);
    assert_int_equal(stream.written, strlen(text_of(path)));
}

static void long_records_pass(void **state)
{
    (void)state;
    const char *path = in_folder("long");
    size_t n = 300000;
    char *text = TAKE(life, char, n + 1);
    memset(text, 'x', n);
    text[n - 1] = '\n';
    assert_int_equal(stream_create(&stream, path, life, &report), OK);
    assert_int_equal(put_record(1), OK);
    assert_int_equal(stream_put(&stream, text, n, &report), OK);
    assert_int_equal(stream_put(&stream, text + n - 5, 5, &report), OK);
    assert_int_equal(stream_close(&stream, true, &report), OK);
    assert_string_equal(text_of(path), arena_print(life, "1 .......\n%sxxxx\n", text));
}

static void interruptions_and_short_writes_lose_nothing(void **state)
{
    (void)state;
    const char *all = records(3000), *path = in_folder("short");
    static const struct {
        size_t most;
        int interrupts;
    } rows[] = {{7, 0}, {0, 3}, {1000, 1}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        memset(&plan, 0, sizeof plan);
        plan.most = rows[i].most;
        plan.interrupts = rows[i].interrupts;
        assert_int_equal(stream_create(&stream, path, life, &report), OK);
        stream.write = planned_write;
        assert_int_equal(put_records(3000), OK);
        assert_int_equal(stream_close(&stream, true, &report), OK);
        assert_true(plan.calls > 2);
        assert_string_equal(text_of(path), all);
    }
}

/* Reads a pipe in odd pieces with rests, and tells by its exit code whether all came. */
static pid_t slow_reader(int ends[2], const char *all)
{
    pid_t pid = fork();
    if (pid != 0) return pid;
    close(ends[1]);
    size_t size = strlen(all), at = 0;
    char piece[4999];
    for (ssize_t got; (got = read(ends[0], piece, sizeof piece)) > 0; at += (size_t)got) {
        if (at + (size_t)got > size || memcmp(piece, all + at, (size_t)got) != 0) _exit(1);
        if (at % 5 == 0) usleep(500);
    }
    _exit(at == size ? 0 : 2);
}

static void a_slow_reader_gets_all(int flags)
{
    const char *all = records(8000);
    int ends[2], how;
    assert_int_equal(pipe(ends), 0);
    fcntl(ends[1], F_SETPIPE_SZ, 8192);
    pid_t pid = slow_reader(ends, all);
    close(ends[0]);
    fcntl(ends[1], F_SETFL, flags);
    assert_int_equal(stream_open(&stream, ends[1], "stdout", life, &report), OK);
    stream.write = planned_write;
    assert_int_equal(put_records(8000), OK);
    assert_int_equal(stream_close(&stream, true, &report), OK);
    close(ends[1]);
    assert_int_equal(waitpid(pid, &how, 0), pid);
    assert_true(WIFEXITED(how));
    assert_int_equal(WEXITSTATUS(how), 0);
}

static void pipes_get_atomic_pieces(void **state)
{
    (void)state;
    a_slow_reader_gets_all(0);
    assert_in_range(plan.largest, PIPE_BUF - 128, PIPE_BUF);
    assert_int_equal(plan.cut, 0);
}

static void a_pipe_that_does_not_block_is_waited_for(void **state)
{
    (void)state;
    a_slow_reader_gets_all(O_NONBLOCK);
    assert_in_range(plan.largest, PIPE_BUF - 128, PIPE_BUF);
}

/* ---- stream: failing ---- */

static void full_disk(void **state)
{
    (void)state;
    int fd = open("/dev/full", O_WRONLY);
    assert_int_equal(stream_open(&stream, fd, "stdout", life, &report), OK);
    assert_int_equal(put_record(1), OK); /* waits in the buffer: only the last flush can tell */
    assert_int_equal(stream_close(&stream, true, &report), E_FILE);
    assert_string_equal(report.text, "cannot write 'stdout': No space left on device, after 0 bytes");
    assert_int_equal(put_record(2), E_FILE);
    close(fd);

    report = (struct report){0};
    assert_int_equal(stream_open(&stream, fd = open("/dev/full", O_WRONLY), "stdout", life, &report), OK);
    assert_int_equal(put_records(100000), E_FILE); /* and a full buffer tells at once */
    close(fd);
}

static void closed_descriptor(void **state)
{
    (void)state;
    int fd = dup(1);
    close(fd);
    assert_int_equal(stream_open(&stream, fd, "stdout", life, &report), E_FILE);
    assert_string_equal(report.text, "cannot write 'stdout': Bad file descriptor");
    assert_int_equal(put_records(100000), E_FILE);
    assert_int_equal(stream_tick(&stream, 1, &report), E_FILE);
    assert_int_equal(stream_close(&stream, true, &report), E_FILE);
}

static void reader_leaves(void **state)
{
    (void)state;
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    assert_int_equal(stream_open(&stream, ends[1], "stdout", life, &report), OK);
    assert_int_equal(put_record(1), OK);
    assert_int_equal(stream_flush(&stream, &report), OK);
    close(ends[0]);
    assert_int_equal(put_records(100000), E_SIGPIPE);
    assert_int_equal(put_record(1), E_SIGPIPE);
    assert_int_equal(report.status, E_SIGPIPE);
    assert_int_equal(stream_close(&stream, true, &report), E_SIGPIPE);
    close(ends[1]);
}

/* Whatever write fails, in short writes: whole records stay, under the name that says so. */
static void any_write_may_fail(void **state)
{
    (void)state;
    const char *all = records(60), *path = in_folder("kth");
    int calls = (int)strlen(all) / 100 + 1, last = -1;
    for (int k = 1; k <= calls; k++) {
        memset(&plan, 0, sizeof plan);
        plan.most = 100;
        plan.fails_at = k;
        plan.error = k % 2 ? EIO : 0;
        report = (struct report){0};
        assert_int_equal(stream_create(&stream, path, life, &report), OK);
        stream.write = planned_write;
        assert_int_equal(put_records(60), OK);
        assert_int_equal(stream_close(&stream, true, &report), E_FILE);
        assert_false(exists(path));
        const char *kept = stream_kept(&stream);
        assert_string_equal(report.text, arena_print(life, "cannot write '%s': Input/output error, after %lld bytes",
                                                     path, stream.written));
        const char *text = kept ? text_of(kept) : "";
        is_whole_beginning(text, all);
        assert_int_equal(strlen(text), stream.written);
        assert_true((int)strlen(text) > 100 * (k - 1) - 100 && (int)strlen(text) >= last);
        last = (int)strlen(text);
    }
    assert_true(last > 0);
}

static void file_size_limit(void **state)
{
    (void)state;
    const char *all = records(3000), *path = in_folder("limit");
    struct rlimit before, limit;
    getrlimit(RLIMIT_FSIZE, &before);
    limit = before;
    limit.rlim_cur = 70001;
    assert_int_equal(stream_create(&stream, path, life, &report), OK);
    setrlimit(RLIMIT_FSIZE, &limit);
    enum status putting = put_records(3000), closing = stream_close(&stream, true, &report);
    setrlimit(RLIMIT_FSIZE, &before);
    assert_int_equal(putting, E_FILE);
    assert_int_equal(closing, E_FILE);
    assert_string_equal(report.text,
                        arena_print(life, "cannot write '%s': File too large, after %lld bytes", path, stream.written));
    assert_false(exists(path));
    const char *text = text_of(stream_kept(&stream));
    is_whole_beginning(text, all);
    assert_in_range(strlen(text), 70001 - 90, 70001);
}

/* ---- stream: files ---- */

static void a_file_has_its_name_when_it_is_whole(void **state)
{
    (void)state;
    const char *path = in_folder("file"), *part = in_folder("file.part");
    write_text(path, "old");
    chmod(path, 0600);
    write_text(part, "a leftover, longer than what comes");
    assert_int_equal(stream_create(&stream, path, life, &report), OK);
    assert_int_equal(put_record(0), OK);
    assert_int_equal(stream_flush(&stream, &report), OK);
    assert_string_equal(text_of(path), "old");
    assert_string_equal(text_of(part), "0 \n");
    assert_int_equal(stream_close(&stream, true, &report), OK);
    assert_null(stream_kept(&stream));
    assert_false(exists(part));
    assert_string_equal(text_of(path), "0 \n");
    struct stat st;
    assert_int_equal(stat(path, &st), 0);
    assert_int_equal(st.st_mode & 0777, 0600);
}

static void a_stopped_run_leaves_the_old_file(void **state)
{
    (void)state;
    const char *path = in_folder("stopped");
    write_text(path, "old");
    assert_int_equal(stream_create(&stream, path, life, &report), OK);
    assert_int_equal(put_record(1), OK);
    assert_int_equal(stream_close(&stream, false, &report), OK);
    assert_string_equal(text_of(path), "old");
    assert_string_equal(stream_kept(&stream), in_folder("stopped.part"));
    assert_string_equal(text_of(stream_kept(&stream)), "1 .......\n");

    assert_int_equal(stream_create(&stream, in_folder("nothing"), life, &report), OK);
    assert_int_equal(stream_close(&stream, false, &report), OK);
    assert_null(stream_kept(&stream));
    assert_false(exists(in_folder("nothing.part")));
}

static void links_are_followed(void **state)
{
    (void)state;
    write_text(in_folder("real"), "old");
    assert_int_equal(symlink("real", in_folder("link")), 0);
    assert_int_equal(stream_create(&stream, in_folder("link"), life, &report), OK);
    assert_int_equal(put_record(0), OK);
    assert_int_equal(stream_close(&stream, true, &report), OK);
    assert_string_equal(text_of(in_folder("real")), "0 \n");
    struct stat st;
    assert_int_equal(lstat(in_folder("link"), &st), 0);
    assert_true(S_ISLNK(st.st_mode));

    assert_int_equal(symlink("real", in_folder("trap.part")), 0); /* but not where it writes */
    assert_int_equal(stream_create(&stream, in_folder("trap"), life, &report), E_FILE);
    assert_string_equal(text_of(in_folder("real")), "0 \n");
}

static void devices_are_written_directly(void **state)
{
    (void)state;
    assert_int_equal(stream_create(&stream, "/dev/null", life, &report), OK);
    assert_int_equal(put_records(10000), OK);
    assert_int_equal(stream_close(&stream, true, &report), OK);
    assert_false(exists("/dev/null.part"));
    assert_int_equal(stream_create(&stream, "/dev/full", life, &report), OK);
    assert_int_equal(put_record(1), OK);
    assert_int_equal(stream_close(&stream, true, &report), E_FILE);
    assert_null(stream_kept(&stream));
}

static void refused(const char *path, const char *words)
{
    report = (struct report){0};
    assert_int_equal(stream_create(&stream, path, life, &report), E_FILE);
    assert_string_equal(report.text, arena_print(life, "cannot write '%s': %s", path, words));
    assert_null(stream_kept(&stream));
    assert_int_equal(stream_close(&stream, true, &report), E_FILE);
}

static void what_cannot_be_written_is_said_at_once(void **state)
{
    (void)state;
    refused(in_folder("no/such/folder"), "No such file or directory");
    refused(folder, "Is a directory");
    if (geteuid() == 0) return; /* who may do everything */
    write_text(in_folder("mine"), "old");
    chmod(in_folder("mine"), 0400);
    refused(in_folder("mine"), "Permission denied");
    assert_string_equal(text_of(in_folder("mine")), "old");
}

static void two_runs_cannot_write_one_file(void **state)
{
    (void)state;
    const char *path = in_folder("both");
    struct stream other;
    assert_int_equal(stream_create(&stream, path, life, &report), OK);
    assert_int_equal(put_record(0), OK);
    assert_int_equal(stream_create(&other, path, life, &report), E_FILE);
    assert_string_equal(report.text,
                        arena_print(life, "cannot write '%s': another process is writing '%s.part'", path, path));
    report = (struct report){0};
    assert_int_equal(stream_close(&stream, true, &report), OK);
    assert_string_equal(text_of(path), "0 \n");
    assert_int_equal(stream_create(&other, path, life, &report), OK); /* the door is open again */
    assert_int_equal(stream_close(&other, false, &report), OK);
    assert_string_equal(text_of(path), "0 \n");
}

static void data_never_takes_the_place_of_a_standard_stream(void **state)
{
    (void)state;
    int input = dup(0);
    close(0);
    assert_int_equal(stream_create(&stream, in_folder("above"), life, &report), OK);
    bool above = stream.fd > 2;
    assert_int_equal(stream_close(&stream, false, &report), OK);
    if (input >= 0) {
        dup2(input, 0);
        close(input);
    }
    assert_true(above);
}

/* ---- writers ---- */

static const struct column columns[] = {{"t", "s", NULL}, {"hub.angle", "rad", NULL}, {"energy.residual", NULL, NULL}};
static const double rows[][3] = {{0, 0.1 + 0.2, -0.0}, {0.01, NAN, 1e-300}, {0.02, 1.0 / 3, -INFINITY}};

static struct run_meta example_meta(void)
{
    static struct pair settings[3];
    settings[0] = pair_text("scheme", "subcycle");
    settings[1] = pair_number("step", 1e-3);
    settings[2] = pair_bool("symmetric", false);
    return (struct run_meta){.version = "0.1",
                             .title = "A \"title\", with\ttab",
                             .deck = "bad\xff\xc3\xa9\xed\xa0\x80.yaml",
                             .hash = "00ff",
                             .nsettings = 3,
                             .settings = settings,
                             .n = 3,
                             .columns = columns};
}

static enum status tell_run(const char *format, int nrows, const char *how)
{
    struct run_meta meta = example_meta();
    struct pair facts[] = {pair_text("status", how), pair_number("steps", 1234567890123), pair_number("worst", NAN)};
    struct run_summary summary = {3, facts};
    struct sink sink = format_find(format)->open(&stream, life);
    TRY(sink.ops->meta(&sink, &meta, &report));
    for (int i = 0; i < nrows; i++) {
        TRY(sink.ops->row(&sink, rows[i], &report));
        if (i == 1) TRY(sink.ops->event(&sink, 0.015, "stop", "hub \\ meets\n\"wall\"", &report));
        if (i == 2) TRY(sink.ops->event(&sink, 0.02, "range", NULL, &report));
    }
    return sink.ops->end(&sink, &summary, &report);
}

static const char *told(const char *format, int nrows, const char *how)
{
    const char *path = in_folder(format);
    assert_int_equal(stream_create(&stream, path, life, &report), OK);
    assert_int_equal(tell_run(format, nrows, how), OK);
    assert_int_equal(stream_close(&stream, true, &report), OK);
    return text_of(path);
}

#define META                                                                                                           \
    "\"program\":\"fmdsub\",\"version\":\"0.1\",\"title\":\"A \\\"title\\\", with\\ttab\","                            \
    "\"deck\":\"bad\xef\xbf\xbd\xc3\xa9\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd.yaml\",\"hash\":\"00ff\","                 \
    "\"settings\":{\"scheme\":\"subcycle\",\"step\":0.001,\"symmetric\":false},"                                       \
    "\"units\":{\"t\":\"s\",\"hub.angle\":\"rad\",\"energy.residual\":null}"
#define COLUMNS "\"columns\":[\"t\",\"hub.angle\",\"energy.residual\"]"
#define EVENT1 "\"t\":0.015,\"kind\":\"stop\",\"text\":\"hub \\\\ meets\\n\\\"wall\\\"\"}\n"
#define EVENT2 "\"t\":0.02,\"kind\":\"range\",\"text\":null}\n"
#define FACTS "\"steps\":1234567890123,\"worst\":null}"

static void csv_has_a_header_and_rows(void **state)
{
    (void)state;
    assert_string_equal(told("csv", 3, "done"), "t,hub.angle,energy.residual\n"
                                                "0,0.30000000000000004,-0\n"
                                                "0.01,,1e-300\n"
                                                "0.02,0.3333333333333333,\n");
    assert_string_equal(told("csv", 0, "done"), "t,hub.angle,energy.residual\n");
}

static void ndjson_tells_all_line_by_line(void **state)
{
    (void)state;
    const char *text = told("ndjson", 3, "done");
    assert_string_equal(text,
                        "{\"type\":\"meta\"," META "," COLUMNS "}\n"
                        "{\"type\":\"row\",\"t\":0,\"hub.angle\":0.30000000000000004,\"energy.residual\":-0}\n"
                        "{\"type\":\"row\",\"t\":0.01,\"hub.angle\":null,\"energy.residual\":1e-300}\n"
                        "{\"type\":\"event\"," EVENT1
                        "{\"type\":\"row\",\"t\":0.02,\"hub.angle\":0.3333333333333333,\"energy.residual\":null}\n"
                        "{\"type\":\"event\"," EVENT2 "{\"type\":\"summary\",\"status\":\"done\"," FACTS "\n");
    for (const char *line = text; *line; line = strchr(line, '\n') + 1) {
        cJSON *item = cJSON_ParseWithLength(line, strcspn(line, "\n"));
        assert_non_null(item);
        assert_string_equal(item->child->string, "type");
        cJSON_Delete(item);
    }
}

static void json_is_one_object(void **state)
{
    (void)state;
    assert_string_equal(told("json", 3, "done"), "{\"meta\":{" META "},\n" COLUMNS ",\n"
                                                 "\"rows\":[\n"
                                                 "[0,0.30000000000000004,-0]\n"
                                                 ",[0.01,null,1e-300]\n"
                                                 ",[0.02,0.3333333333333333,null]\n"
                                                 "],\n"
                                                 "\"events\":[\n"
                                                 "{" EVENT1 ",{" EVENT2 "],\n"
                                                 "\"summary\":{\"status\":\"done\"," FACTS "}\n");
}

static void json_is_whole_whenever_the_run_stops(void **state)
{
    (void)state;
    for (int n = 0; n <= 3; n++) {
        cJSON *item = cJSON_ParseWithOpts(told("json", n, "no convergence"), NULL, 1);
        assert_non_null(item);
        assert_int_equal(cJSON_GetArraySize(cJSON_GetObjectItem(item, "rows")), n);
        assert_int_equal(cJSON_GetArraySize(cJSON_GetObjectItem(item, "events")), n > 1 ? n - 1 : 0);
        const cJSON *how = cJSON_GetObjectItem(cJSON_GetObjectItem(item, "summary"), "status");
        assert_string_equal(how->valuestring, "no convergence");
        cJSON_Delete(item);
    }
}

static void ndjson_refuses_a_column_called_type(void **state)
{
    (void)state;
    const struct column two[] = {{"t", "s", NULL}, {"type", NULL, NULL}};
    struct run_meta meta = {.n = 2, .columns = two};
    assert_int_equal(stream_create(&stream, in_folder("type"), life, &report), OK);
    struct sink sink = ndjson_open(&stream, life);
    assert_int_equal(sink.ops->meta(&sink, &meta, &report), E_DECK);
    assert_non_null(strstr(report.text, "'type'"));
    assert_int_equal(sink.ops->row(&sink, rows[0], &report), E_DECK);
    assert_int_equal(stream_close(&stream, false, &report), E_DECK);
}

/* Many columns, the longest numbers there are: within what was reserved, and nothing is taken from
 * the arena while the run runs. */
static void rows_take_no_memory(void **state)
{
    (void)state;
    enum { N = 4000 };
    struct column *many = TAKE(life, struct column, N);
    double *x = TAKE(life, double, N);
    for (int i = 0; i < N; i++) {
        many[i] = (struct column){.name = i ? arena_print(life, "body%d.angle", i) : "t"};
        x[i] = -1.2345678901234567e-308;
    }
    struct run_meta meta = {.n = N, .columns = many};
    for (const struct format *f = formats; f->name; f++) {
        assert_int_equal(stream_create(&stream, "/dev/null", life, &report), OK);
        struct sink sink = f->open(&stream, life);
        assert_int_equal(sink.ops->meta(&sink, &meta, &report), OK);
        size_t used = arena_used(life), room = stream.capacity;
        for (int i = 0; i < 30; i++) {
            assert_int_equal(sink.ops->row(&sink, x, &report), OK);
            assert_int_equal(sink.ops->event(&sink, i, "stop", "words", &report), OK);
            assert_int_equal(sink.ops->tick(&sink, 0.1 * i, &report), OK);
            assert_true(stream.used < STREAM_FULL);
        }
        assert_int_equal(arena_used(life), used);
        assert_int_equal(stream.capacity, room);
        assert_int_equal(stream_close(&stream, true, &report), OK);
        assert_true(stream.written > 30 * N * 24);
    }
}

static void ticks_send_rows(void **state)
{
    (void)state;
    for (const struct format *f = formats; f->name; f++) {
        struct run_meta meta = example_meta();
        const char *path = in_folder("row");
        assert_int_equal(stream_create(&stream, path, life, &report), OK);
        struct sink sink = f->open(&stream, life);
        assert_int_equal(sink.ops->meta(&sink, &meta, &report), OK);
        assert_int_equal(sink.ops->row(&sink, rows[0], &report), OK);
        assert_int_equal(sink.ops->tick(&sink, 5, &report), OK);
        assert_non_null(strstr(text_of(in_folder("row.part")), "0.30000000000000004"));
        assert_int_equal(stream_close(&stream, false, &report), OK);
    }
}

static void writers_pass_on_what_the_stream_says(void **state)
{
    (void)state;
    for (const struct format *f = formats; f->name; f++) {
        int ends[2];
        report = (struct report){0};
        assert_int_equal(pipe(ends), 0);
        close(ends[0]);
        assert_int_equal(stream_open(&stream, ends[1], "stdout", life, &report), OK);
        assert_int_equal(tell_run(f->name, 3, "done"), E_SIGPIPE);
        close(ends[1]);

        report = (struct report){0};
        assert_int_equal(stream_create(&stream, "/dev/full", life, &report), OK);
        struct sink sink = f->open(&stream, life);
        struct run_meta meta = example_meta();
        assert_int_equal(sink.ops->meta(&sink, &meta, &report), OK);
        assert_int_equal(sink.ops->tick(&sink, 1, &report), E_FILE);
        assert_int_equal(sink.ops->row(&sink, rows[0], &report), E_FILE);
        assert_int_equal(sink.ops->event(&sink, 0, "stop", "words", &report), E_FILE);
        assert_int_equal(sink.ops->tick(&sink, 2, &report), E_FILE);
        assert_int_equal(sink.ops->end(&sink, &(struct run_summary){0}, &report), E_FILE);
        assert_int_equal(stream_close(&stream, false, &report), E_FILE);
    }
}

static int budget; /* allocations that still succeed */

static void *short_malloc(size_t bytes)
{
    return budget-- > 0 ? malloc(bytes) : NULL;
}

/* Every allocation of cJSON fails once: one line, and what was written is whole records. */
static void any_allocation_may_fail(void **state)
{
    (void)state;
    cJSON_Hooks hooks = {short_malloc, free};
    for (int f = 1; formats[f].name; f++) {
        const char *path = in_folder("memory"), *all = told(formats[f].name, 3, "done");
        enum status status = E_LIMIT;
        int k = 0;
        for (; k < 1000 && status == E_LIMIT; k++) {
            report = (struct report){0};
            assert_int_equal(stream_create(&stream, path, life, &report), OK);
            budget = k;
            cJSON_InitHooks(&hooks);
            status = tell_run(formats[f].name, 3, "done");
            cJSON_InitHooks(NULL);
            assert_int_equal(stream_close(&stream, true, &report), status);
            if (status == OK) break;
            assert_string_equal(report.text, "out of memory");
            assert_false(exists(path));
            is_whole_beginning(stream_kept(&stream) ? text_of(stream_kept(&stream)) : "", all);
        }
        assert_int_equal(status, OK);
        assert_true(k > 50);
        assert_string_equal(text_of(path), all);
        unlink(path);
    }
}

static void formats_are_found_by_name(void **state)
{
    (void)state;
    assert_ptr_equal(format_find("csv"), &formats[0]);
    assert_string_equal(format_find("json")->name, "json");
    assert_null(format_find("xml"));
}

/* ---- table ---- */

static const struct table_column work[] = {
    {"scheme", NULL, 0}, {"ratio", NULL, 17}, {"error", NULL, 3}, {"time", "time [s]", 2}, {"note", NULL, 0}};

static struct table *example_table(void)
{
    struct table *table = table_open(work, 5, life);
    for (int i = 0; i < 40; i++) {
        table_text(table, i ? "subcycle" : "m\xc3\xaf\xc3\xa9");
        table_number(table, i ? 10 * i : 123456);
        table_number(table, i ? 1.2499999e-6 : NAN);
        table_number(table, 0.136);
        table_text(table, i == 1 ? "a, \"b\"" : "");
    }
    return table;
}

static void a_table_is_aligned(void **state)
{
    (void)state;
    const char *text = table_draw(example_table(), life);
    const char *head = "scheme     ratio    error  time [s]  note\n"
                       "--------  ------  -------  --------  ------\n"
                       "m\xc3\xaf\xc3\xa9       123456        -      0.14\n"
                       "subcycle      10  1.25e-6      0.14  a, \"b\"\n"
                       "subcycle      20  1.25e-6      0.14\n";
    assert_memory_equal(text, head, strlen(head));
    int lines = 0;
    for (const char *c = text; *c; c++) lines += *c == '\n';
    assert_int_equal(lines, 42);
}

static void a_table_is_csv(void **state)
{
    (void)state;
    const char *text = table_csv(example_table(), life);
    const char *head = "scheme,ratio,error,time,note\n"
                       "m\xc3\xaf\xc3\xa9,123456,,0.136,\n"
                       "subcycle,10,1.2499999e-6,0.136,\"a, \"\"b\"\"\"\n";
    assert_memory_equal(text, head, strlen(head));
}

static void a_table_that_cannot_be_printed_says_so(void **state)
{
    (void)state;
    FILE *full = fopen("/dev/full", "w");
    assert_int_equal(table_print(example_table(), TABLE_CSV, full, &report), E_FILE);
    assert_string_equal(report.text, "cannot write the table: No space left on device");
    fclose(full);
    const char *path = in_folder("table");
    FILE *file = fopen(path, "w");
    struct table *table = example_table();
    assert_int_equal(table_print(table, TABLE_DRAWN, file, &report), OK);
    fclose(file);
    assert_string_equal(text_of(path), table_draw(table, life));
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, fresh, done)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(full_buffers_leave_and_ticks_send_the_rest),
        TEST(long_records_pass),
        TEST(interruptions_and_short_writes_lose_nothing),
        TEST(pipes_get_atomic_pieces),
        TEST(a_pipe_that_does_not_block_is_waited_for),
        TEST(full_disk),
        TEST(closed_descriptor),
        TEST(reader_leaves),
        TEST(any_write_may_fail),
        TEST(file_size_limit),
        TEST(a_file_has_its_name_when_it_is_whole),
        TEST(a_stopped_run_leaves_the_old_file),
        TEST(links_are_followed),
        TEST(devices_are_written_directly),
        TEST(what_cannot_be_written_is_said_at_once),
        TEST(two_runs_cannot_write_one_file),
        TEST(data_never_takes_the_place_of_a_standard_stream),
        TEST(csv_has_a_header_and_rows),
        TEST(ndjson_tells_all_line_by_line),
        TEST(json_is_one_object),
        TEST(json_is_whole_whenever_the_run_stops),
        TEST(ndjson_refuses_a_column_called_type),
        TEST(rows_take_no_memory),
        TEST(ticks_send_rows),
        TEST(writers_pass_on_what_the_stream_says),
        TEST(any_allocation_may_fail),
        TEST(formats_are_found_by_name),
        TEST(a_table_is_aligned),
        TEST(a_table_is_csv),
        TEST(a_table_that_cannot_be_printed_says_so),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
