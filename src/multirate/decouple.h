/* decouple.h -- the transformation P that removes the inertia coupling of slow and fast coordinates.
 *
 *     W = M_LL^-1 M_LS,   P = [1 -W; 0 1] (slow first),   v = P (u, v_S)                                    (S1)
 *
 * makes P' M^ P = diag(M_LL, M~_SS), M~_SS = M_SS - M_SL W: the fast part sits on its free, recoiling base.  In
 * memory S = [0,ns) comes first.
 *
 * Where the owner factors M^ by structure, W comes from its inverse Z, of which the columns of S are
 * solved for:
 *
 *     M~_SS = Z_SS^-1,   W = -Z_LS Z_SS^-1,   M_LL^-1 b = z_L + W z_S with z = M^^-1 (0, b),
 *
 * all in O(n); else M^ is formed and M_LL factored.  Rows of W from `reach` on are zero: slow coordinates that the
 * fast ones do not push by inertia.
 *
 * The slow bodies' part of the inertia of x is what M~_SS holds more than the fast bodies bring: with P_S the
 * columns of S, M_f P_S = (r_fast(a = P_S) - r_fast(a = 0)), of which (M^ P_S)_L = 0 leaves
 *
 *     M_s W = (M_f P_S)_L,   W' M_s W,
 *
 * so that no slow body is asked.  Where M_f is formed in one pass it gives that at once, or M_s itself where all slow
 * coordinates are near the fast bodies, since then slow bodies are fewer than what moves with the fast ones; else the rows are given one by
 * one where there are fewer slow coordinates than fast ones, by (M_f P_S)_L = (M_f)_LS - (M_f)_LL W and the symmetry of
 * M_f. */
#ifndef FMDSUB_MULTIRATE_DECOUPLE_H
#define FMDSUB_MULTIRATE_DECOUPLE_H

#include "base/arena.h"
#include "base/inline.h"
#include "base/recall.h"
#include "engine/stepper.h"
#include "la/dense.h"

enum { FEW = 6 };

/* f(ns, ...), f written into its caller: for one to three fast coordinates with that number as a constant, since loops over so
 * few cost more to begin than to run. */
#define BY_FEW(f, ns, ...)                                                                                             \
    ((ns) == 2 ? f(2, __VA_ARGS__) : (ns) == 1 ? f(1, __VA_ARGS__) : (ns) == 3 ? f(3, __VA_ARGS__) : f(ns, __VA_ARGS__))

/* y [rows] += s A x, A [rows x cols]: dense_gemv() where most often both are a few, to the same bits. */
INTO static inline void gemv_few(double *restrict y, double s, const double *restrict A, const double *restrict x,
                                 int rows, int cols, int ld)
{
    if (rows > (cols == 2 ? 4 * FEW : FEW)) {
        dense_gemv(y, s, A, x, rows, cols, ld);
    } else if (rows == 1) {
        double sum = y[0];
        for (int j = 0; j < cols; j++, A += ld) sum += A[0] * (s * x[j]);
        y[0] = sum;
    } else if (cols == 1) {
        const double a = s * x[0];
        for (int i = 0; i < rows; i++) y[i] += A[i] * a;
    } else if (cols == 2 && rows == 2) {
        const double *restrict B = A + ld, a = s * x[0], b = s * x[1];
        y[0] = y[0] + A[0] * a + B[0] * b;
        y[1] = y[1] + A[1] * a + B[1] * b;
    } else if (cols == 2) {
        const double *restrict B = A + ld, a = s * x[0], b = s * x[1];
        for (int i = 0; i < rows; i++) y[i] = y[i] + A[i] * a + B[i] * b;
    } else if (cols == 3 && rows == 3) {
        const double *restrict B = A + ld, *restrict C = B + ld, a = s * x[0], b = s * x[1], c = s * x[2];
        y[0] = y[0] + A[0] * a + B[0] * b + C[0] * c;
        y[1] = y[1] + A[1] * a + B[1] * b + C[1] * c;
        y[2] = y[2] + A[2] * a + B[2] * b + C[2] * c;
    } else {
        for (int i = 0; i < rows; i++) {
            double sum = y[i];
            for (int j = 0; j < cols; j++) sum += A[i + (long)j * ld] * (s * x[j]);
            y[i] = sum;
        }
    }
}

