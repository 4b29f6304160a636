/* The examples of vndf.h, and of BSDFs in README, compile, stand there to the letter, and do what is said of them:
 * glass scatters; a brushed surface under a normal map has the map's normal in its middle, `along`
 * along the brush and `across` across it; two families in one mixture have the densities of their sum, 7 to 3. */
#include <ctype.h>

#include "harness/test.h"
#include "vndf_bsdf.h"

/* ---- what they do ---- */

static void test_glass(void)
{
    const vndf_vec3 wi = {0.6f, 0, 0.8f};
    const float u[3] = {0.3f, 0.6f, 0.5f};
    vndf_error error;
    vndf_material material;
    vndf_bsdf bsdf;
    vndf_scattered s;
    /* example: README.md */
    vndf_description glass = {.surface = vndf_rough(vndf_ggx(), 0.3f, 0.1f),
                              .eta = 1.5f,
                              .effects = {.lobes = VNDF_LOBES_BOTH, .fresnel = VNDF_FRESNEL_DIELECTRIC}};
    vndf_material_resolve(&glass, &material, &error); /* VNDF_OK, or why these effects do not go together */
    vndf_bsdf_at(&bsdf, &material, wi);               /* once per hit */
    vndf_bsdf_sample(&bsdf, u, &s);                   /* u[3]; s.wo, s.weight (f cos/density), s.density, s.lobe */
    /* end */
    TEST(s.lobe != VNDF_LOBE_NONE && s.density > 0 && s.weight[0] > 0.3f && s.weight[0] < 1);
}

/* P22 of GGX is a quarter of that in the middle as far away as the roughness, along the brush and across it. */
static void test_brushed(const vndf_distribution *metal, float phi, float along, float across, vndf_vec3 wi,
                         const float u[2])
{
    const vndf_vec3 n = {-0.33f, 0.19f, 0.95f};
    /* example: vndf.h */
    vndf_surface brushed = vndf_rotated(vndf_rough(metal, along, across), cosf(phi), sinf(phi));
    brushed.mean_x = -n.x / n.z;
    brushed.mean_y = -n.y / n.z;
    const vndf_view view = vndf_view_from(&brushed, wi);
    float pdf;
    const vndf_vec3 wm = vndf_sample(&view, u[0], u[1], &pdf);
    /* end */
    const float x = -n.x / n.z, y = -n.y / n.z, c = cosf(phi), s = sinf(phi);
    const double middle = 1 / (PI * (double)along * (double)across);
    TEST_RELATIVE((double)pdf, (double)vndf_pdf(&view, wm), 1e-5);
    TEST_RELATIVE((double)vndf_p22(&brushed, x, y), middle, 1e-4);
    TEST_RELATIVE((double)vndf_p22(&brushed, x + c * along, y + s * along), middle / 4, 1e-4);
    TEST_RELATIVE((double)vndf_p22(&brushed, x - s * across, y + c * across), middle / 4, 1e-4);
}

static void test_families(const vndf_family *metals, float p, const vndf_surface *narrow, const vndf_family *tails,
                          float q, const vndf_surface *wide, vndf_vec3 wi, const float u[2])
{
    vndf_mixture core, tail;
    TEST(vndf_family_at(metals, p, narrow, &core) == VNDF_FAMILY_INSIDE);
    TEST(vndf_family_at(tails, q, wide, &tail) == VNDF_FAMILY_INSIDE);
    /* example: vndf.h */
    vndf_mixture whole, haze;
    vndf_family_at(metals, p, narrow, &whole);
    vndf_family_at(tails, q, wide, &haze);
    for (int i = 0; i < whole.count; i++)
        whole.lobe[i].weight *= 0.7f;
    for (int i = 0; i < haze.count; i++) {
        haze.lobe[i].weight *= 0.3f;
        whole.lobe[whole.count++] = haze.lobe[i];
    }
    const vndf_mixture_view view = vndf_mixture_view_from(&whole, wi);
    float pdf;
    const vndf_vec3 wm = vndf_mixture_sample(&view, u[0], u[1], &pdf, NULL);
    /* end */
    TEST(whole.count == 3);
    TEST_RELATIVE((double)vndf_mixture_ndf(&whole, wm),
                  0.7 * (double)vndf_mixture_ndf(&core, wm) + 0.3 * (double)vndf_mixture_ndf(&tail, wm), 1e-5);
    TEST_RELATIVE((double)pdf, (double)vndf_mixture_pdf(&view, wm), 1e-5);
}

/* ---- to the letter ---- */

enum { TEXT_MOST = 1 << 18 };

/* The file without blanks, and without stars, which open lines of a comment. */
static int read_bare(const char *path, char *text)
{
    size_t size = read_bytes(path, (unsigned char *)text, TEXT_MOST - 1), kept = 0;
    for (size_t i = 0; i < size; i++)
        if (!isspace((unsigned char)text[i]) && text[i] != '*')
            text[kept++] = text[i];
    text[kept] = '\0';
    return TEST(size > 0 && size < TEXT_MOST - 1);
}

/* Every part of this file between "example: HEADER" and "end" is part of that header or README. */
static void test_letters(void)
{
    static char here[TEXT_MOST], header[TEXT_MOST];
    char path[512], name[32];
    int count = 0, length = 0;
    read_bare(VNDF_SOURCE_DIR "/tests/house/test_header_examples.c", here);
    for (char *at = here, *end; (at = strstr(at, "/example:")) && (end = strstr(at, "/end/")); at = end + 1) {
        if (sscanf(at, "/example:%31[A-Za-z_.]/%n", name, &length) != 1) /* the words above */
            continue;
        *end = '\0';
        snprintf(path, sizeof path, VNDF_SOURCE_DIR "/%s%s", strstr(name, ".md") ? "" : "include/", name);
        if (!TEST(read_bare(path, header) && strstr(header, at + length)))
            fprintf(stderr, "  example %d is not in %s\n", count + 1, name);
        count++;
    }
    TEST(count == 3);
}

int main(void)
{
    const vndf_distribution *const two[2] = {vndf_ggx(), vndf_beckmann()};
    const float parameters[2] = {1, 2}, u[2] = {0.3f, 0.6f};
    const vndf_surface narrow = {NULL, 0.1f, 0, 0, 0.05f, 0.1f, 0}, wide = {NULL, 0.4f, 0.1f, 0, 0.4f, 0, 0};
    vndf_family *family = vndf_family_of(two, parameters, 2, NULL);
    test_glass();
    test_brushed(vndf_ggx(), 0.4f, 0.05f, 0.3f, (vndf_vec3){0.48f, 0.64f, 0.6f}, u);
    for (float p = 1.1f; p < 2; p += 0.1f)
        test_families(family, p, &narrow, family, 2, &wide, (vndf_vec3){0.6f, 0, 0.8f}, u);
    vndf_family_free(family);
    test_letters();
    return test_done();
}
