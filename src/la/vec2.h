/* vec2.h -- vectors in the plane.  Outputs come first and may not overlap the inputs. */
#ifndef FMDSUB_LA_VEC2_H
#define FMDSUB_LA_VEC2_H

static inline double v2_dot(const double *x, const double *y)
{
    return x[0] * y[0] + x[1] * y[1];
}

static inline double v2_cross(const double *x, const double *y)
{
    return x[0] * y[1] - x[1] * y[0];
}

/* y := x turned by the angle of cosine cs[0] and sine cs[1]; turned back by it. */
static inline void v2_turn(double *y, const double *cs, const double *x)
{
    y[0] = cs[0] * x[0] - cs[1] * x[1];
    y[1] = cs[1] * x[0] + cs[0] * x[1];
}

static inline void v2_turn_back(double *y, const double *cs, const double *x)
{
    y[0] = cs[0] * x[0] + cs[1] * x[1];
    y[1] = cs[0] * x[1] - cs[1] * x[0];
}

#endif
