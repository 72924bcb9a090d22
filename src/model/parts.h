/* parts.h -- the stages of model_build; private to model/. */
#ifndef FMDSUB_MODEL_PARTS_H
#define FMDSUB_MODEL_PARTS_H

#include "model/build.h"

struct making {
    const struct scene *scene;
    const bool *const *still; /* [nbody][modes] coordinates to go without; NULL: none */
    struct diags *diags;
    struct arena *life;
    struct model *m;
    struct model_body *body; /* m's arrays while they may still be written */
    struct model_joint *joint;
    struct model_loop *loop;
    int *body_of, *joint_of, *loop_of;
    int *scene_joint; /* [njoint] the scene's joint of a tree joint; -1: free by default */
    int *component;   /* [njoint] */
    bool *quick;      /* [njoint] the joint is in a component that has a fast coordinate */
    bool *supple;     /* [nbody] likewise the body's elastic coordinates */
};

/* Joints by body, as lists threaded through two arrays: first[b], next[2 j + side]. */
struct threads {
    int *first, *next;
};

/* How much a joint is wanted in the tree: its coordinates are read, or it has none. */
enum { AVOIDED = -1, PLAIN = 0, LIKED = 1, WANTED = 2 };

/* tree.c: spanning tree from the ground, breadth first, in the deck's order of joints; the rest are loops */
enum status make_tree(struct making *o);
/* short.c: would other joints leave much shorter loops?  Then the rest are AVOIDED. */
bool make_short(const struct making *o, const struct threads *threads, int *wish);
/* nodes.c: bodies at the nodes of flexible ones */
/* The model's body that a place of the scene's body belongs to (one of a flexible body's nodes becomes a body where it is
 * asked for first), and the place p from that body's centre in its axes: of a place in the world as drawn, of a marker. */
int place_on(double *p, struct making *o, int scene_body, const double *world);
int marker_on(double *p, struct making *o, const struct marker *m);
/* Body `index` as the scene's flexible one, its frame at the node of its inboard joint. */
void make_flexible_body(struct making *o, int index, const struct scene_body *sb, const double *joint);
int most_nodes(const struct scene *scene);
void make_nodes(struct making *o);
/* loops.c: components of loops and their class; with the numbering known, what makes a coordinate dependent */
void make_components(struct making *o);
void make_choice(struct making *o);
/* coordinates.c: places in q and v, fast first, then near; classes of bodies */
void make_coordinates(struct making *o);
/* near.c: which joints are near, from the classes of forces: then coordinates and elements are made again */
void make_near(struct making *o);
/* elements.c: measures and forces with their places and classes */
void make_elements(struct making *o);
/* spin.c: warnings of flexible bodies without geometric stiffening */
void warn_of_spin(struct making *o);
/* kept.c: what the modes of beams keep, and warnings of what they do not */
void make_kept(struct making *o);
/* effects.c: the model goes without what the deck turns off */
void make_effects(struct making *o);
/* start.c: q0, v0 */
void make_start(struct making *o);

/* Does the deck call rate k of tree joint i fast? */
bool is_fast(const struct making *o, int joint, int k);
/* Does it call elastic coordinate k of the model's body fast? */
bool mode_is_fast(const struct making *o, int body, int k);
/* Is the place in v fast, by itself or by its loops? */
bool place_is_fast(const struct making *o, int iv);

/* The place in v of the k-th rate of scene joint j. */
int rate_place(const struct making *o, int j, int k);
/* The place in q of the k-th position of scene joint j. */
int position_place(const struct making *o, int j, int k);

#endif
