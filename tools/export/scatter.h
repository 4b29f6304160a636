/* The calls of vndf_bsdf.h over kernel/event.h. */

/* ---- of three wavelengths ---- */

KERNEL vec3 reflectances(vndf_bsdf b, seen_cosine c)
{
    optics x;
    if (is_alike) {
        const float one = reflectance(b.material, x, c, b.h.eta);
        return vec3(one, one, one);
    }
    optics y, z;
    if (fresnel_of(b) == VNDF_FRESNEL_SCHLICK) {
        x.f0 = b.material.f0.x;
        y.f0 = b.material.f0.y;
        z.f0 = b.material.f0.z;
    }
    if (fresnel_of(b) == VNDF_FRESNEL_CONDUCTOR) {
        x.n = b.material.conductor_eta.x;
        y.n = b.material.conductor_eta.y;
        z.n = b.material.conductor_eta.z;
        x.k = b.material.conductor_k.x;
        y.k = b.material.conductor_k.y;
        z.k = b.material.conductor_k.z;
    }
    return vec3(reflectance(b.material, x, c, b.h.eta), reflectance(b.material, y, c, b.h.eta),
                reflectance(b.material, z, c, b.h.eta));
}

/* The mean, which is exact where all are the same. */
KERNEL float mean_of(vec3 f)
{
    return f.x + ((f.y - f.x) + (f.z - f.x)) * 0.333333333f;
}

/* What a lobe has of the light, for reflectances f. */
KERNEL vec3 light_of(vec3 f, int reflects)
{
    if (transmits_of(f) && reflects == 0)
        return vec3(1.0f - f.x, 1.0f - f.y, 1.0f - f.z);
    return f;
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
    const seen_cosine c = seen_cosine_of(b.h.wi, n.wm);
    const vec3 f = reflectances(b, c);
    const float mean = mean_of(f);
    const int reflects = chooses_reflection(b.material, mean, u.z);
    const event e = event_at(b, n.wm, c, reflects);
    if (!any(e.met) || !(b.h.rise > 0.0f))
        return s;
    const float part = part_of(b.material, mean, reflects);
    s.wo = scaled(select(eq(reflects, 1), b.side, -b.side), e.up);
    s.weight = scaled(event_weight(b, e, n.weight, reflects) / part, light_of(f, reflects));
    s.pdf = min(max(n.pdf * e.jacobian * part, 1.17549435e-38f), 3.4028234e38f);
    s.lobe = 2 - reflects;
    if (transmits_of(b) && reflects == 0 && b.h.eta == 1.0f) {
        s.pdf = 1.0f;
        s.lobe = 3;
    }
    if (is_retro && reflects != 0)
        s.wo = vec3(-s.wo.x, -s.wo.y, s.wo.z);
    return s;
}

/* ---- values and densities ---- */

typedef struct meeting {
    event e;
    int reflects;
} meeting;

KERNEL meeting meeting_of(vndf_bsdf b, vec3 given)
{
    vec3 wo = scaled(b.side, given);
    if (is_retro && wo.z > 0.0f)
        wo = vec3(-wo.x, -wo.y, wo.z);
    const float rise = projected(b.material.surface, wo);
    mask there = lt(0.0f, abs(rise));
    if (!transmits_of(b))
        there = lt(0.0f, rise);
    if (!reflects_of(b))
        there = lt(rise, 0.0f);
    meeting m;
    m.reflects = select_int(lt(0.0f, rise), 1, 0);
    m.e = event_of(b, wo, rise, m.reflects);
    m.e.met = both(m.e.met, there);
    return m;
}

/* f of the three wavelengths, without the cosine. */
KERNEL vec3 vndf_bsdf_eval(vndf_bsdf b, vec3 wo)
{
    const meeting m = meeting_of(b, wo);
    if (!any(m.e.met))
        return vec3(0.0f, 0.0f, 0.0f);
    const seen_cosine c = {m.e.facing, m.e.rest};
    const float value = event_value(b, m.e, masked(b, m.e, m.reflects), seen_ndf(b.view, m.e.wm));
    return scaled(value, light_of(reflectances(b, c), m.reflects));
}

/* The density per steradian with which vndf_bsdf_sample draws wo. */
KERNEL float vndf_bsdf_pdf(vndf_bsdf b, vec3 wo)
{
    const meeting m = meeting_of(b, wo);
    float part = 1.0f;
    if (!any(m.e.met))
        return 0.0f;
    if (reflects_of(b) && transmits_of(b)) {
        const seen_cosine c = {m.e.facing, m.e.rest};
        part = part_of(b.material, mean_of(reflectances(b, c)), m.reflects);
    }
    return min(part * (vndf_pdf(b.view, m.e.wm) * m.e.jacobian), 3.4028234e38f);
}
