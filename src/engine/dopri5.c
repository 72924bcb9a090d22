/* dopri5.c -- Dormand & Prince 5(4), steps of its own by the error of the embedded method
 *
 * Coefficients: Dormand & Prince, J. Comput. Appl. Math. 6 (1980).  PI step control: Hairer, Norsett & Wanner, Solving
 * Ordinary Differential Equations I and II, II.4 and IV.2. */
#include "engine/embedded.h"

/* Weights of order 5 less those of order 4. */
static const double e[] = {71. / 57600, 0, -71. / 16695, 71. / 1920, -17253. / 339200, 22. / 525, -1. / 40};

/* Hairer, Norsett & Wanner I, II.6. */
static const double d[][RK_STAGES] = {{-12715105075. / 11282082432, 0, 87487479700. / 32700410799,
                                       -10690763975. / 1880347072, 701980252875. / 199316789632,
                                       -1453857185. / 822651844, 69997945. / 29380423}};

static const struct embedded_pair pair = {
    .scheme = {.stages = 7, .order = 5, .sharper = 1. / 5, EMBEDDED, .between = embedded_between, .between_from = 1e-6},
    .table = {.stages = 7,
              .c = {0, 1. / 5, 3. / 10, 4. / 5, 8. / 9, 1, 1},
              .a = {{0},
                    {1. / 5},
                    {3. / 40, 9. / 40},
                    {44. / 45, -56. / 15, 32. / 9},
                    {19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729},
                    {9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656},
                    {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84}},
              .b = {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84, 0}},
    .e = e,
    .bends = 1,
    .d = d,
    .here = .17,
    .before = .04,
    .fail = .2,
    .least = .2,
    .most = 5,
    .part =
        .053, /* ten orbits of eccentricity .3 to .8, ten seconds of a four-bar: below 100 tolerances from 1e-3 on */
    .power = .85,
    .less = 4.5,
};

const struct stepper_kind step_dopri5 = {
    .name = "dopri5",
    .brief = "Dormand-Prince 5(4), explicit, steps of its own inside H",
    .order = 5,
    .formulas = &pair,
    ADAPTIVE,
};
