/* ---- several lobes on one surface ---- */

/* Up to VNDF_LOBES surfaces with weights that need no sum. */
typedef struct vndf_mixture {
    int count;
    vndf_surface lobe[VNDF_LOBES];
    float weight[VNDF_LOBES];
} vndf_mixture;

/* Seen from wi: each lobe has a share of the area that is drawn. */
typedef struct vndf_mixture_view {
    int count;
    vndf_view lobe[VNDF_LOBES];
    float weight[VNDF_LOBES]; /* of sum 1 */
    float share[VNDF_LOBES];
} vndf_mixture_view;

/* The weights, of sum 1. Copies, here and below, since some languages index no parameter. Loops have a constant
 * end, so that a GPU unrolls them: what is indexed by a variable lies in local memory. */
KERNEL vndf_mixture weighed_evenly(vndf_mixture mixture)
{
    vndf_mixture lobes = mixture;
    float largest = 1e-37f, sum = 0.0f;
    for (int i = 0; i < VNDF_LOBES; i++)
        if (i < lobes.count)
            largest = max(largest, lobes.weight[i]);
    for (int j = 0; j < VNDF_LOBES; j++)
        if (j < lobes.count) {
            lobes.weight[j] = lobes.weight[j] / largest;
            sum = sum + lobes.weight[j];
        }
    for (int k = 0; k < VNDF_LOBES; k++)
        if (k < lobes.count)
            lobes.weight[k] = lobes.weight[k] / sum;
    return lobes;
}

KERNEL vndf_mixture_view vndf_mixture_view_from(vndf_mixture mixture, vec3 wi)
{
    vndf_mixture lobes = weighed_evenly(mixture);
    vndf_mixture_view view;
    float area = 0.0f;
    view.count = lobes.count;
    for (int i = 0; i < VNDF_LOBES; i++)
        if (i < lobes.count) {
            view.lobe[i] = vndf_view_from(lobes.lobe[i], wi);
            view.weight[i] = lobes.weight[i];
            view.share[i] = lobes.weight[i] * drawn_area(view.lobe[i]);
            area = area + view.share[i];
        }
    for (int j = 0; j < VNDF_LOBES; j++)
        if (j < lobes.count) {
            if (area > 1.17549435e-38f)
                view.share[j] = view.share[j] / area;
            else
                view.share[j] = lobes.weight[j];
        }
    return view;
}

/* A sum of densities, above 0 where something is seen. */
KERNEL float mixed_density(float sum)
{
    if (!(sum > 0.0f))
        return 0.0f;
    return min(max(sum, 1.17549435e-38f), 3.4028234e38f);
}

KERNEL float vndf_mixture_pdf(vndf_mixture_view view, vec3 wm)
{
    vndf_mixture_view lobes = view;
    float density = 0.0f;
    for (int i = 0; i < VNDF_LOBES; i++)
        if (i < lobes.count)
            density = density + lobes.share[i] * vndf_pdf(lobes.lobe[i], wm);
    return mixed_density(density);
}

KERNEL float vndf_mixture_visible(vndf_mixture_view view, vec3 wm)
{
    vndf_mixture_view lobes = view;
    float density = 0.0f, area = 0.0f;
    for (int i = 0; i < VNDF_LOBES; i++)
        if (i < lobes.count)
            area = area + lobes.weight[i] * area(lobes.lobe[i]);
    for (int j = 0; j < VNDF_LOBES; j++)
        if (j < lobes.count) {
            float share = lobes.weight[j];
            if (area > 1.17549435e-38f)
                share = share * area(lobes.lobe[j]) / area;
            density = density + share * vndf_visible(lobes.lobe[j], wm);
        }
    return min(density, 3.4028234e38f);
}

/* u1 says which lobe is drawn, and its part of 1 is stretched to [0, 1]; the density is that of the whole. */
typedef struct vndf_mixed {
    vec3 wm;
    float pdf;
} vndf_mixed;

KERNEL vndf_mixed vndf_mixture_sample(vndf_mixture_view view, float u1, float u2)
{
    vndf_mixture_view lobes = view;
    vndf_view chosen = lobes.lobe[0];
    float before = 0.0f, share = lobes.share[0], density = 0.0f;
    int at = 0;
    for (int i = 1; i < VNDF_LOBES; i++)
        if (i < lobes.count && lobes.share[i] > 0.0f && u1 >= before + share) {
            before = before + share;
            at = i;
            chosen = lobes.lobe[i];
            share = lobes.share[i];
        }
    const vndf_sampled one = vndf_sample(chosen, (u1 - before) / max(share, 1e-37f), u2);
    for (int j = 0; j < VNDF_LOBES; j++)
        if (j < lobes.count) {
            if (j == at)
                density = density + lobes.share[j] * one.pdf;
            else
                density = density + lobes.share[j] * vndf_pdf(lobes.lobe[j], one.wm);
        }
    const vndf_mixed drawn_normal = {one.wm, mixed_density(density)};
    return drawn_normal;
}

KERNEL float vndf_mixture_ndf(vndf_mixture mixture, vec3 wm)
{
    vndf_mixture lobes = weighed_evenly(mixture);
    float density = 0.0f;
    for (int i = 0; i < VNDF_LOBES; i++)
        if (i < lobes.count)
            density = density + lobes.weight[i] * vndf_ndf(lobes.lobe[i], wm);
    return min(density, 3.4028234e38f);
}

/* only family */
/* A family at a parameter, with the matrix and the mean slope of a surface, whose distribution is not read: a mixture
 * of the tables at both neighbours of the parameter. Its numbers: how many tables, whether shares are linear in 1/p,
 * then p and the place of each. */
KERNEL vndf_mixture vndf_family_at(int family, float parameter, vndf_surface shape)
{
    const int knots = to_int(fetch(family));
    const float p = min(max(parameter, fetch(family + 2)), fetch(family + 2 * knots));
    int at = family + 2;
    for (int i = 2; i < knots; i++)
        if (fetch(at + 2) <= p)
            at = at + 2;
    vndf_mixture mixture;
    mixture.count = min_int(knots, 2);
    for (int k = 0; k < VNDF_LOBES; k++) {
        mixture.lobe[k] = shape;
        mixture.weight[k] = 0.0f;
    }
    mixture.lobe[0].distribution = to_int(fetch(at + 1));
    mixture.weight[0] = 1.0f;
    if (knots > 1) {
        const float next = fetch(at + 2);
        float share = (p - fetch(at)) / (next - fetch(at));
        if (fetch(family + 1) > 0.0f)
            share = share * (next / p);
        mixture.lobe[1].distribution = to_int(fetch(at + 3));
        mixture.weight[1] = share;
        mixture.weight[0] = 1.0f - share;
    }
    return mixture;
}
/* end */
