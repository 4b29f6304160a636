/* What a kernel of `vndf export` is asked, in the kernel's own part of C: the same text goes to every language.
 *
 * A question is a surface (its distribution by the place of its numbers, matrix, mean slope), wi, three uniform
 * numbers, wo; of normals the parameter of a family in the place of wo_x, and whether they are bounded in that of
 * wo_y. */
typedef struct question {
    float of, xx, xy, yx, yy, mean_x, mean_y, wi_x, wi_y, wi_z, u1, u2, u3, wo_x, wo_y, wo_z;
} question;

typedef struct answer {
    float a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11, a12, a13, a14, a15;
} answer;

KERNEL vndf_surface surface_asked(question q)
{
    const vndf_surface s = {to_int(q.of), q.xx, q.xy, q.yx, q.yy, q.mean_x, q.mean_y};
    return s;
}

/* ---- normals ---- */

/* The normal that is drawn, the density that comes with it, and what calls say of that normal and of wi: G2 is of wi
 * and the normal. Then a normal of the family tails.vndfs with the shape of the surface, and of GGX with alpha 0.3. */
KERNEL answer ask(question q)
{
    const vec3 wi = vec3(q.wi_x, q.wi_y, q.wi_z);
    const vndf_surface surface = surface_asked(q);
    const vndf_view view = vndf_view_from(surface, wi);
    vndf_sampled drawn = vndf_sample(view, q.u1, q.u2);
    if (q.wo_y > 0.0f)
        drawn = vndf_bounded_sample(view, q.u1, q.u2);
    float pdf = vndf_pdf(view, drawn.wm);
    if (q.wo_y > 0.0f)
        pdf = vndf_bounded_pdf(view, drawn.wm);
    vndf_mixture mixture = vndf_family_at(VNDF_TAILS, q.wo_x, surface);
    mixture.lobe[2].surface = vndf_rough(VNDF_GGX, 0.3f, 0.3f);
    mixture.lobe[2].weight = 0.6f;
    mixture.count = 3;
    const vndf_mixture_view lobes = vndf_mixture_view_from(mixture, wi);
    const vndf_mixed mixed = vndf_mixture_sample(lobes, q.u1, q.u2);
    const vec3 wm = drawn.wm, of_all = mixed.wm;
    const answer a = {wm.x,
                      wm.y,
                      wm.z,
                      drawn.pdf,
                      pdf,
                      vndf_visible(view, wm),
                      vndf_ndf(surface, wm),
                      vndf_lambda(surface, wi),
                      vndf_g1(surface, wi),
                      vndf_g2(surface, wi, wm),
                      vndf_projected_area(surface, wi),
                      of_all.x,
                      of_all.y,
                      of_all.z,
                      mixed.pdf,
                      vndf_mixture_pdf(lobes, of_all)};
    return a;
}

/* ---- BSDFs: instead ---- */

/* A sample: wo, weight, density, lobe; f and density of the given wo; both of that of the sample. */
KERNEL answer ask(question q)
{
    vndf_material material;
    material.surface = surface_asked(q);
    if (is_indexed)
        material.eta = 1.5f;
    if (fresnel_of == VNDF_FRESNEL_SCHLICK)
        material.f0 = vec3(0.0f, 0.04f, 0.9f);
    if (fresnel_of == VNDF_FRESNEL_CONDUCTOR) {
        material.conductor_eta = vec3(0.2f, 0.9f, 1.5f);
        material.conductor_k = vec3(3.9f, 2.4f, 1.9f);
    }
    const vndf_bsdf bsdf = vndf_bsdf_at(material, vec3(q.wi_x, q.wi_y, q.wi_z));
    const vndf_scattered s = vndf_bsdf_sample(bsdf, vec3(q.u1, q.u2, q.u3));
    const vec3 wo = vec3(q.wo_x, q.wo_y, q.wo_z), f = vndf_bsdf_eval(bsdf, wo), own = vndf_bsdf_eval(bsdf, s.wo);
    const answer a = {s.wo.x,     s.wo.y,     s.wo.z, s.weight.x,
                      s.weight.y, s.weight.z, s.pdf,  to_real(s.lobe),
                      f.x,        f.y,        f.z,    vndf_bsdf_pdf(bsdf, wo),
                      own.x,      own.y,      own.z,  vndf_bsdf_pdf(bsdf, s.wo)};
    return a;
}
