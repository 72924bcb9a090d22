/* suggest.c -- the word that was probably meant: another's word for it, a near miss, the beginning of it. */
#include <string.h>
#include <strings.h>

#include "base/text.h"
#include "deck/diag.h"

enum { TEXT = 600 };

/* "rest" of "rest_length" */
static bool is_head(const char *head, const char *word)
{
    const size_t len = strlen(head);
    return len > 2 && !strncmp(word, head, len) && word[len] == '_';
}

/* What other programs, and people, call it. */
static const char *const same[][2] = {
    {"duration", "until"},
    {"end", "until"},
    {"t_end", "until"},
    {"tend", "until"},
    {"stop", "until"},
    {"end_time", "until"},
    {"dt", "step"},
    {"timestep", "step"},
    {"time_step", "step"},
    {"integrator", "scheme"},
    {"solver", "scheme"},
    {"method", "scheme"},
    {"integration", "integrate"},
    {"simulation", "integrate"},
    {"solver", "integrate"},
    {"joints", "constraints"},
    {"links", "bodies"},
    {"parts", "bodies"},
    {"loads", "forces"},
    {"springs", "forces"},
    {"motions", "drives"},
    {"motors", "drives"},
    {"variables", "parameters"},
    {"constants", "parameters"},
    {"hinge", "revolute"},
    {"pin", "revolute"},
    {"rotational", "revolute"},
    {"slider", "prismatic"},
    {"sliding", "prismatic"},
    {"translational", "prismatic"},
    {"ball", "spherical"},
    {"hooke", "universal"},
    {"cardan", "universal"},
    {"rigid", "fixed"},
    {"welded", "weld"},
    {"dashpot", "damper"},
    {"moment", "torque"},
    {"motion", "drive"},
    {"position", "at"},
    {"com", "at"},
    {"centre", "at"},
    {"center", "at"},
    {"location", "at"},
    {"origin", "at"},
    {"orientation", "orient"},
    {"rotation", "orient"},
    {"m", "mass"},
    {"k", "stiffness"},
    {"c", "damping"},
    {"length0", "rest"},
    {"free_length", "rest"},
    {"direction", "axis"},
    {"outputs", "output"},
    {"signals", "columns"},
    {"interval", "every"},
    {"youngs_modulus", "E"},
    {"poisson", "nu"},
    {"rho", "density"},
    {"controllers", "states"},
    {"controller", "states"},
    {"filters", "states"},
    {"integrals", "states"},
    {"integrators", "states"},
    {"stops", "contacts"},
    {"description", "title"},
    {"name", "title"},
};

static const char *meant(const char *word, const char *const *words, int n)
{
    for (size_t s = 0; s < sizeof same / sizeof *same; s++)
        for (int i = 0; i < n; i++)
            if (!strcasecmp(word, same[s][0]) && !strcmp(words[i], same[s][1])) return words[i];
    return NULL;
}

const char *diag_nearest(const char *word, const char *const *words, int n)
{
    const char *near = meant(word, words, n);
    if (!near) near = text_nearest(word, words, n);
    for (int i = 0; i < n && !near; i++)
        if (is_head(word, words[i]) || is_head(words[i], word)) near = words[i];
    return near && !(strlen(word) == 1 && strlen(near) == 1 && strcasecmp(word, near)) ? near : NULL;
}

/* What many simulators have and this one not there, or not yet: "friction" for "friction_coefficient". */
static const char *absent(const char *word)
{
    static const char *const words[] = {"friction", "contact", "rolling"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (!strncasecmp(word, words[i], strlen(words[i]))) return words[i];
    return NULL;
}

void diag_words(struct diags *d, const char *const *words, int n)
{
    char text[TEXT];
    size_t len = 0;
    for (int i = 0; i < n && len < TEXT / 2; i++)
        len += (size_t)snprintf(text + len, TEXT - len, "%s%s", i ? ", " : "", diag_clip(d, words[i]));
    if (n > 0) diag_hint(d, "known here: %s%s", text, len < TEXT / 2 ? "" : ", ...");
}

void diag_suggest(struct diags *d, const char *word, const char *const *words, int n)
{
    if (!diag_may_suggest(d, n)) return;
    const char *near = diag_nearest(word, words, n);
    if (!near && absent(word)) {
        diag_hint(d, "`fmdsub explain %s` says what there is, and what can stand for it", absent(word));
        return;
    }
    diag_foreign(d, word);
    if (near) {
        diag_hint(d, "did you mean '%s'?", near);
        return;
    }
    diag_words(d, words, n);
}
