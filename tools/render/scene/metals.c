/* Indices of refraction of metals for red, green and blue: measured spectra weighed by the sensitivities of the
 * three colours. They agree to three digits with the lists of the renderers Tungsten and Yocto/GL for Au, Ag, Cu
 * and Al. (Indices at single wavelengths fail: at 550 nm copper is on the slope of its reflectance, and looks
 * tan.) */
#include "render/scene/reader.h"

#include <string.h>

typedef struct metal {
    const char *name;
    float eta[3], k[3];
} metal;

static const metal metals[] = {
    {"gold", {0.143f, 0.375f, 1.442f}, {3.983f, 2.386f, 1.603f}},
    {"silver", {0.155f, 0.117f, 0.138f}, {4.828f, 3.122f, 2.147f}},
    {"copper", {0.200f, 0.924f, 1.102f}, {3.912f, 2.452f, 2.142f}},
    {"aluminium", {1.657f, 0.880f, 0.521f}, {9.224f, 6.270f, 4.837f}},
};
enum { METALS = sizeof metals / sizeof metals[0] };

int read_metal(scene_reader *r, const word *kind, const clause *of, const clause *eta, const clause *k,
               vndf_description *is)
{
    const char *names[METALS];
    unsigned chosen;
    if (of->at && (eta->at || k->at))
        return reader_refuse(r, of->at,
                             "'of' names a metal, 'eta' and 'k' say what another one is; leave one out");
    if (!of->at && !(eta->at && k->at))
        return reader_refuse(r, kind, "'conductor' needs 'of METAL', or 'eta R G B' and 'k R G B'");
    if (!of->at)
        return reader_three(r, eta, 0, 1000, is->conductor_eta) && reader_three(r, k, 0, 1000, is->conductor_k);
    for (size_t i = 0; i < METALS; i++)
        names[i] = metals[i].name;
    if (!reader_choice(r, of, names, METALS, &chosen))
        return 0;
    memcpy(is->conductor_eta, metals[chosen].eta, sizeof metals[chosen].eta);
    memcpy(is->conductor_k, metals[chosen].k, sizeof metals[chosen].k);
    return 1;
}
