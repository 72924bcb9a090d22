/* build.h -- from a scene to a model: tree, coordinates, elements, start. */
#ifndef FMDSUB_MODEL_BUILD_H
#define FMDSUB_MODEL_BUILD_H

#include "base/arena.h"
#include "model/model.h"
#include "scene/scene.h"

/* Builds the model of a scene; without the modes still[body][k] of the model's flexible bodies (NULL: with all).
 * Warnings and errors go to diags: a joint that closes a loop is E_DECK. */
enum status model_build(struct model **out, const struct scene *scene, const bool *const *still, struct diags *diags,
                        struct arena *life);

#endif
