/* What kernel/event.h asks for where it is exported with `--bsdf`. Effects are constants, whose ifs are folded:
 * is_indexed, there is an index ratio, and both sides are seen; is_alike, all wavelengths have one reflectance. */

/* ---- hits ---- */

/* Optics of one wavelength. */
typedef struct optics {
    float f0, n, k;
} optics;

/* In the frame of the hit: eta is the index on the other side over that on the side of wi; of wi the projection on the
 * mean plane and the projected area; the length of (mean slope, 1); what transmission has for the transport. */
typedef struct hit {
    vec3 wi;
    float eta, rise, area, tilt, carried;
} hit;

/* The frame is turned about the origin where wi is below the mean plane, so that wi is above: side is -1 then. */
typedef struct vndf_bsdf {
    vndf_material material;
    vndf_view view;
    hit h;
    float side;
} vndf_bsdf;

/* w.z without a mean slope. */
KERNEL float projected(vndf_surface m, vec3 w)
{
    return w.z - (w.x * m.mean_x + w.y * m.mean_y);
}

KERNEL vec3 scaled(float factor, vec3 w)
{
    return vec3(factor * w.x, factor * w.y, factor * w.z);
}

KERNEL float cosine_at(vndf_bsdf b, vec3 w)
{
    return projected(b.material.surface, w);
}

KERNEL float area_at(vndf_bsdf b, vec3 w)
{
    return area_along(b.view, w);
}

/* wi is unit, towards the viewer. */
KERNEL vndf_bsdf vndf_bsdf_at(vndf_material given, vec3 wi)
{
    const vndf_surface m = given.surface;
    vndf_bsdf b;
    b.material = given;
    b.side = 1.0f;
    b.h.eta = 1.0f;
    b.h.carried = 1.0f;
    if (is_indexed) {
        b.h.eta = given.eta;
        if (projected(m, wi) < 0.0f) {
            b.side = -1.0f;
            b.h.eta = 1.0f / given.eta;
        }
    }
    if (carries_radiance)
        b.h.carried = 1.0f / (b.h.eta * b.h.eta);
    b.view = vndf_view_from(m, scaled(b.side, wi));
    b.h.wi = b.view.wi;
    b.h.rise = projected(m, b.view.wi);
    b.h.area = area(b.view);
    b.h.tilt = sqrt(1.0f + (m.mean_x * m.mean_x + m.mean_y * m.mean_y));
    return b;
}

/* The cosine of wo that goes with f: wo.z, or to the normal of the mean plane. */
KERNEL float vndf_bsdf_cosine(vndf_bsdf b, vec3 wo)
{
    return projected(b.material.surface, wo) / b.h.tilt;
}
