/* The calls of many: one after the other, where no instruction set has lanes for them. */
#include "core/inline.h"
#include "vndf.h"

vndf_instructions vndf_instructions_used(vndf_instructions limit)
{
    (void)limit;
    return VNDF_INSTRUCTIONS_PORTABLE;
}

/* Element i of a batch. */
VNDF_INLINE vndf_surface surface_at(const vndf_batch *b, size_t i)
{
    size_t at = b->shared & VNDF_SHARED_ALPHA ? 0 : i;
    vndf_surface surface = {b->distribution, b->alpha_x[at], b->alpha_y[at]};
    return surface;
}

VNDF_INLINE vndf_vec3 wi_at(const vndf_batch *b, size_t i)
{
    size_t at = b->shared & VNDF_SHARED_WI ? 0 : i;
    vndf_vec3 wi = {b->wi_x[at], b->wi_y[at], b->wi_z[at]};
    return wi;
}

VNDF_INLINE vndf_vec3 normal_at(vndf_normals wm, size_t i)
{
    vndf_vec3 n = {wm.x[i], wm.y[i], wm.z[i]};
    return n;
}

/* Whether all elements have one view. */
VNDF_INLINE int is_one_view(const vndf_batch *b)
{
    return (b->shared & VNDF_SHARED_ALPHA) && (b->shared & VNDF_SHARED_WI) && b->count > 0;
}

VNDF_INLINE vndf_view view_at(const vndf_batch *b, size_t i)
{
    vndf_surface surface = surface_at(b, i);
    return vndf_view_from(&surface, wi_at(b, i));
}

/* The view of element i, given that of the one before it. */
VNDF_INLINE void next_view(const vndf_batch *b, size_t i, vndf_view *view)
{
    if (i == 0 || !is_one_view(b))
        *view = view_at(b, i);
}

void vndf_sample_n(const vndf_batch *b, const float *u1, const float *u2, vndf_normals wm, float *pdf)
{
    vndf_view view;
    for (size_t i = 0; i < b->count; i++) {
        float density;
        next_view(b, i, &view);
        vndf_vec3 n = vndf_sample(&view, u1[i], u2[i], pdf ? &density : NULL);
        wm.x[i] = n.x;
        wm.y[i] = n.y;
        wm.z[i] = n.z;
        if (pdf)
            pdf[i] = density;
    }
}

void vndf_pdf_n(const vndf_batch *b, vndf_normals wm, float *pdf)
{
    vndf_view view;
    for (size_t i = 0; i < b->count; i++) {
        next_view(b, i, &view);
        pdf[i] = vndf_pdf(&view, normal_at(wm, i));
    }
}

void vndf_visible_n(const vndf_batch *b, vndf_normals wm, float *visible)
{
    vndf_view view;
    for (size_t i = 0; i < b->count; i++) {
        next_view(b, i, &view);
        visible[i] = vndf_visible(&view, normal_at(wm, i));
    }
}

void vndf_invert_n(const vndf_batch *b, vndf_normals wm, float *u1, float *u2)
{
    vndf_view view;
    for (size_t i = 0; i < b->count; i++) {
        float a, c;
        next_view(b, i, &view);
        vndf_invert(&view, normal_at(wm, i), &a, &c);
        u1[i] = a;
        u2[i] = c;
    }
}

void vndf_ndf_n(const vndf_batch *b, vndf_normals wm, float *ndf)
{
    for (size_t i = 0; i < b->count; i++) {
        vndf_surface surface = surface_at(b, i);
        ndf[i] = vndf_ndf(&surface, normal_at(wm, i));
    }
}

void vndf_projected_area_n(const vndf_batch *b, float *area)
{
    for (size_t i = 0; i < b->count; i++) {
        vndf_surface surface = surface_at(b, i);
        area[i] = vndf_projected_area(&surface, wi_at(b, i));
    }
}

void vndf_lambda_n(const vndf_batch *b, float *lambda)
{
    for (size_t i = 0; i < b->count; i++) {
        vndf_surface surface = surface_at(b, i);
        lambda[i] = vndf_lambda(&surface, wi_at(b, i));
    }
}

void vndf_g1_n(const vndf_batch *b, float *g1)
{
    for (size_t i = 0; i < b->count; i++) {
        vndf_surface surface = surface_at(b, i);
        g1[i] = vndf_g1(&surface, wi_at(b, i));
    }
}
