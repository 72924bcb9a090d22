#!/usr/bin/env python3
"""Writes circle.c: `python3 circle.py > circle.c`; prints the constants of turned.h.  Fractions throughout, rounded once.

pi by Machin's formula, cos and sin by their series.
"""
import sys
from fractions import Fraction

N = 256
HEAD = 32  # bits of the first part of 2 pi/N


def arctan_of_inverse(n):
    x, total, k = Fraction(1, n), Fraction(0), 0
    while x > Fraction(1, 10**60):
        total += x / (2 * k + 1) * (-1) ** k
        x, k = x / (n * n), k + 1
    return total


PI = 16 * arctan_of_inverse(5) - 4 * arctan_of_inverse(239)


def series(x, k):
    term, total = (Fraction(1), Fraction(0)) if k == 0 else (x, Fraction(0))
    while abs(term) > Fraction(1, 10**50):
        total += term
        term = -term * x * x / ((k + 1) * (k + 2))
        term = Fraction(round(term * 10**60), 10**60)
        k += 2
    return total


def point(i):
    """cos, sin of 2 pi i/N from the first octant."""
    if i > N // 2:
        c, s = point(N - i)
        return c, -s
    if i > N // 4:
        c, s = point(N // 2 - i)
        return -c, s
    if i > N // 8:
        c, s = point(N // 4 - i)
        return s, c
    x = Fraction(round(2 * PI * i / N * 10**60), 10**60)
    return float(series(x, 0)), float(series(x, 1))


step = 2 * PI / N
unit = Fraction(1, 2 ** (HEAD + 6))  # step is 2^-5.3: so many bits
head = (step / unit).__floor__() * unit

print("turned.h: CIRCLE_HEAD %s, CIRCLE_REST %s, CIRCLE_PER %s" % (float(head).hex(), float(step - head).hex(), float(1 / step).hex()), file=sys.stderr)
print("""/* circle.c -- cosine and sine of angles round the circle, made by circle.py; t-turned checks every line */
#include "la/turned.h"

const double circle[CIRCLE][2] = {""")
for i in range(N):
    print("    {%s, %s}," % tuple(x.hex() for x in point(i)))
print("};")
