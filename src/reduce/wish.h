/* wish.h -- what the command line of fmdsub-reduce asks for. */
#ifndef FMDSUB_REDUCE_WISH_H
#define FMDSUB_REDUCE_WISH_H

#include "reduce/basis.h"
#include "reduce/body.h"
#include "reduce/loads.h"

enum { MOST_TIES = 64, MOST_LOADS = 512, MOST_PROBES = 256 };

/* A prestressed stiffness: KIND[:SCALE]=FILE. */
struct load_wish {
    const char *kind;
    double scale; /* of the load it was made with, in units of the load */
    const char *path;
};

struct probe_wish {
    const char *name;
    int node; /* number */
};

struct wish {
    struct fe_source source;
    int ntie;
    struct tie_wish tie[MOST_TIES];
    struct basis_wish basis;
    int extra[LOAD_KINDS]; /* basis.load */
    struct body_damping damping;
    int nload;
    struct load_wish load[MOST_LOADS];
    const char *write_loads; /* files PREFIX-KIND.inp */
    int nprobe;
    struct probe_wish probe[MOST_PROBES];
    bool stiffening; /* geometric stiffness from stresses */
    bool material;   /* given: */
    double E, nu;    /* E in units of the input */
    const char *output;
    bool quiet, help, version;
};

enum status wish_read(struct wish *o, int argc, char **argv, struct arena *life, struct report *report);
const char *wish_help(void);

#endif
