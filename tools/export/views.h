/* What kernel/view.h asks for where it is exported: surfaces and views without unions or pointers. */

/* ---- surfaces ---- */

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

/* A direction on a surface, whose matrix is in units of the distribution's slopes. */
typedef struct placed {
    int kind;
    table t;
    frame f;
} placed;

KERNEL placed place(vndf_surface m, vec3 w)
{
    placed p;
    float scale = 1.0f;
    if (m.distribution >= 0) {
        scale = fetch(m.distribution + 3);
        p.t = table_at(m.distribution);
    }
    const affine_map s = {m.xx * scale, m.xy * scale, m.yx * scale, m.yy * scale, m.mean_x, m.mean_y, 0, 0.0f};
    p.kind = m.distribution;
    p.f = frame_of(affine_measured(s), w.x, w.y, w.z);
    return p;
}

/* ---- views ---- */

/* A surface seen from wi; what follows that is the kernel's. ex, ey and v are a table_view: WebGL allows structs in
 * structs no deeper. What closed forms make of a direction costs less than to keep it. */
typedef struct vndf_view {
    vec3 wi;
    int kind, below;
    frame f;
    table t;
    float ex, ey;
    radial_law v;
} vndf_view;

KERNEL int frame_below(frame f)
{
    return select_int(lt(f.uz, 0.0f), 1, 0);
}

/* wi is unit, and may be below the surface. */
KERNEL vndf_view vndf_view_from(vndf_surface m, vec3 wi)
{
    const placed p = place(m, wi);
    vndf_view view;
    view.wi = wi;
    view.kind = p.kind;
    view.f = p.f;
    view.below = frame_below(p.f);
    if (p.kind >= 0) {
        const table_view law = table_view_of(p.t, p.f, view.below);
        view.t = p.t;
        view.ex = law.ex;
        view.ey = law.ey;
        view.v = law.v;
    }
    return view;
}

KERNEL vec3 view_wi(vndf_view view)
{
    return view.wi;
}

KERNEL table_view view_law(vndf_view view)
{
    const table_view law = {view.ex, view.ey, view.v};
    return law;
}

KERNEL ggx_view view_ggx(vndf_view view)
{
    return ggx_see(view.f.ux, view.f.uy, view.f.uz);
}

KERNEL beckmann_view view_beckmann(vndf_view view)
{
    return beckmann_see(view.f.ux, view.f.uy, view.f.uz);
}

/* One number a lobe. */
typedef struct lobe_numbers {
    float lobe[VNDF_LOBES];
} lobe_numbers;
