/* What exported kernels offer: the calls of vndf.h over the kernel's functions, for any distribution. */

/* ---- surfaces and views ---- */

/* A surface whose slopes (-wm.x/wm.z, -wm.y/wm.z) are (xx xy; yx yy) u + mean, where u are slopes of the
 * distribution: the first number of a table, VNDF_GGX or VNDF_BECKMANN. */
typedef struct vndf_surface {
    int distribution;
    float xx, xy, yx, yy, mean_x, mean_y;
} vndf_surface;

/* The surface with roughness alpha_x and alpha_y along x and y. */
KERNEL vndf_surface vndf_rough(int distribution, float alpha_x, float alpha_y)
{
    const vndf_surface m = {distribution, alpha_x, 0.0f, 0.0f, alpha_y, 0.0f, 0.0f};
    return m;
}

/* A surface seen from wi; what follows that is the kernel's. ex, ey and v are a table_view: WebGL allows structs in
 * structs no deeper. */
typedef struct vndf_view {
    vndf_surface surface;
    vec3 wi;
    frame at;
    float unit_area; /* of the unit problem */
    table t;
    float ex, ey;
    radial_law v;
    int below;
} vndf_view;

/* A view without what the distribution makes of it; its frame has the matrix in units of the distribution's slopes. */
KERNEL vndf_view placed(vndf_surface m, vec3 wi)
{
    vndf_view view;
    float scale = 1.0f;
    if (m.distribution >= 0) {
        scale = fetch(m.distribution + 3);
        view.t = table_at(m.distribution);
    }
    const affine_map s = {m.xx * scale, m.xy * scale, m.yx * scale, m.yy * scale, m.mean_x, m.mean_y, 0, 0.0f};
    view.surface = m;
    view.wi = wi;
    view.at = frame_of(affine_measured(s), wi.x, wi.y, wi.z);
    view.unit_area = 0.0f;
    return view;
}

/* wi is unit, and may be below the surface. */
KERNEL vndf_view vndf_view_from(vndf_surface m, vec3 wi)
{
    vndf_view view = placed(m, wi);
    if (m.distribution == VNDF_GGX)
        view.unit_area = ggx_area(view.at.ux, view.at.uy, view.at.uz);
    if (m.distribution == VNDF_BECKMANN)
        view.unit_area = beckmann_area(view.at.ux, view.at.uy, view.at.uz);
    view.below = select_int(lt(view.at.uz, 0.0f), 1, 0);
    if (m.distribution >= 0) {
        const table_view seen_from = table_view_of(view.t, view.at, view.below);
        view.ex = seen_from.ex;
        view.ey = seen_from.ey;
        view.v = seen_from.v;
        view.unit_area = law_area(view.t, view.v, view.below) * frame_reach(view.at);
    }
    return view;
}

/* The area of the surface as it is seen from wi. */
KERNEL float vndf_projected_area(vndf_view view)
{
    return view.unit_area * view.at.size;
}

/* ---- given normals ---- */

/* D times |det M|, of a normal of the unit problem. */
KERNEL float unit_ndf(vndf_view view, unit_normal n)
{
    if (view.surface.distribution == VNDF_GGX)
        return ggx_p22(n.x, n.y, n.z);
    if (view.surface.distribution == VNDF_BECKMANN)
        return beckmann_p22(n.x, n.y, n.z);
    if (view.surface.distribution >= 0)
        return table_p22(view.t, table_given(view.t, n.x, n.y, n.z));
    return 0.0f;
}

/* D of the surface of a view. */
KERNEL float placed_ndf(vndf_view view, vec3 wm)
{
    if (!(wm.z >= 0.0f))
        return 0.0f;
    return min(unit_ndf(view, frame_normal(view.at, wm.x, wm.y, wm.z)) / view.at.determinant, 3.4028234e38f);
}

/* D(wm) per steradian; wm is unit, here and below. */
KERNEL float vndf_ndf(vndf_surface m, vec3 wm)
{
    return placed_ndf(placed(m, vec3(0.0f, 0.0f, 1.0f)), wm);
}

