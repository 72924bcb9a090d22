/* fuzz.h -- what the harnesses share.
 *
 * Each is LLVMFuzzerTestOneInput() of one reader: it reads any bytes, and what it makes of them keeps the promises that
 * are tested here.  clang's libFuzzer looks for bytes that break one (make fuzz); replay.c feeds it files. */
#ifndef FMDSUB_TESTS_FUZZ_H
#define FMDSUB_TESTS_FUZZ_H

#include <stddef.h>
#include <stdint.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Ends the program unless it holds. */
#define PROMISE(holds)                                                                                                 \
    do {                                                                                                               \
        if (!(holds)) broken(__FILE__, __LINE__, #holds);                                                              \
    } while (0)
_Noreturn void broken(const char *file, int line, const char *promise);

/* The path of a file of those bytes, in a folder of its own that goes when the program ends. */
const char *put_bytes(const char *name, const void *data, size_t size);
const char *put_text(const char *name, const char *text);
/* The same of a file of the project, by its path there. */
const char *put_copy(const char *name, const char *from);

#endif
