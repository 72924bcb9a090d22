/* wide.h -- loops compiled for the vectors that a processor may have.
 *
 * Only for loops whose sums do not depend on how many numbers are taken at once: the same bits everywhere. */
#ifndef FMDSUB_LA_WIDE_H
#define FMDSUB_LA_WIDE_H

#include "base/inline.h"

/* The loops worth three compilations; the choice is made once, when the program is loaded.  What is reached is counted in
 * one: a processor takes no other. */
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__gnu_linux__) &&                       \
    !defined(__SANITIZE_ADDRESS__) && !defined(COVERAGE)
#define WIDE __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define WIDE
#endif

/* Their kernels are INTO: called, they would be of the plain copy, and gcc 12 then leaves the upper halves of the
 * registers in use at the end (no vzeroupper), which slows all that runs afterwards. */

#endif