/* The density with which vndf_sample draws wm. */
KERNEL float vndf_pdf(vndf_view view, vec3 wm)
{
    const frame f = view.at;
    unit_normal n = frame_normal(f, wm.x, wm.y, wm.z);
    float density = 0.0f;
    if (!(n.facing > 0.0f) || !(wm.z >= 0.0f))
        return 0.0f;
    if (view.surface.distribution == VNDF_GGX)
        density = ggx_density(ggx_see(f.ux, f.uy, f.uz), n.x, n.y, n.z, n.facing);
    if (view.surface.distribution == VNDF_BECKMANN)
        density = beckmann_density(beckmann_see(f.ux, f.uy, f.uz), n.x, n.y, n.z, n.facing);
    if (view.surface.distribution >= 0) {
        const table_view seen_from = {view.ex, view.ey, view.v};
        if (view.below != 0)
            n = table_unturned(view.ex, view.ey, n);
        density = table_pdf(view.t, seen_from, n, frame_reach(f), view.below);
    }
    return frame_density(f, density / f.determinant);
}

/* The visible normals D(wm) (wi . wm)/A(wi), from which a table differs by what it states. */
KERNEL float vndf_visible(vndf_view view, vec3 wm)
{
    unit_normal n = frame_normal(view.at, wm.x, wm.y, wm.z);
    if (view.surface.distribution < 0)
        return vndf_pdf(view, wm);
    if (!(n.facing > 0.0f) || !(wm.z >= 0.0f))
        return 0.0f;
    float ndf = unit_ndf(view, n) / view.at.determinant;
    return frame_density(view.at, ndf * (n.facing / max(view.unit_area, 1e-37f)));
}

/* ---- sampling ---- */

/* A normal, the density per steradian with which it is drawn, and the quotient (visible density)/density: weights of
 * estimators have it as a factor. */
typedef struct vndf_sampled {
    vec3 wm;
    float pdf, weight;
} vndf_sampled;

/* Draws a visible normal with two uniform numbers in [0, 1]. */
KERNEL vndf_sampled vndf_sample(vndf_view view, float w1, float w2)
{
    const float u1 = min(max(w1, 0.0f), 1.0f), u2 = min(max(w2, 0.0f), 1.0f);
    normal_sample n = {0.0f, 0.0f, 1.0f, 0.0f};
    float weight = 1.0f;
    if (view.surface.distribution == VNDF_GGX)
        n = ggx_draw(ggx_see(view.at.ux, view.at.uy, view.at.uz), u1, u2);
    if (view.surface.distribution == VNDF_BECKMANN)
        n = beckmann_draw(beckmann_see(view.at.ux, view.at.uy, view.at.uz), u1, u2);
    if (view.surface.distribution >= 0) {
        const table_view seen_from = {view.ex, view.ey, view.v};
        const weighted_sample both_drawn = table_draw_weighed(view.t, seen_from, u1, u2, view.below, 1);
        n = both_drawn.n;
        weight = both_drawn.weight;
    }
    const surface_sample s = frame_sampled(view.at, n);
    const vndf_sampled drawn_normal = {vec3(s.x, s.y, s.z), s.pdf, weight};
    return drawn_normal;
}

/* ---- masking ---- */

/* Lambda(w) = A(w)/cos - 1, where cos is w.z less what the mean slope takes of it. */
KERNEL float vndf_lambda(vndf_surface m, vec3 w)
{
    vndf_view view = vndf_view_from(m, w);
    return lambda_of(vndf_projected_area(view), view.at.uz * view.at.size);
}

KERNEL float vndf_g1(vndf_surface m, vec3 w)
{
    vndf_view view = vndf_view_from(m, w);
    return g1_of(vndf_projected_area(view), view.at.uz * view.at.size);
}

/* Masking and shadowing of two directions on the same side, height-correlated: 1/(1 + Lambda_i + Lambda_o). */
KERNEL float vndf_g2(vndf_surface m, vec3 wi, vec3 wo)
{
    float gi = vndf_g1(m, wi), go = vndf_g1(m, wo), lesser = min(gi, go), greater = max(gi, go);
    if (lesser == 0.0f)
        return 0.0f;
    return lesser * (greater / (greater + lesser * (1.0f - greater)));
}

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

/* The area of what a view draws. */
KERNEL float drawn_area(vndf_view view)
{
    float area = view.unit_area;
    if (!(view.at.max_pdf > 0.0f))
        return 0.0f;
    if (view.surface.distribution >= 0)
        area = law_drawn_area(view.v, view.below) * frame_reach(view.at);
    return area * view.at.size;
}

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
            area = area + lobes.weight[i] * vndf_projected_area(lobes.lobe[i]);
    for (int j = 0; j < VNDF_LOBES; j++)
        if (j < lobes.count) {
            float share = lobes.weight[j];
            if (area > 1.17549435e-38f)
                share = share * vndf_projected_area(lobes.lobe[j]) / area;
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
