/* reach.c -- what a process can open once a deck is read, put between a program and libyaml by LD_PRELOAD: a parser that
 * somebody has taken over.
 *
 * REACH="r:PATH w:PATH ..."   tried when a parser is made: "PATH: opened" or "PATH: refused" on stderr. */
#include <dlfcn.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void try(const char *word)
{
    const int fd = open(word + 2, *word == 'w' ? O_WRONLY | O_CREAT | O_CLOEXEC : O_RDONLY | O_CLOEXEC, 0666);
    fprintf(stderr, "%s: %s\n", word, fd < 0 ? "refused" : "opened");
    if (fd >= 0) close(fd);
}

int yaml_parser_initialize(void *parser);

int yaml_parser_initialize(void *parser)
{
    static int (*next)(void *);
    const char *list = getenv("REACH");
    if (!next) *(void **)&next = dlsym(RTLD_NEXT, "yaml_parser_initialize");
    if (list) {
        char *copy = strdup(list), *rest = copy;
        for (char *word; (word = strsep(&rest, " "));) try(word);
        free(copy);
    }
    return next(parser);
}
