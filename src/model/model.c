/* model.c -- from a scene to a model, stage by stage; see build.h */
#include "model/parts.h"

enum status model_build(struct model **out, const struct scene *scene, const bool *const *still, struct diags *diags,
                        struct arena *life)
{
    struct model *m = TAKE(life, struct model, 1);
    struct making o = {.scene = scene, .still = still, .diags = diags, .life = life, .m = m};
    m->space = scene->space;
    for (int i = 0; i < 3; i++) m->gravity[i] = scene->gravity[i];
    TRY(make_tree(&o));
    m->body = o.body;
    m->joint = o.joint;
    m->loop = o.loop;
    m->body_of = o.body_of;
    m->joint_of = o.joint_of;
    m->loop_of = o.loop_of;
    make_components(&o);
    make_coordinates(&o);
    make_elements(&o);
    make_near(&o); /* now that the classes of forces are known, once more with near ones first */
    make_coordinates(&o);
    make_elements(&o);
    make_choice(&o);
    make_start(&o);
    warn_of_spin(&o);
    make_kept(&o);
    make_effects(&o);
    *out = m;
    return OK;
}
