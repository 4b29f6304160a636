#include "export/effects.h"

#include <stdio.h>
#include <string.h>

enum { CHOICES_MAX = 4 };

/* Choices in the order of vndf_bsdf.h, the default first; `why` is said where the library has more than files have. */
static const struct key {
    const char *name, *choice[CHOICES_MAX + 1], *why;
} keys[] = {
    {"lobes", {"reflection", "transmission", "both"}, ""},
    {"fresnel", {"none", "schlick", "dielectric", "conductor"}, ""},
    {"masking", {"correlated", "separable", "v-cavities", "none"}, ""},
    {"transport", {"radiance", "importance"}, ""},
    {"reflection", {"specular", "retro"}, ""},
    {"normals", {"visible"}, ", since files draw visible normals"},
    {"scattering", {"single"}, ", since random walks and compensation need the library"},
    {"shape", {"affine"}, ", since a surface has any matrix and mean slope, and one file scatters at one surface"},
};

enum { KEYS = sizeof keys / sizeof *keys };

static int is_word(const char *text, size_t length, const char *name)
{
    return strlen(name) == length && memcmp(text, name, length) == 0;
}

/* The key of key=choice, or -1; its choice, or -1. */
static int read_word(const char *text, size_t length, int *choice)
{
    size_t name = strcspn(text, "= ,");
    int key = KEYS - 1;
    while (key >= 0 && !(name < length && is_word(text, name, keys[key].name)))
        key--;
    for (*choice = key < 0 ? -1 : CHOICES_MAX - 1; *choice >= 0; --*choice)
        if (keys[key].choice[*choice] && is_word(text + name + 1, length - name - 1, keys[key].choice[*choice]))
            break;
    return key;
}

vndf_effects effects_of(const export_effects *effects)
{
    const int *c = effects->choice;
    const vndf_effects is = {.lobes = (vndf_lobes)c[0],
                             .fresnel = (vndf_fresnel)c[1],
                             .masking = (vndf_masking)c[2],
                             .transport = (vndf_transport)c[3],
                             .reflection = (vndf_reflection)c[4]};
    return is;
}

int effects_read(export_effects *effects, const char *text, char error[EFFECTS_ERROR_MAX])
{
    *effects = (export_effects){.wanted = 1};
    for (text += strspn(text, " ,"); *text; text += strspn(text, " ,")) {
        size_t length = strcspn(text, " ,");
        int choice, key = read_word(text, length, &choice), n = 0;
        if (choice < 0) {
            n = key < 0
                    ? snprintf(error, EFFECTS_ERROR_MAX, "'%.40s': key=choice is needed, with the keys", text)
                    : snprintf(error, EFFECTS_ERROR_MAX, "%.*s: there are", length < 60 ? (int)length : 60, text);
            for (int i = 0; key < 0 ? i < EFFECT_KEYS : keys[key].choice[i] != NULL; i++)
                n += snprintf(error + n, EFFECTS_ERROR_MAX - (size_t)n, "%s %s", i ? "," : "",
                              key < 0 ? keys[i].name : keys[key].choice[i]);
            snprintf(error + n, EFFECTS_ERROR_MAX - (size_t)n, "%s", key < 0 ? "" : keys[key].why);
            return 0;
        }
        if (key < EFFECT_KEYS)
            effects->choice[key] = choice;
        text += length;
    }
    /* What makes no sense is what the library says makes none. */
    const vndf_description is = {.distribution = vndf_ggx(),
                                 .effects = effects_of(effects),
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

int effects_have(const export_effects *effects, const char *word, size_t length)
{
    const int *c = effects->choice, transmits = c[0] != VNDF_LOBES_REFLECTION;
    const struct {
        const char *name;
        int is;
    } parts[] = {{"reflects", c[0] != VNDF_LOBES_TRANSMISSION},
                 {"transmits", transmits},
                 {"indexed", transmits || c[1] == VNDF_FRESNEL_DIELECTRIC},
                 {"smith", c[2] < VNDF_MASKING_V_CAVITIES},
                 {"coloured", transmits || c[1] != VNDF_FRESNEL_NONE}};
    int choice, key = read_word(word, length, &choice), has = key >= 0 && choice == c[key];
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        has |= parts[i].is && is_word(word, length, parts[i].name);
    return has;
}

void effects_name(const export_effects *effects, char *text, size_t size)
{
    size_t n = 0;
    for (int i = 0; i < EFFECT_KEYS && n < size; i++)
        n += (size_t)snprintf(text + n, size - n, "%s%s=%s", i ? ", " : "", keys[i].name,
                              keys[i].choice[effects->choice[i]]);
}
