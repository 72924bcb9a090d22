/* mechanism.c -- prints the mechanism of a seed as a deck.
 *
 *     mechanism SEED [reversed] [renamed] [turned] */
#include <stdlib.h>
#include <string.h>

#include "mechanism.h"

int main(int argc, char **argv)
{
    static struct mechanism m;
    struct variant v = {false, false, false};

    if (argc < 2) {
        fputs("usage: mechanism SEED [reversed] [renamed] [turned]\n", stderr);
        return 2;
    }
    for (int i = 2; i < argc; i++) {
        v.reversed |= strcmp(argv[i], "reversed") == 0;
        v.renamed |= strcmp(argv[i], "renamed") == 0;
        v.turned |= strcmp(argv[i], "turned") == 0;
    }
    mechanism_draw(&m, strtoull(argv[1], NULL, 10));
    mechanism_write(stdout, &m, &v);
    return 0;
}
