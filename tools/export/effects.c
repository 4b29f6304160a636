#include "export/effects.h"

#include <stdio.h>
#include <string.h>

#include "core/nearest.h"

/* Choices in the order of vndf_bsdf.h, the default first; lists have ", " between words. */
enum { LOBES, FRESNEL, MASKING, TRANSPORT, REFLECTION, KEYS };
static const char keys[] = "lobes, fresnel, masking, transport, reflection";
static const char *const choices[KEYS] = {"reflection, transmission, both", "none, schlick, dielectric, conductor",
                                          "correlated, separable, v-cavities, none", "radiance, importance",
                                          "specular, retro"};

/* The word at a place of a list; it ends at a comma. */
static const char *list_word(const char *list, int place)
{
    while (place-- > 0)
        list += strcspn(list, ",") + 2;
    return list;
}

/* The place of a word in a list, or -1. */
static int list_place(const char *list, const char *word, size_t length)
{
    int place = 0;
    for (const char *at = list; strcspn(at, ",") != length || memcmp(at, word, length) != 0;
         at = list_word(at, 1), place++)
        if (!at[strcspn(at, ",")])
            return -1;
    return place;
}

/* "; did you mean 'both'?", or "". */
static const char *nearest_in(const char *list, const char *word, size_t length)
{
    static char hint[64];
    size_t least = vndf_word_slip(length);
    hint[0] = '\0';
    for (int place = 0, is_last = 0; !is_last; place++) {
        const char *at = list_word(list, place);
        char one[40];
        snprintf(one, sizeof one, "%.*s", (int)strcspn(at, ","), at);
        if (vndf_word_is_nearer(word, length, one, &least))
            snprintf(hint, sizeof hint, "; did you mean '%s'?", one);
        is_last = !at[strcspn(at, ",")];
    }
    return hint;
}

int effects_read(export_effects *effects, const char *text, char error[EFFECTS_ERROR_MAX])
{
    int choice[KEYS] = {0}, n = 0;
    for (text += strspn(text, " ,"); *text; text += strspn(text, " ,")) {
        const int length = (int)strcspn(text, " ,"), name = (int)strcspn(text, "= ,");
        const int key = list_place(keys, text, (size_t)name);
        if (key < 0 || name == length) {
            snprintf(error, EFFECTS_ERROR_MAX,
                     "'%.*s': key=choice is needed, with the keys %s%s; files scatter once, at "
                     "one surface, by visible normals: all else needs the library",
                     length < 60 ? length : 60, text, keys, key < 0 ? nearest_in(keys, text, (size_t)name) : "");
            return 0;
        }
        choice[key] = list_place(choices[key], text + name + 1, (size_t)(length - name - 1));
        if (choice[key] < 0) {
            snprintf(error, EFFECTS_ERROR_MAX, "%.*s: there are %s%s", length < 60 ? length : 60, text,
                     choices[key], nearest_in(choices[key], text + name + 1, (size_t)(length - name - 1)));
            return 0;
        }
        text += length;
    }
    effects->wanted = 1;
    for (int key = 0; key < KEYS; key++) {
        const char *name = list_word(keys, key), *chosen = list_word(choices[key], choice[key]);
        n += snprintf(effects->words + n, sizeof effects->words - (size_t)n, "%s%.*s=%.*s", key ? " " : "",
                      (int)strcspn(name, ","), name, (int)strcspn(chosen, ","), chosen);
    }
    effects->is = (vndf_effects){.lobes = (vndf_lobes)choice[LOBES],
                                 .fresnel = (vndf_fresnel)choice[FRESNEL],
                                 .masking = (vndf_masking)choice[MASKING],
                                 .transport = (vndf_transport)choice[TRANSPORT],
                                 .reflection = (vndf_reflection)choice[REFLECTION]};
    /* What makes no sense is what the library says makes none. */
    const vndf_description is = {.distribution = vndf_ggx(),
                                 .effects = effects->is,
                                 .alpha_x = 1.0f,
                                 .alpha_y = 1.0f,
                                 .eta = 1.5f,
                                 .conductor_eta = {1.0f, 1.0f, 1.0f}};
    vndf_material material;
    vndf_error refusal = {VNDF_OK, ""};
    if (vndf_material_resolve(&is, &material, &refusal) == VNDF_OK)
        return 1;
    snprintf(error, EFFECTS_ERROR_MAX, "%s", refusal.message);
    return 0;
}
