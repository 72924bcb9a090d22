/* operations.h -- what the machine can do, once for all kinds of numbers: private to this folder.
 *
 * Each list is a macro over its operations.  Of one argument a, and of two, a and b, it gives the value f and the
 * derivatives of it: f1, f2; fa, fb, faa, fab, fbb, where later ones may use those before them by name.  A derivative
 * is used only where its argument moves, so it may be infinite elsewhere; what is dear asks b_moves() first. */
#ifndef FMDSUB_EXPR_OPERATIONS_H
#define FMDSUB_EXPR_OPERATIONS_H

#include <math.h>
#include <stdbool.h>

#define LOG_OF_10 2.302585092994045684

static inline double op_sign(double x)
{
    return x != x ? x : (double)((x > 0) - (x < 0));
}

/* Of a and b; of what is not a number nothing is known. */
static inline double op_relation(bool is, double a, double b)
{
    return a != a || b != b ? NAN : is;
}

/* x/(a^2 + b^2), without overflow. */
static inline double op_over_square(double x, double a, double b)
{
    double r = hypot(a, b);
    return x / r / r;
}

/* Is x in [0, 1)?  Derivatives are those of the right. */
static inline bool op_on_way(double x)
{
    return x >= 0 && x < 1;
}

/* x held in [0, 1], and from 0 to 1 with no first and second derivative at both: x^3 (10 - 15 x + 6 x^2). */
static inline double op_held(double x)
{
    return x < 0 ? 0 : x > 1 ? 1 : x;
}

static inline double op_smooth(double x)
{
    const double u = op_held(x), v = 1 - u;
    return u < .5 ? u * u * u * (10 + u * (6 * u - 15)) : 1 - v * v * v * (10 + v * (6 * v - 15));
}

/* clang-format off */

/* OP, f, f1, f2 */
#define FUNCTIONS(X) \
    X(NEG,    -a,        -1,                            0) \
    X(SQUARE, a * a,     2 * a,                         2) \
    X(CUBE,   a * a * a, 3 * a * a,                     6 * a) \
    X(SIN,    sin(a),    cos(a),                        -f) \
    X(COS,    cos(a),    -sin(a),                       -f) \
    X(TAN,    tan(a),    1 + f * f,                     2 * f * f1) \
    X(ASIN,   asin(a),   1 / sqrt((1 - a) * (1 + a)),   a * f1 * f1 * f1) \
    X(ACOS,   acos(a),   -1 / sqrt((1 - a) * (1 + a)),  a * f1 * f1 * f1) \
    X(ATAN,   atan(a),   1 / (1 + a * a),               -2 * a * f1 * f1) \
    X(SINH,   sinh(a),   cosh(a),                       f) \
    X(COSH,   cosh(a),   sinh(a),                       f) \
    X(TANH,   tanh(a),   1 / cosh(a) / cosh(a),         -2 * f * f1) \
    X(EXP,    exp(a),    f,                             f) \
    X(LOG,    log(a),    1 / a,                         -1 / (a * a)) \
    X(LOG10,  log10(a),  1 / (a * LOG_OF_10),           -1 / (a * a * LOG_OF_10)) \
    X(SQRT,   sqrt(a),   .5 / f,                        -.25 / (f * a)) \
    X(ABS,    fabs(a),   op_sign(a),                    0) \
    X(RAMP,   op_held(a), op_on_way(a),                 0) \
    X(SMOOTH, op_smooth(a), op_on_way(a) ? 30 * a * a * (1 - a) * (1 - a) : 0, \
                         op_on_way(a) ? 60 * a * (1 - a) * (1 - 2 * a) : 0)

/* Constant from step to step: OP, f */
#define STEPS(X) \
    X(NOT,   1 - a) \
    X(SIGN,  op_sign(a)) \
    X(FLOOR, floor(a)) \
    X(CEIL,  ceil(a)) \
    X(SINCE, op_relation(a >= 0, a, a)) \
    X(PULSE, op_relation(op_on_way(a), a, a))

/* OP, f, fa, fb, faa, fab, fbb; the first four as OP_ADD_CONST ... OP_DIV_SLOT too.  Of a^b: b a^(b-1) in a, a^b log a
 * in b; at a = 0 the latter is 0 for b > 0.  Of atan2(a, b): (b da - a db)/(a^2 + b^2). */
#define PAIRS(X) \
    X(ADD,   a + b,       1,                       1,                                    0, 0, 0) \
    X(SUB,   a - b,       1,                       -1,                                   0, 0, 0) \
    X(MUL,   a * b,       b,                       a,                                    0, 1, 0) \
    X(DIV,   a / b,       1 / b,                   -f / b,                               0, -fa * fa, -2 * fa * fb) \
    X(POW,   pow(a, b),   b == 0 ? 0 : b * pow(a, b - 1), \
                          !b_moves() || (a == 0 && b > 0) ? 0 : f * log(a), \
                          b == 0 || b == 1 ? 0 : b * (b - 1) * pow(a, b - 2), \
                          b_moves() ? pow(a, b - 1) * (1 + b * log(a)) : 0, \
                          fb == 0 ? 0 : fb * log(a)) \
    X(MOD,   a - b * floor(a / b), 1,              -floor(a / b),                        0, 0, 0) \
    X(ATAN2, atan2(a, b), op_over_square(b, a, b), -op_over_square(a, a, b),             2 * fa * fb, \
                          fb * fb - fa * fa,       -2 * fa * fb) \
    X(HYPOT, hypot(a, b), f > 0 ? a / f : 0,       f > 0 ? b / f : 0,                    f > 0 ? fb * fb / f : 0, \
                          f > 0 ? -fa * fb / f : 0, f > 0 ? fa * fa / f : 0)

/* One of the two: OP, is it b?  A NaN stays one. */
#define CHOICES(X) \
    X(MIN, a > b || b != b) \
    X(MAX, a < b || b != b)

/* OP, f = 1 or 0; NaN where it is not known.  The operands of the last two are such. */
#define TRUTHS(X) \
    X(LT,  op_relation(a < b, a, b)) \
    X(LE,  op_relation(a <= b, a, b)) \
    X(GT,  op_relation(a > b, a, b)) \
    X(GE,  op_relation(a >= b, a, b)) \
    X(EQ,  op_relation(a == b, a, b)) \
    X(NE,  op_relation(a != b, a, b)) \
    X(AND, a == 0 || b == 0 ? 0 : a * b) \
    X(OR,  a == 1 || b == 1 ? 1 : a + b)

/* clang-format on */

#endif
