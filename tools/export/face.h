/* What exported kernels offer: the calls of vndf.h over the kernel's functions, for any distribution. */

/* ---- surfaces and views ---- */

/* A surface whose slopes (-wm.x/wm.z, -wm.y/wm.z) are (xx xy; yx yy) u + mean, where u are slopes of the distribution:
 * the first number of a table, VNDF_GGX or VNDF_BECKMANN. */
typedef struct vndf_surface {
    int distribution;
    float xx, xy, yx, yy, mean_x, mean_y;
} vndf_surface;

/* The surface with roughness alpha_x and alpha_y along x and y. */
HERE vndf_surface vndf_surface_of(int distribution, float alpha_x, float alpha_y)
{
    const vndf_surface m = {distribution, alpha_x, 0.0f, 0.0f, alpha_y, 0.0f, 0.0f};
    return m;
}

/* A surface seen from wi; the members below `wi` are the kernel's. `area` is the area that is seen. */
typedef struct vndf_view {
    vndf_surface surface;
    vec3 wi;
    float area;
    frame at;
    /* only table */
    table t;
    table_view seen_from;
    int below;
    /* end */
} vndf_view;

/* The matrix in units of the distribution's slopes. */
HERE affine_map matrix_of(vndf_surface m)
{
    float scale = 1.0f;
    /* only table */
    if (m.distribution >= 0)
        scale = fetch(m.distribution + 3);
    /* end */
    const affine_map s = {m.xx * scale, m.xy * scale, m.yx * scale, m.yy * scale, m.mean_x, m.mean_y};
    return s;
}

/* wi is unit, and may be below the surface. */
HERE vndf_view vndf_view_of(vndf_surface m, vec3 wi)
{
    vndf_view view;
    view.surface = m;
    view.wi = wi;
    view.at = frame_of(matrix_of(m), wi.x, wi.y, wi.z);
    view.area = 0.0f;
    /* only ggx */
    if (m.distribution == VNDF_GGX)
        view.area = ggx_area(view.at.ux, view.at.uy, view.at.uz);
    /* end */
    /* only beckmann */
    if (m.distribution == VNDF_BECKMANN)
        view.area = beckmann_area(view.at.ux, view.at.uy, view.at.uz);
    /* end */
    /* only table */
    view.below = pick_whole(less(view.at.uz, 0.0f), 1, 0);
    if (m.distribution >= 0) {
        view.t = table_at(m.distribution);
        view.seen_from = table_view_of(view.t, view.at, view.below);
        view.area = law_area(view.t, view.seen_from.v) * frame_reach(view.at);
    }
    /* end */
    view.area = view.area * view.at.size;
    return view;
}

/* The area of the surface as it is seen from wi. */
HERE float vndf_projected_area(vndf_view view)
{
    return view.area;
}

/* ---- given normals ---- */

/* D over |det M|, of a normal of the unit problem. */
HERE float unit_ndf(int distribution, float x, float y, float z)
{
    /* only ggx */
    if (distribution == VNDF_GGX)
        return ggx_p22(x, y, z);
    /* end */
    /* only beckmann */
    if (distribution == VNDF_BECKMANN)
        return beckmann_p22(x, y, z);
    /* end */
    /* only table */
    if (distribution >= 0) {
        table t = table_at(distribution);
        return table_p22(t, table_given(t, x, y, z));
    }
    /* end */
    return 0.0f;
}

/* D(wm) per steradian; wm is unit, here and below. */
HERE float vndf_ndf(vndf_surface m, vec3 wm)
{
    frame at = frame_of(matrix_of(m), 0.0f, 0.0f, 1.0f);
    unit_normal n = frame_normal(at, wm.x, wm.y, wm.z);
    if (!(wm.z >= 0.0f))
        return 0.0f;
    return unit_ndf(m.distribution, n.x, n.y, n.z) / at.determinant;
}

/* The visible normals D(wm) (wi . wm)/A(wi), from which a table differs by what it states. */
HERE float vndf_visible(vndf_view view, vec3 wm)
{
    unit_normal n = frame_normal(view.at, wm.x, wm.y, wm.z);
    if (!(n.facing > 0.0f) || !(wm.z >= 0.0f))
        return 0.0f;
    float ndf = unit_ndf(view.surface.distribution, n.x, n.y, n.z) / view.at.determinant;
    return ndf * (n.facing * view.at.size / view.area);
}

/* The density with which vndf_sample draws wm. */
HERE float vndf_pdf(vndf_view view, vec3 wm)
{
    unit_normal n = frame_normal(view.at, wm.x, wm.y, wm.z);
    float density = 0.0f;
    if (!(n.facing > 0.0f) || !(wm.z >= 0.0f))
        return 0.0f;
    /* only ggx */
    if (view.surface.distribution == VNDF_GGX)
        density = ggx_density(ggx_see(view.at.ux, view.at.uy, view.at.uz), n.x, n.y, n.z, n.facing);
    /* end */
    /* only beckmann */
    if (view.surface.distribution == VNDF_BECKMANN)
        density = beckmann_density(beckmann_see(view.at.ux, view.at.uy, view.at.uz), n.x, n.y, n.z, n.facing);
    /* end */
    /* only table */
    if (view.surface.distribution >= 0)
        density = table_pdf(view.t, view.seen_from, n, frame_reach(view.at), view.below);
    /* end */
    return frame_density(view.at, density / view.at.determinant);
}

/* ---- sampling ---- */

/* A normal, and the density per steradian with which it is drawn. */
typedef struct vndf_sampled {
    vec3 wm;
    float pdf;
} vndf_sampled;

