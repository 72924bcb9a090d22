/* loads.c -- see loads.h, prestress.h */
#include "reduce/loads.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "la/vec3.h"
#include "out/stream.h"
#include "out/targets.h"
#include "reduce/hold.h"
#include "reduce/prestress.h"

const char *const load_names[LOAD_KINDS] = {"accel-x", "accel-y", "accel-z", "spin-xx", "spin-yy", "spin-zz",
                                            "spin-xy", "spin-xz", "spin-yz", "twist-x", "twist-y", "twist-z"};

int load_kind(const char *name)
{
    for (int k = 0; k < LOAD_KINDS; k++)
        if (strcmp(name, load_names[k]) == 0) return k;
    return -1;
}

const char *load_list(void)
{
    return "accel-x, -y, -z, spin-xx, -yy, -zz, -xy, -xz, -yz, twist-x, -y, -z";
}

static void spin_axis(double *e, int k)
{
    static const int pair[3][2] = {{0, 1}, {0, 2}, {1, 2}};
    v3_set(e, 0, 0, 0);
    if (k < 3)
        e[k] = 1;
    else
        e[pair[k - 3][0]] = e[pair[k - 3][1]] = sqrt(0.5);
}

/* b [3]: load per mass at r from the centre of mass. */
static void density(double *b, int kind, const double *r)
{
    double e[3] = {0}, across[3];
    if (kind >= LOAD_SPIN && kind < LOAD_TWIST) {
        spin_axis(e, kind - LOAD_SPIN);
        v3_cross(across, r, e);
        v3_cross(b, e, across); /* - e x (e x r) */
        return;
    }
    e[kind % 3] = 1;
    if (kind < LOAD_SPIN)
        v3_scale(b, -1, e);
    else
        v3_cross(b, r, e);
}

void load_forces(double *f, const struct fe *fe, int kind, struct arena *scratch)
{
    double *b = TAKE(scratch, double, 3 * (size_t)fe->n);
    for (int i = 0; i < fe->n; i++) {
        double r[3];
        v3_diff(r, fe->x + 3 * i, fe->centre);
        density(b + 3 * i, kind, r);
    }
    sparse_mul(f, &fe->M, b);
}

/* 1 N along k at the tie: so that its power is that of the tie's own motion, f = A' e_k. */
void load_interface(double *f, const struct fe *fe, const struct tie *tie, int k)
{
    memset(f, 0, 3 * (size_t)fe->n * sizeof *f);
    for (int i = 0; i < tie->ngauge; i++)
        for (int a = 0; a < 3; a++) f[3 * tie->gauge[i] + a] = tie->A[6 * (3 * i + a) + k];
}

/* The power of ten that moves the held body by 1e-6 of its size at most. */
static double scale_of(const double *f, const struct hold *hold, double *u)
{
    double most = 0;
    hold_solve(u, hold, f);
    for (int i = 0; i < hold->size; i++) most = fmax(most, fabs(u[i]));
    return most > 0 ? pow(10, floor(log10(1e-6 * hold->fe->size / most))) : 1;
}

static enum status write_file(const char *path, const char *kind, double scale, const double *f, const struct fe *fe,
                              struct arena *life, struct report *report)
{
    const struct fe_units *u = &fe->units;
    double unit = u->time * u->time / (u->mass * u->length), least = 0; /* [N] in units of the mesh */
    struct stream stream;
    for (int i = 0; i < 3 * fe->n; i++) least = fmax(least, 1e-15 * fabs(f[i]));
    TRY(stream_create(&stream, path, life, report));
    const char *head = arena_print(life, "** %s, %g times the unit load\n*CLOAD\n", kind, scale);
    enum status status = stream_put(&stream, head, strlen(head), report);
    for (int i = 0; status == OK && i < 3 * fe->n; i++) {
        char line[80];
        if (fabs(f[i]) <= least) continue;
        int n = snprintf(line, sizeof line, "%d,%d,%.12e\n", fe->id[i / 3], i % 3 + 1, f[i] * scale * unit);
        status = stream_put(&stream, line, (size_t)n, report);
    }
    return stream_finish(&stream, status, report);
}

static enum status write_one(const char *path, const char *kind, const double *f, double *u, const struct hold *hold,
                             struct arena *life, struct report *report)
{
    double scale = scale_of(f, hold, u);
    TRY(write_file(path, kind, scale, f, hold->fe, life, report));
    fprintf(stderr, "%s: --prestress %s:%g=\n", path, kind, scale);
    return OK;
}

/* The files of all kinds, in their order; none may be one that was read. */
static enum status name_files(struct target **out, const char *prefix, const struct fe *fe, const struct tie *tie,
                              int ntie, struct arena *life, struct report *report)
{
    struct target *file = TAKE(life, struct target, LOAD_KINDS + 3 * ntie);
    int n = 0;
    for (int kind = 0; kind < LOAD_KINDS; kind++)
        file[n++].path = arena_print(life, "%s-%s.inp", prefix, load_names[kind]);
    for (int t = 1; t < ntie; t++)
        for (int k = 0; k < 3; k++)
            file[n++].path = arena_print(life, "%s-force-%c-%s.inp", prefix, "xyz"[k], tie[t].name);
    for (int i = 0; i < n; i++) {
        file[i].option = "--loads";
        file[i].parted = true;
    }
    *out = file;
    return targets_check(file, n, &fe->read, life, report);
}

enum status loads_write(const char *prefix, const struct fe *fe, const struct tie *tie, int ntie, struct arena *life,
                        struct report *report)
{
    struct hold hold;
    struct target *file;
    double *f = TAKE(life, double, 3 * (size_t)fe->n), *u = TAKE(life, double, 3 * (size_t)fe->n);
    TRY(name_files(&file, prefix, fe, tie, ntie, life, report));
    TRY(hold_make(&hold, fe, &tie, 1, life, report));
    for (int kind = 0; kind < LOAD_KINDS; kind++, file++) {
        load_forces(f, fe, kind, life);
        TRY(write_one(file->path, load_names[kind], f, u, &hold, life, report));
    }
    for (int t = 1; t < ntie; t++)
        for (int k = 0; k < 3; k++, file++) {
            load_interface(f, fe, tie + t, k);
            TRY(write_one(file->path, arena_print(life, "force-%c:%s", "xyz"[k], tie[t].name), f, u, &hold, life,
                          report));
        }
    return OK;
}
