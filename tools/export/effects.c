#include "export/effects.h"

#include <stdio.h>
#include <string.h>

/* Choices in the order of vndf_bsdf.h, the default first; `why` is said where the library has more of them than files.
 */
typedef struct key {
    const char *name, *choices, *why;
} key;

static const key keys[] = {
    {"lobes", "reflection, transmission, both", ""},
    {"fresnel", "none, schlick, dielectric, conductor", ""},
    {"masking", "correlated, separable, v-cavities, none", ""},
    {"transport", "radiance, importance", ""},
    {"reflection", "specular, retro", ""},
    {"normals", "visible", ", since files draw visible normals"},
    {"scattering", "single", ", since random walks and compensation need the library"},
    {"shape", "affine", ", since a surface has any matrix and mean slope, and one file scatters at one surface"},
};

enum { KEYS = sizeof keys / sizeof *keys };

static int is_word(const char *text, int length, const char *name)
{
    return strlen(name) == (size_t)length && memcmp(text, name, (size_t)length) == 0;
}

/* The next choice of a list, of *length characters. */
static const char *next_choice(const char *at, int *length)
{
    at += strspn(at, ", ");
    *length = (int)strcspn(at, ",");
    return at;
}

/* The key of key=choice, or -1; its choice, or -1. */
static int read_word(const char *text, int length, int *choice)
{
    const char *sign = memchr(text, '=', (size_t)length);
    int name = sign ? (int)(sign - text) : 0, i = 0, place = 0, size;
    while (i < KEYS && !(sign && is_word(text, name, keys[i].name)))
        i++;
    *choice = -1;
    for (const char *at = i < KEYS ? keys[i].choices : ""; *(at = next_choice(at, &size)); at += size, place++)
        if (size == length - name - 1 && memcmp(at, sign + 1, (size_t)size) == 0)
            *choice = place;
    return i < KEYS ? i : -1;
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
        int length = (int)strcspn(text, " ,"), choice, k = read_word(text, length, &choice);
        if (k < 0) {
            int n = snprintf(error, EFFECTS_ERROR_MAX, "'%.40s': key=choice is needed, with the keys", text);
            for (int i = 0; i < EFFECT_KEYS; i++)
                n += snprintf(error + n, EFFECTS_ERROR_MAX - (size_t)n, "%s %s", i ? "," : "", keys[i].name);
            return 0;
        }
        if (choice < 0) {
            snprintf(error, EFFECTS_ERROR_MAX, "%.*s: there are %s%s", length < 60 ? length : 60, text,
                     keys[k].choices, keys[k].why);
            return 0;
        }
        if (k < EFFECT_KEYS)
            effects->choice[k] = choice;
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

int effects_have(const export_effects *effects, const char *word, int length)
{
    const int *c = effects->choice;
    int choice, k = read_word(word, length, &choice), reflects = c[0] != VNDF_LOBES_TRANSMISSION,
                transmits = c[0] != VNDF_LOBES_REFLECTION;
    return k >= 0                               ? choice == c[k]
           : is_word(word, length, "reflects")  ? reflects
           : is_word(word, length, "transmits") ? transmits
           : is_word(word, length, "indexed")   ? transmits || c[1] == VNDF_FRESNEL_DIELECTRIC
           : is_word(word, length, "smith")     ? c[2] < VNDF_MASKING_V_CAVITIES
           : is_word(word, length, "coloured")  ? transmits || c[1] != VNDF_FRESNEL_NONE
                                                : 0;
}

void effects_name(const export_effects *effects, char *text, size_t size)
{
    size_t n = 0;
    for (int i = 0; i < EFFECT_KEYS && n < size; i++) {
        int length;
        const char *choice = next_choice(keys[i].choices, &length);
        for (int k = 0; k < effects->choice[i]; k++)
            choice = next_choice(choice + length, &length);
        n += (size_t)snprintf(text + n, size - n, "%s%s=%.*s", i ? ", " : "", keys[i].name, length, choice);
    }
}