/* Draws a visible normal with two uniform numbers in [0, 1]. */
HERE vndf_sampled vndf_sample(vndf_view view, float u1, float u2)
{
    drawn n = {0.0f, 0.0f, 1.0f, 0.0f};
    /* only ggx */
    if (view.surface.distribution == VNDF_GGX)
        n = ggx_draw(ggx_see(view.at.ux, view.at.uy, view.at.uz), u1, u2);
    /* end */
    /* only beckmann */
    if (view.surface.distribution == VNDF_BECKMANN)
        n = beckmann_draw(beckmann_see(view.at.ux, view.at.uy, view.at.uz), u1, u2);
    /* end */
    /* only table */
    if (view.surface.distribution >= 0)
        n = table_draw(view.t, view.seen_from, u1, u2, view.below);
    /* end */
    sampled s = frame_sampled(view.at, n);
    const vndf_sampled drawn_normal = {vec3(s.x, s.y, s.z), s.pdf};
    return drawn_normal;
}

/* ---- masking ---- */

/* The projection of a direction on the mean plane: w.z where there is no mean slope. */
HERE float vndf_cosine(vndf_surface m, vec3 w)
{
    return w.z - (w.x * m.mean_x + w.y * m.mean_y);
}

/* Lambda(w) = A(w)/cos - 1, where cos is vndf_cosine; -1 - Lambda(-w) below the surface. */
HERE float vndf_lambda(vndf_surface m, vec3 w)
{
    float up = vndf_cosine(m, w), side = with_sign(1.0f, up);
    vndf_view view = vndf_view_of(m, vec3(side * w.x, side * w.y, side * w.z));
    float lambda = least(view.area / most(size(up), 1e-30f), 1e30f) - 1.0f;
    return pick(less(up, 0.0f), -1.0f - lambda, lambda);
}

HERE float vndf_g1(vndf_surface m, vec3 w)
{
    if (!(vndf_cosine(m, w) > 0.0f))
        return 0.0f;
    return 1.0f / (1.0f + most(vndf_lambda(m, w), 0.0f));
}

/* Masking and shadowing of two directions on the same side, height-correlated. */
HERE float vndf_g2(vndf_surface m, vec3 wi, vec3 wo)
{
    if (!(vndf_cosine(m, wi) > 0.0f) || !(vndf_cosine(m, wo) > 0.0f))
        return 0.0f;
    return 1.0f / (1.0f + most(vndf_lambda(m, wi), 0.0f) + most(vndf_lambda(m, wo), 0.0f));
}

/* ---- several lobes on one surface ---- */

/* Up to VNDF_LOBES surfaces with weights that need no sum. */
typedef struct vndf_mixture {
    int count;
    vndf_surface lobe[VNDF_LOBES];
    float weight[VNDF_LOBES];
} vndf_mixture;

/* Seen from wi: each lobe has a share of the visible area. */
typedef struct vndf_mixture_view {
    int count;
    vndf_view lobe[VNDF_LOBES];
    float share[VNDF_LOBES];
    float area;
} vndf_mixture_view;

/* Copies, here and below, since some languages index no parameter. */
HERE vndf_mixture_view vndf_mixture_view_of(vndf_mixture mixture, vec3 wi)
{
    vndf_mixture lobes = mixture;
    vndf_mixture_view view;
    float weight = 0.0f;
    view.count = lobes.count;
    view.area = 0.0f;
    for (int i = 0; i < lobes.count; i++) {
        view.lobe[i] = vndf_view_of(lobes.lobe[i], wi);
        view.share[i] = lobes.weight[i] * view.lobe[i].area;
        view.area = view.area + view.share[i];
        weight = weight + lobes.weight[i];
    }
    for (int j = 0; j < lobes.count; j++)
        view.share[j] = view.share[j] / view.area;
    view.area = view.area / weight;
    return view;
}

HERE float vndf_mixture_pdf(vndf_mixture_view view, vec3 wm)
{
    vndf_mixture_view lobes = view;
    float density = 0.0f;
    for (int i = 0; i < lobes.count; i++)
        density = density + lobes.share[i] * vndf_pdf(lobes.lobe[i], wm);
    return density;
}

HERE float vndf_mixture_visible(vndf_mixture_view view, vec3 wm)
{
    vndf_mixture_view lobes = view;
    float density = 0.0f;
    for (int i = 0; i < lobes.count; i++)
        density = density + lobes.share[i] * vndf_visible(lobes.lobe[i], wm);
    return density;
}

/* u1 says which lobe is drawn, and its part of 1 is stretched to [0, 1]; the density is that of the whole. */
HERE vndf_sampled vndf_mixture_sample(vndf_mixture_view view, float u1, float u2)
{
    vndf_mixture_view lobes = view;
    float before = 0.0f;
    int chosen = 0;
    for (int i = 0; i + 1 < lobes.count; i++)
        if (chosen == i && u1 >= before + lobes.share[i]) {
            before = before + lobes.share[i];
            chosen = i + 1;
        }
    float u = least(most((u1 - before) / most(lobes.share[chosen], 1e-30f), 0.0f), 1.0f);
    vndf_sampled one = vndf_sample(lobes.lobe[chosen], u, u2);
    one.pdf = lobes.share[chosen] * one.pdf;
    for (int j = 0; j < lobes.count; j++)
        if (j != chosen)
            one.pdf = one.pdf + lobes.share[j] * vndf_pdf(lobes.lobe[j], one.wm);
    return one;
}

HERE float vndf_mixture_ndf(vndf_mixture mixture, vec3 wm)
{
    vndf_mixture lobes = mixture;
    float weight = 0.0f, density = 0.0f;
    for (int i = 0; i < lobes.count; i++) {
        weight = weight + lobes.weight[i];
        density = density + lobes.weight[i] * vndf_ndf(lobes.lobe[i], wm);
    }
    return density / weight;
}
