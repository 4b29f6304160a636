/* What kernel/mixture.h asks for where it is exported, and families. Loops have a constant end, so that a GPU unrolls
 * them: what is indexed by a variable lies in local memory. Some languages index no parameter: it is copied. */

/* Up to VNDF_LOBES surfaces with weights that need no sum. */
typedef struct vndf_mixture_lobe {
    vndf_surface surface;
    float weight;
} vndf_mixture_lobe;

typedef struct vndf_mixture {
    int count;
    vndf_mixture_lobe lobe[VNDF_LOBES];
} vndf_mixture;

/* Seen from wi: each lobe has a share of the area that is drawn. */
typedef struct vndf_mixture_view {
    int count;
    vndf_view lobe[VNDF_LOBES];
    lobe_numbers weight, share; /* of sum 1 */
} vndf_mixture_view;

KERNEL lobe_numbers weights_of(vndf_mixture given)
{
    vndf_mixture m = given;
    lobe_numbers w;
    for (int i = 0; i < VNDF_LOBES; i++)
        w.lobe[i] = m.lobe[i].weight;
    return lobe_weights(w, m.count);
}

KERNEL vndf_mixture_view vndf_mixture_view_from(vndf_mixture given, vec3 wi)
{
    vndf_mixture m = given;
    vndf_mixture_view view;
    lobe_numbers drawn;
    view.count = m.count;
    for (int i = 0; i < VNDF_LOBES; i++)
        if (i < m.count) {
            view.lobe[i] = vndf_view_from(m.lobe[i].surface, wi);
            drawn.lobe[i] = drawn_area(view.lobe[i]);
        }
    view.weight = weights_of(m);
    view.share = lobe_shares(view.weight, drawn, m.count);
    return view;
}

KERNEL lobe_numbers its_areas(vndf_mixture_view given)
{
    vndf_mixture_view m = given;
    lobe_numbers areas;
    for (int i = 0; i < VNDF_LOBES; i++)
        if (i < m.count)
            areas.lobe[i] = area(m.lobe[i]);
    return areas;
}

KERNEL float vndf_mixture_ndf(vndf_mixture given, vec3 wm)
{
    vndf_mixture m = given;
    lobe_numbers w = weights_of(m);
    float density = 0.0f;
    for (int i = 0; i < VNDF_LOBES; i++)
        if (i < m.count)
            density = density + w.lobe[i] * ndf(m.lobe[i].surface, wm);
    return min(density, 3.4028234e38f);
}

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
        mixture.lobe[k].surface = shape;
        mixture.lobe[k].weight = 0.0f;
    }
    mixture.lobe[0].surface.distribution = to_int(fetch(at + 1));
    mixture.lobe[0].weight = 1.0f;
    if (knots > 1) {
        const float next = fetch(at + 2);
        float share = (p - fetch(at)) / (next - fetch(at));
        if (fetch(family + 1) > 0.0f)
            share = share * (next / p);
        mixture.lobe[1].surface.distribution = to_int(fetch(at + 3));
        mixture.lobe[1].weight = share;
        mixture.lobe[0].weight = 1.0f - share;
    }
    return mixture;
}
