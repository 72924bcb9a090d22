/* chosen.c -- see chosen.h */
#include "cli/chosen.h"

void chosen_print(FILE *to, const struct flex_chosen *o)
{
    int kept = 0;
    for (int k = 0; k < o->n; k++) kept += o->mode[k].kept;
    fprintf(
        to,
        "  %-16s modes: auto: %d of %d with its joints clamped; what is left out has a share of %.2g, tolerance %.2g\n",
        "", kept, o->n, o->left, o->tolerance);
    for (int k = 0; k < o->n; k++) {
        const struct flex_chosen_mode *a = &o->mode[k];
        fprintf(to, "  %-16s   %10.4g Hz %-10s %s", "", a->hertz, flex_kind_name(a->kind),
                a->kept ? "kept" : "left out");
        if (a->by)
            fprintf(to, ", share %.2g of %s by %s\n", a->share, a->of, a->by);
        else
            fprintf(to, ", nothing asks for it\n");
    }
}

static cJSON *mode(const struct flex_chosen_mode *a)
{
    cJSON *o = cJSON_CreateObject();
    facts_add(o, "hertz", facts_number(a->hertz));
    cJSON_AddStringToObject(o, "kind", flex_kind_name(a->kind));
    cJSON_AddBoolToObject(o, "kept", a->kept);
    if (!a->by) return o;
    facts_add(o, "share", facts_number(a->share));
    cJSON_AddStringToObject(o, "of", a->of);
    cJSON_AddStringToObject(o, "by", a->by);
    return o;
}

cJSON *chosen_json(const struct flex_chosen *o)
{
    cJSON *to = cJSON_CreateObject();
    facts_add(to, "tolerance", facts_number(o->tolerance));
    facts_add(to, "left", facts_number(o->left));
    cJSON *list = cJSON_AddArrayToObject(to, "modes");
    for (int k = 0; k < o->n; k++) cJSON_AddItemToArray(list, mode(&o->mode[k]));
    return to;
}
