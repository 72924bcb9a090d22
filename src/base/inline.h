/* inline.h -- functions that are written into their callers, and those that are not. */
#ifndef FMDSUB_BASE_INLINE_H
#define FMDSUB_BASE_INLINE_H

/* INTO static inline: into each of its callers. */
#if defined(__GNUC__)
#define INTO __attribute__((always_inline))
#else
#define INTO
#endif

/* What is rare: a call, so that what is frequent does not make ready for it. */
#if defined(__GNUC__)
#define APART __attribute__((noinline)) static
#else
#define APART static
#endif

#endif
