/* replay.c -- a harness fed with the files named, each said before it is read: the last is the one that ends it. */
#include <stdio.h>
#include <stdlib.h>

#include "fuzz/fuzz.h"

int main(int argc, char **argv)
{
    for (int i = 1; i < argc; i++) {
        FILE *file = fopen(argv[i], "rb");
        PROMISE(file);
        PROMISE(fseek(file, 0, SEEK_END) == 0);
        long size = ftell(file);
        PROMISE(size >= 0);
        rewind(file);
        uint8_t *data = malloc((size_t)size + !size); /* exact, for the sanitizer */
        PROMISE(data && fread(data, 1, (size_t)size, file) == (size_t)size);
        fclose(file);
        printf("%s\n", argv[i]);
        fflush(stdout);
        LLVMFuzzerTestOneInput(data, (size_t)size);
        free(data);
    }
    printf("read %d\n", argc - 1);
    return 0;
}
