/* functions.c -- the functions an expression may call, and numbers as text. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "expr/code.h"
#include "expr/expr.h"

const struct expr_function expr_functions[] = {
    {"sin", 1, 1, OP_SIN, "sine of an angle in radians"},
    {"cos", 1, 1, OP_COS, "cosine"},
    {"tan", 1, 1, OP_TAN, "tangent"},
    {"asin", 1, 1, OP_ASIN, "angle in [-pi/2, pi/2] of a sine"},
    {"acos", 1, 1, OP_ACOS, "angle in [0, pi] of a cosine"},
    {"atan", 1, 1, OP_ATAN, "angle in [-pi/2, pi/2] of a tangent"},
    {"atan2", 2, 2, OP_ATAN2, "atan2(y, x): angle of the point (x, y)"},
    {"sinh", 1, 1, OP_SINH, "hyperbolic sine"},
    {"cosh", 1, 1, OP_COSH, "hyperbolic cosine"},
    {"tanh", 1, 1, OP_TANH, "hyperbolic tangent"},
    {"exp", 1, 1, OP_EXP, "e to the power of x"},
    {"log", 1, 1, OP_LOG, "natural logarithm"},
    {"log10", 1, 1, OP_LOG10, "logarithm to base 10"},
    {"sqrt", 1, 1, OP_SQRT, "square root"},
    {"abs", 1, 1, OP_ABS, "absolute value"},
    {"sign", 1, 1, OP_SIGN, "-1, 0 or 1"},
    {"min", 2, 16, OP_MIN, "least of two or more"},
    {"max", 2, 16, OP_MAX, "greatest of two or more"},
    {"floor", 1, 1, OP_FLOOR, "greatest whole number not above x"},
    {"ceil", 1, 1, OP_CEIL, "least whole number not below x"},
    {"mod", 2, 2, OP_MOD, "mod(x, y): x - y*floor(x/y), in [0, y) for y > 0"},
    {"pow", 2, 2, OP_POW, "pow(x, y): x^y"},
    {"hypot", 2, 2, OP_HYPOT, "hypot(x, y): sqrt(x^2 + y^2) without overflow"},
    {"step", 2, 2, OP_SINCE, "step(x, a): 0 before a, 1 from a on"},
    {"ramp", 3, 3, OP_RAMP, "ramp(x, a, b): 0 before a, 1 behind b, straight between"},
    {"smooth", 3, 3, OP_SMOOTH,
     "smooth(x, a, b): the same with no jump of the rate nor of the acceleration: 6 s^5 - 15 s^4 + 10 s^3, s = (x - "
     "a)/(b - a)"},
    {"pulse", 3, 3, OP_PULSE, "pulse(x, a, b): 1 from a to b, else 0"},
    {0},
};

bool expr_is_word(const char *name)
{
    static const char *const others[] = {"pi", "if", "and", "or", "not"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (!strcmp(name, others[i])) return true;
    for (const struct expr_function *f = expr_functions; f->name; f++)
        if (!op_is_since(f->op) && !strcmp(name, f->name)) return true;
    return false;
}

static size_t digits(const char *text)
{
    size_t n = 0;
    while (text[n] >= '0' && text[n] <= '9') n++;
    return n;
}

/* Bytes of the exponent at text, 0 if there is none; *wrong if it has no digits. */
static size_t exponent(const char *text, const char **wrong)
{
    if (*text != 'e' && *text != 'E') return 0;
    size_t sign = text[1] == '+' || text[1] == '-', n = digits(text + 1 + sign);
    if (!n) *wrong = "the exponent has no digits";
    return 1 + sign + n;
}

/* strtod reads a wider language (hexadecimal, nan, a locale's comma), so it gets only what was scanned. */
size_t expr_number(double *out, const char *text, const char **wrong)
{
    *wrong = NULL;
    *out = 0;
    size_t whole = digits(text), n = whole, fraction = 0;
    if (text[n] == '.') {
        fraction = digits(text + n + 1);
        if (whole + fraction) n += 1 + fraction;
    }
    if (whole + fraction == 0) return 0;
    if (whole == 1 && text[0] == '0' && (text[1] == 'x' || text[1] == 'X' || text[1] == 'o' || text[1] == 'b'))
        *wrong = "only decimal numbers are read";
    else if (whole > 1 && text[0] == '0')
        *wrong = "a number does not begin with 0";
    n += exponent(text + n, wrong);
    if (*wrong) return n;
    errno = 0;
    *out = strtod(text, NULL);
    if (isinf(*out))
        *wrong = "out of range: the largest number is 1.8e308";
    else if (errno == ERANGE && *out == 0)
        *wrong = "out of range: the smallest number is 4.9e-324";
    return n;
}
