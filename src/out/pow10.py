#!/usr/bin/env python3
"""Writes pow10.h: `python3 pow10.py > pow10.h`.  Exact integers throughout.

g(k) = ceil(10^k 2^-r), r = floor(log2 10^k) - 127, so 2^127 <= g < 2^128.
"""
FIRST, LAST = -292, 324


def scaled(k):
    if k >= 0:
        r = (10**k).bit_length() - 128
        return -(-(10**k) >> r) if r > 0 else 10**k << -r
    ten = 10**-k  # never a power of two: floor(log2 10^k) = -bit_length
    r = ten.bit_length() + 127
    return -(-(1 << r) // ten)


print("""/* pow10.h -- powers of ten to 128 bits, made by pow10.py; t-number checks every line.
 *
 *     g(k) = ceil(10^k 2^-r),   r = floor(log2 10^k) - 127,   2^127 <= g(k) < 2^128
 */
#ifndef FMDSUB_OUT_POW10_H
#define FMDSUB_OUT_POW10_H

#include <stdint.h>

enum { POW10_FIRST = %d, POW10_LAST = %d };

/* High and low half of g(k) at k - POW10_FIRST. */
static const uint64_t pow10_table[POW10_LAST - POW10_FIRST + 1][2] = {""" % (FIRST, LAST))
for k in range(FIRST, LAST + 1):
    g = scaled(k)
    assert g.bit_length() == 128
    print("    {0x%016x, 0x%016x}, /* %d */" % (g >> 64, g & (2**64 - 1), k))
print("""};

#endif""")
