#include "export/effects.h"

#include <stdio.h>
#include <string.h>

enum { CHOICES = 4 };

typedef struct key {
    const char *name;
    const char *choice[CHOICES + 1]; /* ended by NULL, in the order of vndf_bsdf.h */
} key;

static const key keys[EFFECT_KEYS] = {{"lobes", {"reflection", "transmission", "both"}},
                                      {"fresnel", {"none", "schlick", "dielectric", "conductor"}},
                                      {"masking", {"correlated", "separable", "v-cavities", "none"}},
                                      {"transport", {"radiance", "importance"}},
                                      {"reflection", {"specular", "retro"}}};

/* What the library has and files have not, but for one choice, and what is there instead. */
typedef struct fixed {
    const char *name, *choice, *why;
} fixed;
static const fixed fixed_keys[] = {
    {"normals", "visible", "files draw visible normals"},
    {"scattering", "single", "random walks and compensation need the library"},
    {"shape", "affine", "a surface has any matrix and mean slope, and one file scatters at one surface"}};

/* ---- reading ---- */

static int is_word(const char *text, size_t length, const char *word)
{
    return word && strlen(word) == length && memcmp(text, word, length) == 0;
}

static int refuse_key(const char *word, size_t length, char *error)
{
    int n = snprintf(error, EFFECTS_ERROR_MAX, "'%.*s': key=choice is needed, with the keys", (int)length, word);
    for (int i = 0; i < EFFECT_KEYS; i++)
        n += snprintf(error + n, EFFECTS_ERROR_MAX - (size_t)n, "%s %s", i ? "," : "", keys[i].name);
    return 0;
}

static int refuse_choice(const key *k, const char *choice, size_t length, char *error)
{
    int n = snprintf(error, EFFECTS_ERROR_MAX, "%s=%.*s: there are", k->name, (int)length, choice);
    for (int i = 0; k->choice[i]; i++)
        n += snprintf(error + n, EFFECTS_ERROR_MAX - (size_t)n, "%s %s", i ? "," : "", k->choice[i]);
    return 0;
}

static int read_word(export_effects *effects, const char *word, size_t length, char *error)
{
    const char *sign = memchr(word, '=', length);
    size_t name = sign ? (size_t)(sign - word) : 0, rest = sign ? length - name - 1 : 0;
    if (length > 40)
        length = 40;
    for (int i = 0; i < EFFECT_KEYS; i++) {
        if (!sign || !is_word(word, name, keys[i].name))
            continue;
        for (unsigned n = 0; keys[i].choice[n]; n++)
            if (is_word(sign + 1, rest, keys[i].choice[n])) {
                effects->choice[i] = n;
                return 1;
            }
        return refuse_choice(&keys[i], sign + 1, rest < 40 ? rest : 40, error);
    }
    for (size_t i = 0; sign && i < sizeof fixed_keys / sizeof fixed_keys[0]; i++)
        if (is_word(word, name, fixed_keys[i].name)) {
            if (is_word(sign + 1, rest, fixed_keys[i].choice))
                return 1;
            snprintf(error, EFFECTS_ERROR_MAX, "'%.*s': %s, %s=%s", (int)length, word, fixed_keys[i].why,
                     fixed_keys[i].name, fixed_keys[i].choice);
            return 0;
        }
    return refuse_key(word, length, error);
}

vndf_effects effects_of(const export_effects *effects)
{
    const unsigned *c = effects->choice;
    const vndf_effects is = {.lobes = (vndf_lobes)c[EFFECT_LOBES],
                             .fresnel = (vndf_fresnel)c[EFFECT_FRESNEL],
                             .masking = (vndf_masking)c[EFFECT_MASKING],
                             .transport = (vndf_transport)c[EFFECT_TRANSPORT],
                             .reflection = (vndf_reflection)c[EFFECT_REFLECTION]};
    return is;
}

/* What makes no sense is what the library says makes none. */
static int is_sensible(const export_effects *effects, char *reason)
{
    const vndf_description is = {.distribution = vndf_ggx(),
                                 .effects = effects_of(effects),
                                 .alpha_x = 1.0f,
                                 .alpha_y = 1.0f,
                                 .eta = 1.5f,
                                 .conductor_eta = {1.0f, 1.0f, 1.0f}};
    vndf_material material;
    vndf_error error = {VNDF_OK, ""};
    if (vndf_material_resolve(&is, &material, &error) == VNDF_OK)
        return 1;
    snprintf(reason, EFFECTS_ERROR_MAX, "%s", error.message);
    return 0;
}

int effects_read(export_effects *effects, const char *text, char error[EFFECTS_ERROR_MAX])
{
    *effects = (export_effects){.wanted = 1};
    for (text += strspn(text, " ,"); *text; text += strspn(text, " ,")) {
        size_t length = strcspn(text, " ,");
        if (!read_word(effects, text, length, error))
            return 0;
        text += length;
    }
    return is_sensible(effects, error);
}

/* ---- marks ---- */

int effects_have(const export_effects *effects, const char *word, size_t length)
{
    const unsigned *c = effects->choice;
    int reflects = c[EFFECT_LOBES] != VNDF_LOBES_TRANSMISSION,
        transmits = c[EFFECT_LOBES] != VNDF_LOBES_REFLECTION;
    const char *sign = memchr(word, '=', length);
    if (is_word(word, length, "reflects"))
        return reflects;
    if (is_word(word, length, "transmits"))
        return transmits;
    if (is_word(word, length, "indexed"))
        return transmits || c[EFFECT_FRESNEL] == VNDF_FRESNEL_DIELECTRIC;
    if (is_word(word, length, "coloured"))
        return transmits || c[EFFECT_FRESNEL] != VNDF_FRESNEL_NONE;
    for (int i = 0; sign && i < EFFECT_KEYS; i++)
        if (is_word(word, (size_t)(sign - word), keys[i].name))
            return is_word(sign + 1, length - (size_t)(sign + 1 - word), keys[i].choice[c[i]]);
    return 0;
}

void effects_name(const export_effects *effects, char *text, size_t size)
{
    size_t n = 0;
    *text = '\0';
    for (int i = 0; i < EFFECT_KEYS && n < size; i++)
        n += (size_t)snprintf(text + n, size - n, "%s%s=%s", i ? ", " : "", keys[i].name,
                              keys[i].choice[effects->choice[i]]);
}
