/* whole.h -- all of an open file or pipe, at once. */
#ifndef FMDSUB_BASE_WHOLE_H
#define FMDSUB_BASE_WHOLE_H

#include <stddef.h>

#include "base/arena.h"
#include "base/status.h"

/* text: [len + 1] with a 0 behind; at most max bytes: E_LIMIT beyond, E_FILE.  Takes memory for what comes, never for what is
 * announced.  path: for messages. */
enum status whole_read(char **text, size_t *len, int fd, const char *path, size_t max, struct arena *arena,
                       struct report *report);

#endif
