/* Makes the sampler of a BSDF: refusals, and the worth of the cells of each node (perfect.c has the mathematics).
 * In a cell it looks at samples of the library on an even grid of points, each lobe by itself: 2 x 2 points if the
 * roughness is isotropic, and one point if it is not, since there are many more nodes. */
#include "render/perfect/perfect.h"

#include <stdlib.h>

enum { CELLS = PERFECT_CELLS };

static const float least_share = 1e-3f; /* of a lobe, so that no lobe is left out */

/* ---- what can be precomputed ---- */

const char *path_perfect_refuses(const vndf_description *is)
{
    const vndf_effects *e = &is->effects;
    if (e->scattering == VNDF_SCATTERING_MULTIPLE)
        return "perfect sampling is precomputed for single scattering, this one has 'scattering multiple'";
    if (e->scattering != VNDF_SCATTERING_SINGLE)
        return "perfect sampling is precomputed for single scattering alone, this one is compensated by 'scattering "
               "turquin' or 'kulla-conty'";
    if (e->lobes == VNDF_LOBES_BOTH && e->fresnel != VNDF_FRESNEL_DIELECTRIC)
        return "perfect sampling of both lobes is precomputed for dielectrics alone";
    if (e->lobes != VNDF_LOBES_REFLECTION && is->eta == 1.0f)
        return "perfect sampling is precomputed for light that is bent, this one has 'index 1'";
    if (e->masking == VNDF_MASKING_NONE)
        return "perfect sampling is precomputed for weights that have a bound, this one has 'masking none'";
    if (e->shape > VNDF_SHAPE_ROTATED)
        return "perfect sampling is precomputed for alpha, this one has a matrix, slopes or lobes";
    if (e->reflection == VNDF_REFLECTION_RETRO)
        return "perfect sampling is precomputed for mirrored light, this one is 'retroreflective'";
    return NULL;
}

