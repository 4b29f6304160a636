/* The calls for one element in loops, for the tests of tools/python: what each element of a batch has to equal. */
#include "vndf.h"
#include "vndf_bsdf.h"

#if defined(_WIN32)
#  define SHARED __declspec(dllexport)
#else
#  define SHARED __attribute__((visibility("default")))
#endif

/* Arrays of a surface and of what is asked and answered, each of n numbers. */
typedef struct singles {
    int n;
    const float *alpha[2], *matrix[4], *mean[2], *wi[3], *wm[3], *u[3];
    float *drawn[3], *pdf, *weight, *other[6], *inverse[2];
} singles;

SHARED void singles_surface(const vndf_distribution *d, const singles *s);
SHARED void singles_affine(const vndf_distribution *d, const singles *s);
SHARED void singles_mixture(const vndf_distribution *d, const vndf_distribution *second,
                            const float *const weight[2], const singles *s, int *lobe);
SHARED void singles_bsdf(const vndf_material *material, const singles *s, float *const wo[3],
                         float *const weight[3], float *density, float *const value[3]);

static vndf_vec3 at(const float *const of[3], int i)
{
    return (vndf_vec3){of[0][i], of[1][i], of[2][i]};
}

static void put(float *const to[3], int i, vndf_vec3 w)
{
    to[0][i] = w.x, to[1][i] = w.y, to[2][i] = w.z;
}

void singles_surface(const vndf_distribution *d, const singles *s)
{
    for (int i = 0; i < s->n; i++) {
        vndf_surface surface = {d, s->alpha[0][i], s->alpha[1][i]};
        vndf_vec3 wi = at(s->wi, i), wm = at(s->wm, i);
        vndf_view view = vndf_view_from(&surface, wi);
        put(s->drawn, i, vndf_sample_weight(&view, s->u[0][i], s->u[1][i], &s->pdf[i], &s->weight[i]));
        s->other[0][i] = vndf_pdf(&view, wm);
        s->other[1][i] = vndf_visible(&view, wm);
        s->other[2][i] = vndf_ndf(&surface, wm);
        s->other[3][i] = vndf_projected_area(&surface, wi);
        s->other[4][i] = vndf_lambda(&surface, wi);
        s->other[5][i] = vndf_g1(&surface, wi);
        vndf_invert(&view, wm, &s->inverse[0][i], &s->inverse[1][i]);
    }
}

static vndf_affine shape(const vndf_distribution *d, const singles *s, int i)
{
    return (vndf_affine){
        d, s->matrix[0][i], s->matrix[1][i], s->matrix[2][i], s->matrix[3][i], s->mean[0][i], s->mean[1][i]};
}

void singles_affine(const vndf_distribution *d, const singles *s)
{
    for (int i = 0; i < s->n; i++) {
        vndf_affine surface = shape(d, s, i);
        vndf_vec3 wi = at(s->wi, i), wm = at(s->wm, i);
        vndf_view view = vndf_affine_view_from(&surface, wi);
        put(s->drawn, i, vndf_sample(&view, s->u[0][i], s->u[1][i], &s->pdf[i]));
        s->other[0][i] = vndf_pdf(&view, wm);
        s->other[1][i] = vndf_visible(&view, wm);
        s->other[2][i] = vndf_affine_ndf(&surface, wm);
        s->other[3][i] = vndf_affine_projected_area(&surface, wi);
        s->other[4][i] = vndf_affine_lambda(&surface, wi);
        s->other[5][i] = vndf_affine_g1(&surface, wi);
        vndf_invert(&view, wm, &s->inverse[0][i], &s->inverse[1][i]);
    }
}

/* The first lobe is plain, the second affine. */
void singles_mixture(const vndf_distribution *d, const vndf_distribution *second, const float *const weight[2],
                     const singles *s, int *lobe)
{
    for (int i = 0; i < s->n; i++) {
        vndf_mixture mixture = {2,
                                {{{d, s->alpha[0][i], 0, 0, s->alpha[1][i], 0, 0}, weight[0][i]},
                                 {shape(second, s, i), weight[1][i]}}};
        vndf_vec3 wi = at(s->wi, i), wm = at(s->wm, i);
        vndf_mixture_view view = vndf_mixture_view_from(&mixture, wi);
        put(s->drawn, i, vndf_mixture_sample(&view, s->u[0][i], s->u[1][i], &s->pdf[i], &lobe[i]));
        s->other[0][i] = vndf_mixture_pdf(&view, wm);
        s->other[1][i] = vndf_mixture_visible(&view, wm);
        s->other[2][i] = vndf_mixture_ndf(&mixture, wm);
        s->other[3][i] = vndf_mixture_projected_area(&mixture, wi);
        s->other[4][i] = vndf_mixture_lambda(&mixture, wi);
        s->other[5][i] = vndf_mixture_g1(&mixture, wi);
        vndf_mixture_invert(&view, wm, -1, &s->inverse[0][i], &s->inverse[1][i]);
    }
}

void singles_bsdf(const vndf_material *material, const singles *s, float *const wo[3], float *const weight[3],
                  float *density, float *const value[3])
{
    for (int i = 0; i < s->n; i++) {
        vndf_roughness rough = {s->alpha[0][i], s->alpha[1][i], s->mean[0][i], s->mean[1][i]};
        vndf_affine affine = shape(0, s, i);
        vndf_bsdf bsdf;
        vndf_scattered drawn;
        float f[VNDF_WAVELENGTHS], u[3] = {s->u[0][i], s->u[1][i], s->u[2][i]};
        if (material->is.effects.shape == VNDF_SHAPE_AFFINE || material->is.effects.shape == VNDF_SHAPE_MATRIX)
            vndf_bsdf_affine(&bsdf, material, &affine, at(s->wi, i));
        else
            vndf_bsdf_rough(&bsdf, material, &rough, at(s->wi, i));
        vndf_bsdf_sample(&bsdf, u, &drawn);
        put(wo, i, drawn.wo);
        vndf_bsdf_eval_pdf(&bsdf, at(s->wm, i), (uint64_t)i, f, &s->pdf[i]);
        for (int n = 0; n < 3; n++)
            weight[n][i] = drawn.weight[n], value[n][i] = f[n];
        density[i] = drawn.density;
    }
}