/* y [rows] := x + s A e, likewise; many: where they are more. */
void gemv_from_many(double *y, const double *x, double s, const double *A, const double *e, int rows, int cols, int ld);
INTO static inline void gemv_from(double *restrict y, const double *restrict x, double s, const double *restrict A,
                                  const double *restrict e, int rows, int cols, int ld)
{
    if (cols != 2 || rows > 4 * FEW) {
        gemv_from_many(y, x, s, A, e, rows, cols, ld);
    } else {
        const double *restrict B = A + ld, a = s * e[0], b = s * e[1];
        for (int i = 0; i < rows; i++) y[i] = x[i] + A[i] * a + B[i] * b;
    }
}

struct decouple {
    const struct ode2 *ode;
    struct effort *effort;
    struct arena *life;
    int n, ns, nl;
    int ml;            /* slow coordinates that fast bodies and elements know */
    int structured;    /* M^ is factored by its owner; M and L are not used */
    int reach;         /* rows of W from here on are zero; 0: no common inertia */
    double *W;         /* [nl x ns] */
    double *Mss;       /* [ns x ns] M~_SS */
    double *MsW;       /* [ml x ns] */
    double *WMW;       /* [ns x ns] W' M_s W */
    double *M;         /* [n x n]; as L, NULL as long as the owner's structure serves */
    double *L;         /* [nl x nl] Cholesky factor of M_LL */
    void *F;           /* the owner's factor of M^ */
    double limbs;      /* share of the bodies that stands on limbs of the ground with fast coordinates */
    double *there;     /* [nq] where all limbs were factored last; NULL: they are in each step */
    bool lags;         /* of F only limbs with fast coordinates are of this step */
    double moved, far; /* how far slow coordinates have moved from `there`, in usual changes; how far they may */
    double *Mf;        /* [n x n] M_f, or M_s; NULL: it is not formed */
    double *none;      /* [n] zeros */
    double *z, *r, *a; /* [n] */
    double *row, *Z;   /* [ns], [ns x ns] */
};

void decouple_open(struct decouple *p, const struct ode2 *ode, struct effort *effort, struct arena *life);
/* What becomes of M_LL of limbs without fast coordinates, which only the iteration feels: made anew; so where these have moved
 * far; left as it is. */
enum others { ANEW, WHERE_FAR, LEFT };
/* W, M~_SS, M_s W and W' M_s W at x (q, v, t). */
enum status decouple_at(struct decouple *p, const struct instant *x, enum others others, struct trouble *why);
/* A step was solved by `count` iterations, of which each left `rate` of the corrections; in the last one coordinate `worst` was
 * corrected most. */
void decouple_solved(struct decouple *p, int count, int worst, double rate);
/* It does not converge, or asks for new matrices. */
void decouple_failed(struct decouple *p);
/* What limbs keep from step to step. */
void decouple_recall(struct decouple *p, struct recall *r);
/* From now on M^ is formed, whatever structure its owner has. */
void decouple_dense(struct decouple *p);

/* y [nl] += s W x. */
void decouple_recoil(const struct decouple *p, double *y, double s, const double *x);
/* out [ns + m] = P (y, x), the first m slow coordinates; x = out is allowed. */
void decouple_out(const struct decouple *p, double *out, const double *y, const double *x, int m);
/* v and a [ns + m] := P (y, v) and P (b, a), where they have their fast rows. */
void decouple_both(const struct decouple *p, double *v, double *a, const double *y, const double *b, int m);
/* Where a minor step is half-way: as above, and q1 [ns + m] = q0 + P (s y, x), x [ns]. */
struct decouple_there {
    double *v, *a, *q1;
    const double *q0, *x, *y, *b;
    double s;
};

/* In one pass where few coordinates are fast. */
void decouple_there(const struct decouple *p, const struct decouple_there *o, int m);
/* q [ns + m] += s P (y, v), likewise; v [ns]. */
void decouple_on(const struct decouple *p, double *q, double s, const double *y, const double *v, int m);
/* rs [ns] := the fast rows of P' r, where r has its first m slow rows. */
void decouple_fast(const struct decouple *p, double *rs, const double *r, int m);
/* K [n x n] := P' K P, where K has its first m slow rows and columns. */
void decouple_slopes(const struct decouple *p, double *K, int m);
/* x [nl] := M_LL^-1 x; structured, or where W is not zero. */
void decouple_slow(struct decouple *p, double *x);

#endif
