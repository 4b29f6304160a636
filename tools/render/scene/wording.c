/* Turns refusals of the library, which name constants and members of C, into the words of scene files: "normals is
 * VNDF_NORMALS_BOUNDED" becomes "normals bounded", and a kind of Fresnel's equations becomes the kind of material
 * that has them. */
#include "render/scene/scene.h"

#include <string.h>

typedef struct wording {
    const char *said, *here;
} wording;

static const wording wordings[] = {
    {"effects: ", ""},
    {"fresnel is VNDF_FRESNEL_NONE", "the kind is shape"},
    {"fresnel is VNDF_FRESNEL_CONDUCTOR", "the kind is conductor"},
    {"VNDF_FRESNEL_SCHLICK", "reflector"},
    {"conductor_eta", "eta"},
    {"conductor_k", "k"},
    {"eta is", "index is"},
    {"lobes is ", "lobes "},
    {"normals is ", "normals "},
    {"scattering is ", "scattering "},
    {"reflection is VNDF_REFLECTION_RETRO", "the material is retroreflective"},
    {"which is not reciprocal with mean slopes: shape must be VNDF_SHAPE_ALIGNED, VNDF_SHAPE_ROTATED or "
     "VNDF_SHAPE_MATRIX",
     "which is not reciprocal with mean slopes: leave out mean, its maps, mix and families"},
    {"VNDF_LOBES_BOTH with VNDF_FRESNEL_DIELECTRIC", "both of a dielectric"},
    {"shape must not be VNDF_SHAPE_AFFINE or VNDF_SHAPE_MIXTURE", "leave out mean, its maps, mix and families"},
    {"shape is VNDF_SHAPE_AFFINE or VNDF_SHAPE_MIXTURE", "the surface has mean slopes, several lobes or a family"},
};

static const wording *wording_of(const char *said)
{
    for (size_t i = 0; i < sizeof wordings / sizeof wordings[0]; i++)
        if (strncmp(said, wordings[i].said, strlen(wordings[i].said)) == 0)
            return &wordings[i];
    return NULL;
}

/* The part after the first two words of VNDF_EFFECT_CHOICE; NULL if this is not a constant. */
static const char *choice_of(const char *said)
{
    const char *second = strncmp(said, "VNDF_", 5) == 0 ? strchr(said + 5, '_') : NULL;
    return second ? second + 1 : NULL;
}

typedef struct text {
    char *message;
    size_t size, length;
} text;

static void put(text *t, char letter)
{
    if (t->length + 1 < t->size)
        t->message[t->length++] = letter;
}

static const char *put_choice(text *t, const char *at)
{
    for (; (*at >= 'A' && *at <= 'Z') || *at == '_'; at++)
        put(t, (char)(*at == '_' ? '-' : *at - 'A' + 'a'));
    return at;
}

void scene_wording(const char *said, char *message, size_t size)
{
    text t = {message, size, 0};
    while (*said) {
        const wording *w = wording_of(said);
        const char *here = w ? w->here : "", *choice = choice_of(said);
        if (w) {
            while (*here)
                put(&t, *here++);
            said += strlen(w->said);
        } else if (choice) {
            said = put_choice(&t, choice);
        } else {
            put(&t, *said++);
        }
    }
    if (size)
        message[t.length] = '\0';
}
