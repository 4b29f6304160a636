#include "export/effects.h"

#include <stdio.h>
#include <string.h>

#include "core/nearest.h"

/* Choices in the order of vndf_bsdf.h, the default first. */
enum { LOBES, FRESNEL, MASKING, TRANSPORT, REFLECTION, KEYS };
static const char *const keys[] = {"lobes", "fresnel", "masking", "transport", "reflection", NULL};
static const char *const choices[KEYS][5] = {{"reflection", "transmission", "both"},
                                             {"none", "schlick", "dielectric", "conductor"},
                                             {"correlated", "separable", "v-cavities", "none"},
                                             {"radiance", "importance"},
                                             {"specular", "retro"}};

/* The place of a word in a list, or -1. */
static int place_in(const char *const *list, const char *word, size_t length)
{
    for (int place = 0; list[place]; place++)
        if (strlen(list[place]) == length && memcmp(list[place], word, length) == 0)
            return place;
    return -1;
}

/* "reflection, transmission, both; did you mean 'both'?" */
static const char *known_words(const char *const *list, const char *word, size_t length)
{
    static char known[200];
    size_t least = vndf_word_slip(length), n = 0;
    const char *nearest = NULL;
    for (; *list; list++) {
        n += (size_t)snprintf(known + n, sizeof known - n, "%s%s", n ? ", " : "", *list);
        nearest = vndf_word_is_nearer(word, length, *list, &least) ? *list : nearest;
    }
    if (nearest)
        snprintf(known + n, sizeof known - n, "; did you mean '%s'?", nearest);
    return known;
}

int effects_read(export_effects *effects, const char *text, char error[EFFECTS_ERROR_MAX])
{
    int choice[KEYS] = {0}, n = 0;
    for (text += strspn(text, " ,"); *text; text += strspn(text, " ,")) {
        const size_t length = strcspn(text, " ,"), name = strcspn(text, "= ,");
        const int key = place_in(keys, text, name), shown = length < 60 ? (int)length : 60;
        if (key < 0 || name == length) {
            snprintf(
                error, EFFECTS_ERROR_MAX,
                "'%.*s': key=choice is needed, with the keys %s; files scatter once, at one surface, by visible "
                "normals: all else needs the library",
                shown, text, known_words(keys, text, key < 0 ? name : 0));
            return 0;
        }
        const char *chosen = text + name + 1;
        text += length;
        choice[key] = place_in(choices[key], chosen, (size_t)(text - chosen));
        if (choice[key] < 0) {
            snprintf(error, EFFECTS_ERROR_MAX, "%.*s: there are %s", shown, text - length,
                     known_words(choices[key], chosen, (size_t)(text - chosen)));
            return 0;
        }
    }
    effects->wanted = 1;
    for (int key = 0; key < KEYS; key++)
        n += snprintf(effects->words + n, sizeof effects->words - (size_t)n, "%s%s=%s", key ? " " : "", keys[key],
                      choices[key][choice[key]]);
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
