/* What a kernel of `vndf export` is asked, in the kernel's own part of C: the same text goes to every language.
 *
 * A question is a surface (its distribution by the place of its numbers, matrix, mean slope), wi, three uniform
 * numbers, wo. */
typedef struct question {
    float n[16];
} question;

typedef struct answer {
    float n[16];
} answer;

HERE vndf_surface surface_asked(question q)
{
    const vndf_surface s = {to_whole(q.n[0]), q.n[1], q.n[2], q.n[3], q.n[4], q.n[5], q.n[6]};
    return s;
}

/* only normals */
/* The normal that is drawn, the density that comes with it, and what calls say of that normal and of wi: G2 is of wi
 * and the normal. Then a normal of two lobes, 0.6 of the surface and 0.4 of GGX with alpha 0.3. */
HERE answer ask(question q)
{
    const vec3 wi = vec3(q.n[7], q.n[8], q.n[9]);
    const vndf_surface surface = surface_asked(q);
    const vndf_view view = vndf_view_of(surface, wi);
    const vndf_sampled drawn = vndf_sample(view, q.n[10], q.n[11]);
    answer a;
    a.n[0] = drawn.wm.x;
    a.n[1] = drawn.wm.y;
    a.n[2] = drawn.wm.z;
    a.n[3] = drawn.pdf;
    a.n[4] = vndf_pdf(view, drawn.wm);
    a.n[5] = vndf_visible(view, drawn.wm);
    a.n[6] = vndf_ndf(surface, drawn.wm);
    a.n[7] = vndf_lambda(surface, wi);
    a.n[8] = vndf_g1(surface, wi);
    a.n[9] = vndf_g2(surface, wi, drawn.wm);
    a.n[10] = vndf_projected_area(view);
    vndf_mixture mixture;
    mixture.count = 2;
    for (int i = 0; i < VNDF_LOBES; i++) {
        mixture.lobe[i] = surface;
        mixture.weight[i] = 0.6f;
    }
    mixture.lobe[1] = vndf_surface_of(VNDF_GGX, 0.3f, 0.3f);
    mixture.weight[1] = 0.4f;
    const vndf_mixture_view lobes = vndf_mixture_view_of(mixture, wi);
    const vndf_mixed mixed = vndf_mixture_sample(lobes, q.n[10], q.n[11]);
    a.n[11] = mixed.wm.x;
    a.n[12] = mixed.wm.y;
    a.n[13] = mixed.wm.z;
    a.n[14] = mixed.pdf;
    a.n[15] = vndf_mixture_pdf(lobes, mixed.wm);
    return a;
}
/* end */
/* only bsdf */
/* A sample: wo, weight, density, lobe; f and density of the given wo; both of that of the sample. */
HERE answer ask(question q)
{
    vndf_material material;
    material.surface = surface_asked(q);
    material.eta = 1.5f;                             /* only indexed */
    material.f0 = vec3(0.0f, 0.04f, 0.9f);           /* only fresnel=schlick */
    material.conductor_eta = vec3(0.2f, 0.9f, 1.5f); /* only fresnel=conductor */
    material.conductor_k = vec3(3.9f, 2.4f, 1.9f);   /* only fresnel=conductor */
    const vndf_bsdf bsdf = vndf_bsdf_of(material, vec3(q.n[7], q.n[8], q.n[9]));
    const vndf_scattered s = vndf_bsdf_sample(bsdf, vec3(q.n[10], q.n[11], q.n[12]));
    const vec3 wo = vec3(q.n[13], q.n[14], q.n[15]), f = vndf_bsdf_eval(bsdf, wo),
               own = vndf_bsdf_eval(bsdf, s.wo);
    answer a;
    a.n[0] = s.wo.x;
    a.n[1] = s.wo.y;
    a.n[2] = s.wo.z;
    a.n[3] = s.weight.x;
    a.n[4] = s.weight.y;
    a.n[5] = s.weight.z;
    a.n[6] = s.pdf;
    a.n[7] = to_real(s.lobe);
    a.n[8] = f.x;
    a.n[9] = f.y;
    a.n[10] = f.z;
    a.n[11] = vndf_bsdf_pdf(bsdf, wo);
    a.n[12] = own.x;
    a.n[13] = own.y;
    a.n[14] = own.z;
    a.n[15] = vndf_bsdf_pdf(bsdf, s.wo);
    return a;
}
/* end */
