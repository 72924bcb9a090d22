/* options.h -- what the command line of fmdsub-reduce asks for. */
#ifndef FMDSUB_REDUCE_OPTIONS_H
#define FMDSUB_REDUCE_OPTIONS_H

#include "reduce/basis.h"
#include "reduce/body.h"
#include "reduce/loads.h"

enum { MOST_TIES = 64, MOST_LOADS = 512, MOST_PROBES = 256 };

/* A prestressed stiffness: KIND[:SCALE]=FILE. */
struct load_options {
    const char *kind;
    double scale; /* of the load it was made with, in units of the load */
    const char *path;
};

struct probe_options {
    const char *name;
    int node; /* number */
};

struct options {
    struct fe_source source;
    int ntie;
    struct tie_options tie[MOST_TIES];
    struct basis_options basis;
    int extra[LOAD_KINDS]; /* basis.load */
    struct body_damping damping;
    int nload;
    struct load_options load[MOST_LOADS];
    const char *write_loads; /* files PREFIX-KIND.inp */
    int nprobe;
    struct probe_options probe[MOST_PROBES];
    bool stiffening; /* geometric stiffness from stresses */
    bool material;   /* given: */
    double E, nu;    /* E in units of the input */
    const char *output;
    bool quiet, help, version;
};

enum status options_read(struct options *o, int argc, char **argv, struct arena *life, struct report *report);
const char *options_help(void);

#endif
