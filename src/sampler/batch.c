/* Batches. TEMPORARY: all elements one after the other. */
#include "sampler/elements.h"
#include "sampler/sampler.h"

vndf_instructions vndf_instructions_used(vndf_instructions limit)
{
    (void)limit;
    return VNDF_INSTRUCTIONS_PORTABLE;
}

/* alpha_x or alpha_y <= 0 is invalid, as for one: a matrix of zeros is, too. */
static vndf_affine plain_surface(const vndf_batch *b, size_t i)
{
    size_t k = (b->shared & VNDF_SHARED_ALPHA) ? 0 : i;
    vndf_affine s = {0};
    if (b->alpha_x[k] > 0.0f && b->alpha_y[k] > 0.0f) {
        s.distribution = b->distribution;
        s.xx = b->alpha_x[k];
        s.yy = b->alpha_y[k];
    }
    return s;
}

static vndf_vec3 plain_direction(const vndf_batch *b, size_t i)
{
    size_t k = (b->shared & VNDF_SHARED_WI) ? 0 : i;
    vndf_vec3 w = {b->wi_x[k], b->wi_y[k], b->wi_z[k]};
    return w;
}
#define WM(i) ((vndf_vec3){wm.x[i], wm.y[i], wm.z[i]})
#define PUT(i, v) (wm.x[i] = (v).x, wm.y[i] = (v).y, wm.z[i] = (v).z)
#define BOTH(prefix, type, surf, dir) \
void vndf_##prefix##sample_n(const type *b, const float *u1, const float *u2, vndf_normals wm, float *pdf) { for (size_t i = 0; i < b->count; i++) { vndf_affine s = surf(b, i); vndf_view v = vndf_view_of(&s, dir(b, i)); float p; vndf_vec3 m = vndf_sample(&v, u1[i], u2[i], &p); PUT(i, m); if (pdf) pdf[i] = p; } } \
void vndf_##prefix##pdf_n(const type *b, vndf_normals wm, float *pdf) { for (size_t i = 0; i < b->count; i++) { vndf_affine s = surf(b, i); vndf_view v = vndf_view_of(&s, dir(b, i)); pdf[i] = vndf_pdf(&v, WM(i)); } } \
void vndf_##prefix##visible_n(const type *b, vndf_normals wm, float *pdf) { for (size_t i = 0; i < b->count; i++) { vndf_affine s = surf(b, i); vndf_view v = vndf_view_of(&s, dir(b, i)); pdf[i] = vndf_visible(&v, WM(i)); } } \
void vndf_##prefix##invert_n(const type *b, vndf_normals wm, float *u1, float *u2) { for (size_t i = 0; i < b->count; i++) { vndf_affine s = surf(b, i); vndf_view v = vndf_view_of(&s, dir(b, i)); float a, c; vndf_invert(&v, WM(i), &a, &c); u1[i] = a; u2[i] = c; } } \
void vndf_##prefix##ndf_n(const type *b, vndf_normals wm, float *ndf) { for (size_t i = 0; i < b->count; i++) { vndf_affine s = surf(b, i); ndf[i] = vndf_affine_ndf(&s, WM(i)); } } \
void vndf_##prefix##projected_area_n(const type *b, float *o) { for (size_t i = 0; i < b->count; i++) { vndf_affine s = surf(b, i); o[i] = vndf_affine_projected_area(&s, dir(b, i)); } } \
void vndf_##prefix##lambda_n(const type *b, float *o) { for (size_t i = 0; i < b->count; i++) { vndf_affine s = surf(b, i); o[i] = vndf_affine_lambda(&s, dir(b, i)); } } \
void vndf_##prefix##g1_n(const type *b, float *o) { for (size_t i = 0; i < b->count; i++) { vndf_affine s = surf(b, i); o[i] = vndf_affine_g1(&s, dir(b, i)); } }
BOTH(affine_, vndf_affine_batch, vndf_batch_surface, vndf_batch_direction)
BOTH(, vndf_batch, plain_surface, plain_direction)
void vndf_sample_weight_n(const vndf_batch *b, const float *u1, const float *u2, vndf_normals wm, float *pdf, float *weight) { for (size_t i = 0; i < b->count; i++) { vndf_affine s = plain_surface(b, i); vndf_view v = vndf_view_of(&s, plain_direction(b, i)); float p, w; vndf_vec3 m = vndf_sample_weight(&v, u1[i], u2[i], &p, &w); PUT(i, m); if (pdf) pdf[i] = p; weight[i] = w; } }
#define MIX(i) vndf_mixture m = vndf_batch_mixture(b, i); vndf_vec3 wi = vndf_batch_mixture_direction(b, i)
void vndf_mixture_sample_n(const vndf_mixture_batch *b, const float *u1, const float *u2, vndf_normals wm, float *pdf, int *lobe) { for (size_t i = 0; i < b->count; i++) { MIX(i); vndf_mixture_view v = vndf_mixture_view_from(&m, wi); float p; int l; vndf_vec3 n = vndf_mixture_sample(&v, u1[i], u2[i], &p, &l); PUT(i, n); if (pdf) pdf[i] = p; if (lobe) lobe[i] = l; } }
void vndf_mixture_pdf_n(const vndf_mixture_batch *b, vndf_normals wm, float *pdf) { for (size_t i = 0; i < b->count; i++) { MIX(i); vndf_mixture_view v = vndf_mixture_view_from(&m, wi); pdf[i] = vndf_mixture_pdf(&v, WM(i)); } }
void vndf_mixture_visible_n(const vndf_mixture_batch *b, vndf_normals wm, float *o) { for (size_t i = 0; i < b->count; i++) { MIX(i); vndf_mixture_view v = vndf_mixture_view_from(&m, wi); o[i] = vndf_mixture_visible(&v, WM(i)); } }
void vndf_mixture_invert_n(const vndf_mixture_batch *b, vndf_normals wm, const int *asked, float *u1, float *u2, int *lobe) { for (size_t i = 0; i < b->count; i++) { MIX(i); vndf_mixture_view v = vndf_mixture_view_from(&m, wi); float a, c; int l = vndf_mixture_invert(&v, WM(i), asked ? asked[i] : -1, &a, &c); u1[i] = a; u2[i] = c; if (lobe) lobe[i] = l; } }
void vndf_mixture_ndf_n(const vndf_mixture_batch *b, vndf_normals wm, float *o) { for (size_t i = 0; i < b->count; i++) { vndf_mixture m = vndf_batch_mixture(b, i); o[i] = vndf_mixture_ndf(&m, WM(i)); } }
void vndf_mixture_projected_area_n(const vndf_mixture_batch *b, float *o) { for (size_t i = 0; i < b->count; i++) { MIX(i); o[i] = vndf_mixture_projected_area(&m, wi); } }
void vndf_mixture_lambda_n(const vndf_mixture_batch *b, float *o) { for (size_t i = 0; i < b->count; i++) { MIX(i); o[i] = vndf_mixture_lambda(&m, wi); } }
void vndf_mixture_g1_n(const vndf_mixture_batch *b, float *o) { for (size_t i = 0; i < b->count; i++) { MIX(i); o[i] = vndf_mixture_g1(&m, wi); } }
