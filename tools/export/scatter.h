/* The BSDF that `--bsdf` asks for: the calls of vndf_bsdf.h over kernel/lobes.h, with the effects that are chosen
 * and nothing else. */

/* ---- materials and hits ---- */

/* A surface and its optics; indices are those beyond over that on the side of z. */
typedef struct vndf_material {
    vndf_surface surface;
    float eta;                                                     /* only indexed */
    vec3 f0; /* reflectance at normal incidence */                 /* only fresnel=schlick */
    vec3 conductor_eta, conductor_k; /* real and imaginary part */ /* only fresnel=conductor */
} vndf_material;

/* A hit. Its frame is turned about the origin where wi is below the mean plane, so that wi is above: side is -1
 * then. */
typedef struct vndf_bsdf {
    vndf_material material;
    vndf_view view;
    float side, eta;        /* eta: index on the other side over that on the side of wi */
    float rise, area, tilt; /* of wi: projection on the mean plane, projected area; length of (mean slope, 1) */
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

/* wi is unit, towards the viewer. */
KERNEL vndf_bsdf vndf_bsdf_at(vndf_material material, vec3 wi)
{
    const vndf_surface m = material.surface;
    vndf_bsdf b;
    b.material = material;
    b.side = 1.0f;
    b.eta = 1.0f;
    /* only indexed */
    b.eta = material.eta;
    if (projected(m, wi) < 0.0f) {
        b.side = -1.0f;
        b.eta = 1.0f / material.eta;
    }
    /* end */
    b.view = vndf_view_from(m, scaled(b.side, wi));
    b.rise = projected(m, b.view.wi);
    b.area = area(b.view);
    b.tilt = sqrt(1.0f + (m.mean_x * m.mean_x + m.mean_y * m.mean_y));
    return b;
}

/* The cosine of wo that goes with f: wo.z, or to the normal of the mean plane. */
KERNEL float vndf_bsdf_cosine(vndf_bsdf b, vec3 wo)
{
    return projected(b.material.surface, wo) / b.tilt;
}

/* ---- terms ---- */

/* Reflectances of the three wavelengths at a microfacet. */
KERNEL vec3 reflectances(vndf_bsdf b, seen_cosine c)
{
    const float total = select(lt(0.0f, refracted_square(c.facing, b.eta)), 0.0f, 1.0f); /* only fresnel=none */
    return vec3(total, total, total);                                                    /* only fresnel=none */
    const float one = dielectric(c.facing, b.eta); /* only fresnel=dielectric */
    return vec3(one, one, one);                    /* only fresnel=dielectric */
    const vec3 f0 = b.material.f0;                 /* only fresnel=schlick */
    float rest = c.rest;                           /* only fresnel=schlick */
    if (b.eta < 1.0f)                              /* only fresnel=schlick transmits */
        rest = refracted_rest(rest, b.eta);        /* only fresnel=schlick transmits */
    return vec3(schlick(rest, f0.x), schlick(rest, f0.y), schlick(rest, f0.z)); /* only fresnel=schlick */
    /* only fresnel=conductor */
    const vec3 n = b.material.conductor_eta, k = b.material.conductor_k;
    return vec3(conductor(c.facing, n.x, k.x), conductor(c.facing, n.y, k.y), conductor(c.facing, n.z, k.z));
    /* end */
}

/* A microfacet between two directions, and whether it reflects. */
typedef struct meeting {
    event e;
    int reflects;
} meeting;

/* What its lobe has of the light, and of the samples: the mean, which is exact where all are the same. */
typedef struct lobe_share {
    vec3 f;
    float part;
} lobe_share;

KERNEL lobe_share share_of(vndf_bsdf b, meeting m)
{
    lobe_share s = {vec3(1.0f, 1.0f, 1.0f), 1.0f};
    /* only coloured */
    const seen_cosine c = {m.e.facing, m.e.rest};
    s.f = reflectances(b, c);
    s.part = s.f.x + ((s.f.y - s.f.x) + (s.f.z - s.f.x)) * 0.333333333f; /* only lobes=both */
    /* only transmits */
    if (m.reflects == 0) {
        s.f = vec3(1.0f - s.f.x, 1.0f - s.f.y, 1.0f - s.f.z);
        s.part = 1.0f - s.part; /* only lobes=both */
    }
    /* end */
    return s;
}

/* G2/(cos_i cos_o), of transmission with what the transport asks for. */
KERNEL float masked(vndf_bsdf b, meeting m)
{
    const event e = m.e;
    const float area_o = area_along(b.view, e.up); /* only smith */
    float carried = 1.0f;
    /* only transmits transport=radiance */
    if (m.reflects == 0)
        carried = 1.0f / (b.eta * b.eta);
    /* only transmits masking=correlated */
    if (m.reflects == 0)
        return carried * passed_by_height(b.rise, e.rise, b.area, area_o);
    /* only transmits masking=v-cavities */
    if (m.reflects == 0)
        return carried * passed_in_cavities(b.rise, e.rise, e.facing, e.beyond, e.wm.z);
    /* end */
    return carried * masked_by_height(b.rise, e.rise, b.area, area_o);     /* only masking=correlated */
    return carried * masked_apart(b.area, area_o);                         /* only masking=separable */
    return carried * masked_in_cavities(b.rise, e.rise, e.facing, e.wm.z); /* only masking=v-cavities */
    return carried / (b.rise * e.rise);                                    /* only masking=none */
}

/* ---- samples ---- */

/* wo, f |cosine of wo|/density of the three wavelengths, and the density per steradian. The lobe is 0 where the
 * sample is lost, 1 for reflection, 2 for transmission, and 3 for what goes straight on where eta is 1, a Dirac of
 * density 1. */
typedef struct vndf_scattered {
    vec3 wo, weight;
    float pdf;
    int lobe;
} vndf_scattered;

/* Of three uniform numbers in [0, 1] two draw the normal; the third chooses the lobe where there are two. */
KERNEL vndf_scattered vndf_bsdf_sample(vndf_bsdf b, vec3 u)
{
    vndf_scattered s = {vec3(0.0f, 0.0f, 1.0f), vec3(0.0f, 0.0f, 0.0f), 0.0f, 0};
    const vndf_sampled n = vndf_sample(b.view, u.x, u.y);
    const vec3 wi = b.view.wi, wm = n.wm;
    const seen_cosine c = seen_cosine_of(wi, wm);
    meeting m;
    m.reflects = 1; /* only lobes=reflection */
    m.reflects = 0; /* only lobes=transmission */
    /* only lobes=both */
    m.reflects = 1;
    m.e.facing = c.facing;
    m.e.rest = c.rest;
    const float part = share_of(b, m).part;
    m.reflects = select_int(either(both(lt(0.0f, part), lt(u.z, part)), le(1.0f, part)), 1, 0);
    /* end */
    if (m.reflects != 0)                      /* only reflects */
        m.e = reflected_at(wi, wm, c);        /* only reflects */
    if (m.reflects == 0)                      /* only transmits */
        m.e = refracted_at(wi, wm, c, b.eta); /* only transmits */
    m.e.rise = projected(b.material.surface, m.e.up);
    if (!any(m.e.met) || !(m.e.rise > 0.0f) || !(b.rise > 0.0f))
        return s;
    const lobe_share share = share_of(b, m);                 /* only coloured */
    const lobe_share share = {vec3(1.0f, 1.0f, 1.0f), 1.0f}; /* only fresnel=none lobes=reflection */
    s.wo = scaled(select(eq(m.reflects, 1), b.side, -b.side), m.e.up);
    s.weight = scaled(masked(b, m) * m.e.rise * (b.area * n.weight) / share.part, share.f);
    s.pdf = min(max(n.pdf * m.e.jacobian * share.part, 1.17549435e-38f), 3.4028234e38f);
    s.lobe = 2 - m.reflects;
    /* only transmits */
    if (m.reflects == 0 && b.eta == 1.0f) {
        s.pdf = 1.0f;
        s.lobe = 3;
    }
    /* end */
    if (m.reflects != 0)                       /* only reflection=retro */
        s.wo = vec3(-s.wo.x, -s.wo.y, s.wo.z); /* only reflection=retro */
    return s;
}

/* ---- values and densities ---- */

KERNEL meeting meeting_of(vndf_bsdf b, vec3 given)
{
    const vec3 wi = b.view.wi;
    vec3 wo = scaled(b.side, given);
    meeting m;
    if (wo.z > 0.0f)                   /* only reflection=retro */
        wo = vec3(-wo.x, -wo.y, wo.z); /* only reflection=retro */
    const float rise = projected(b.material.surface, wo);
    m.reflects = select_int(lt(0.0f, rise), 1, 0);
    m.e.met = lt(rise, rise); /* no */
    /* only reflects */
    if (rise > 0.0f) {
        m.e = reflecting(wi, wo);
        m.e.rest = reflecting_rest(m.e, wi, wo);
    }
    /* end */
    if (rise < 0.0f)                                    /* only transmits */
        m.e = refracting(wi, scaled(-1.0f, wo), b.eta); /* only transmits */
    m.e.rise = abs(rise);
    m.e.met = both(m.e.met, lt(0.0f, b.rise));
    return m;
}

/* f of the three wavelengths, without the cosine. */
KERNEL vec3 vndf_bsdf_eval(vndf_bsdf b, vec3 wo)
{
    const meeting m = meeting_of(b, wo);
    vec3 f = vec3(1.0f, 1.0f, 1.0f);
    if (!any(m.e.met))
        return vec3(0.0f, 0.0f, 0.0f);
    f = share_of(b, m).f; /* only coloured */
    const float ndf = seen_ndf(b.view, m.e.wm);
    return scaled(b.tilt * ndf * m.e.facing * m.e.jacobian * masked(b, m), f);
}

/* The density per steradian with which vndf_bsdf_sample draws wo. */
KERNEL float vndf_bsdf_pdf(vndf_bsdf b, vec3 wo)
{
    const meeting m = meeting_of(b, wo);
    float part = 1.0f;
    if (!any(m.e.met))
        return 0.0f;
    part = share_of(b, m).part; /* only lobes=both */
    return min(part * (vndf_pdf(b.view, m.e.wm) * m.e.jacobian), 3.4028234e38f);
}