static int same_three(const float a[3], const float b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

int path_perfect_is_of(const path_perfect *p, const vndf_description *is)
{
    const vndf_description *a = &p->is;
    const vndf_effects *e = &a->effects, *f = &is->effects;
    return a->distribution == is->distribution && a->alpha_x == is->alpha_x && a->alpha_y == is->alpha_y &&
           e->lobes == f->lobes && e->fresnel == f->fresnel && e->masking == f->masking &&
           e->transport == f->transport && a->eta == is->eta && same_three(a->f0, is->f0) &&
           same_three(a->conductor_eta, is->conductor_eta) && same_three(a->conductor_k, is->conductor_k);
}

/* ---- making ---- */

/* The factor of refraction for radiance. */
static float carried(const perfect_hit *h, vndf_lobe lobe)
{
    int changes = lobe == VNDF_LOBE_TRANSMISSION && h->is->is.effects.transport == VNDF_TRANSPORT_RADIANCE;
    return changes ? 1.0f / (h->eta * h->eta) : 1.0f;
}

/* Sums over the points of a cell: of squares, and the number of points with the lobe. */
typedef struct cell_worth {
    float both, of[2];
    int count[2];
} cell_worth;

/* The worth of a lobe; 0 if it is lost. */
static float worth_of(const perfect_hit *h, float u1, float u2, int refracts)
{
    const float u[3] = {u1, u2, (float)refracts};
    vndf_scattered s;
    vndf_bsdf_sample(&h->bsdf, u, &s);
    if (s.lobe == VNDF_LOBE_NONE || (s.lobe == VNDF_LOBE_REFLECTION && refracts))
        return 0.0f;
    return (float)luminance(s.weight) / carried(h, s.lobe);
}

static void weigh_point(const perfect_hit *h, float u1, float u2, cell_worth *sum)
{
    float both = 0.0f, f = 1.0f;
    if (h->is->table.lobes > 1)
        f = vndf_fresnel_dielectric(dot(h->view.wi, vndf_sample(&h->view, u1, u2, NULL)), h->eta);
    for (int lobe = 0; lobe < h->is->table.lobes; lobe++) {
        float w = worth_of(h, u1, u2, lobe);
        both += (lobe ? 1.0f - f : f) * w;
        sum->of[lobe] += w * w;
        sum->count[lobe] += w > 0.0f;
    }
    sum->both += both * both;
}

/* The share of reflection, from the points that have each lobe. A lobe that no point has counts as the other. */
static float share_of(const cell_worth *sum)
{
    float worth[2];
    for (int lobe = 0; lobe < 2; lobe++)
        worth[lobe] = sum->count[lobe] ? sqrtf(sum->of[lobe] / (float)sum->count[lobe]) : 0.0f;
    if (!sum->count[0] || !sum->count[1])
        return 0.5f;
    return fminf(fmaxf(worth[0] / (worth[0] + worth[1]), least_share), 1.0f - least_share);
}

/* `points` along each side of the cell. */
static void weigh_cell(const perfect_hit *h, int row, int column, int points, cell_worth *sum)
{
    float from1 = perfect_table_knot(row), step1 = (perfect_table_knot(row + 1) - from1) / (float)points;
    float from2 = perfect_table_knot(column), step2 = (perfect_table_knot(column + 1) - from2) / (float)points;
    for (int i = 0; i < points; i++)
        for (int k = 0; k < points; k++)
            weigh_point(h, from1 + step1 * ((float)i + 0.5f), from2 + step2 * ((float)k + 0.5f), sum);
}

static void fill_node(path_perfect *p, size_t node)
{
    static const vndf_roughness unturned = {1.0f, 1.0f, 1.0f, 0.0f};
    float worth[CELLS * CELLS], share[CELLS * CELLS];
    perfect_hit h;
    int seen = path_perfect_begin(&h, p, &unturned, perfect_table_direction(&p->table, node));
    int points = p->table.turns > 1 ? 1 : 2;
    for (int i = 0; i < CELLS * CELLS; i++) {
        cell_worth sum = {0.0f, {0.0f, 0.0f}, {0, 0}};
        if (seen)
            weigh_cell(&h, i / CELLS, i % CELLS, points, &sum);
        worth[i] = sqrtf(sum.both / (float)(points * points));
        share[i] = share_of(&sum);
    }
    perfect_table_fill(&p->table, node, worth, share);
}

static void describe_table(path_perfect *p)
{
    const vndf_effects *e = &p->is.effects;
    double scale = vndf_distribution_info(p->is.distribution).scale;
    float unit_scale = scale > 0 ? (float)scale : 1.0f;
    vndf_bsdf below;
    p->table.alpha_x = unit_scale * p->is.alpha_x;
    p->table.alpha_y = unit_scale * p->is.alpha_y;
    p->table.lobes = e->lobes == VNDF_LOBES_BOTH ? 2 : 1;
    p->table.sides = vndf_bsdf_at(&below, &p->material, vec(0.0f, 0.0f, -1.0f)) ? 2 : 1;
    if (e->lobes == VNDF_LOBES_REFLECTION && e->fresnel != VNDF_FRESNEL_DIELECTRIC)
        return;
    p->table.critical[0] = p->is.eta < 1.0f ? p->is.eta : 0.0f;
    p->table.critical[1] = p->is.eta > 1.0f ? 1.0f / p->is.eta : 0.0f;
}

static int make_table(path_perfect *p)
{
    describe_table(p);
    if (!perfect_table_make(&p->table))
        return 0;
    for (size_t i = 0; i < perfect_table_nodes(&p->table); i++)
        fill_node(p, i);
    return 1;
}

path_perfect *path_perfect_make(const vndf_description *is, vndf_error *error)
{
    path_perfect *p = calloc(1, sizeof *p);
    if (p) {
        p->is = *is;
        p->is.effects.normals = VNDF_NORMALS_VISIBLE;
        p->is.effects.shape = VNDF_SHAPE_ALIGNED;
    }
    if (p && vndf_material_resolve(&p->is, &p->material, error) != VNDF_OK) {
        free(p);
        return NULL;
    }
    if (p && make_table(p))
        return p;
    *error = (vndf_error){VNDF_ERROR_MEMORY, "no memory for perfect sampling"};
    free(p);
    return NULL;
}

void path_perfect_free(path_perfect *p)
{
    if (p)
        perfect_table_free(&p->table);
    free(p);
}

size_t path_perfect_bytes(const path_perfect *p)
{
    return sizeof *p + perfect_table_bytes(&p->table);
}
