/* hash.h -- FNV-1a, 64 bits: tells texts apart that differ by mistake, not by malice. */
#ifndef FMDSUB_BASE_HASH_H
#define FMDSUB_BASE_HASH_H

#include <stddef.h>
#include <stdint.h>

static const uint64_t HASH_NOTHING = 14695981039346656037u;

static inline uint64_t hash_bytes(uint64_t hash, const void *bytes, size_t len)
{
    const unsigned char *p = bytes;
    for (size_t i = 0; i < len; i++) hash = (hash ^ p[i]) * 1099511628211u;
    return hash;
}

#endif
