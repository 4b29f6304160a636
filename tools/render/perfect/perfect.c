/* Precomputed sampling of a BSDF, in the numbers that visible normals are drawn with.
 *
 * For a fixed wi the library turns (u1, u2) into a visible normal, and a lobe of the material into wo, with a
 * density p(wo) and a weight w = f |cos|/p: masking, times the reflectance of a conductor. As a function of u the
 * weight is smooth and bounded for any distribution and any roughness - the peak is in the map - and it hardly
 * changes from one wi to the next. So a coarse table over cells of (u1, u2), mixed between nodes of wi (table.h),
 * says where to draw u. With the density m(u) of u,
 *
 *     density(wo) = p(wo) m(u),    weight = w/m(u),
 *
 * exact for any table: a poor one costs variance, not bias. m follows w; the weight still varies within cells and
 * between nodes.
 *
 * With two lobes and the reflectance F(wi.wm) the library takes reflection with the probability F, and w_r and w_t
 * remain. m follows F w_r + (1 - F) w_t, and reflection is taken with the probability F r/(F r + (1 - F)(1 - r)),
 * r = w_r/(w_r + w_t). r comes from the table, but F is evaluated at the normal, since beside total reflection it
 * changes too fast for any table. Where a lobe leads to the wrong side of the surface its r, or 1 - r, is 0. The
 * density then has another factor,
 *
 *     density(wo) = p(wo) m(u) (r or 1 - r)/(F r + (1 - F)(1 - r)).
 *
 * m follows the luminance of w, without the factor 1/eta^2 of refraction: radiance gains that factor on entering
 * and loses it on leaving, so it says nothing about the worth of a path. A cell counts by the root of the mean
 * square, not by the mean: that leaves the least variance where w changes within the cell.
 *
 * For the density of a given wo, u is found again: the microfacet between wi and wo (Walter et al., "Microfacet
 * Models for Refraction through Rough Surfaces", EGSR 2007, equations 13 and 16), then its vndf_invert. wi is
 * turned and mirrored into the first quadrant of x and y, with x along wi if the roughness is isotropic: that does
 * not change the BSDF, and the table need not know how the map of the library turns with wi. The floats of wo
 * limit u: on a border between cells a rounding may give the density of the next cell, for some 1 in 1e4 at alpha
 * 0.05 and up, for a good part at alpha 0.001 and grazing incidence. Neighbouring cells differ by little, and this
 * density only serves the weights beside lights; the weight of the sample itself does not change.
 *
 * make.c makes the sampler. */
#include "render/perfect/perfect.h"

/* ---- a hit ---- */

/* The frame in which wi has x, y >= 0, or y = 0: rotation to the axes or to wi itself, then mirrors. */
static void turn_frame(perfect_hit *h, const vndf_roughness *turned, vndf_vec3 wi)
{
    float c = turned->cos_rotation, s = turned->sin_rotation;
    if (h->is->table.turns == 1) {
        float across = sqrtf(wi.x * wi.x + wi.y * wi.y);
        c = across > 0.0f ? wi.x / across : 1.0f;
        s = across > 0.0f ? wi.y / across : 0.0f;
    }
    float mirror_x = c * wi.x + s * wi.y < 0.0f ? -1.0f : 1.0f;
    float mirror_y = c * wi.y - s * wi.x < 0.0f ? -1.0f : 1.0f;
    h->xx = mirror_x * c;
    h->xy = mirror_x * s;
    h->yx = -mirror_y * s;
    h->yy = mirror_y * c;
}

static vndf_vec3 into_frame(const perfect_hit *h, vndf_vec3 w)
{
    return vec(h->xx * w.x + h->xy * w.y, h->yx * w.x + h->yy * w.y, w.z);
}

static vndf_vec3 out_of_frame(const perfect_hit *h, vndf_vec3 w)
{
    return vec(h->xx * w.x + h->yx * w.y, h->xy * w.x + h->yy * w.y, w.z);
}

int path_perfect_begin(perfect_hit *h, const path_perfect *p, const vndf_roughness *turned, vndf_vec3 wi)
{
    const vndf_surface surface = {p->is.distribution, p->is.alpha_x, p->is.alpha_y};
    h->is = p;
    turn_frame(h, turned, wi);
    h->wi = into_frame(h, wi);
    if (!vndf_bsdf_at(&h->bsdf, &p->material, h->wi))
        return 0;
    h->eta = wi.z > 0.0f ? p->is.eta : 1.0f / p->is.eta;
    h->view = vndf_view_from(&surface, vec(h->wi.x, h->wi.y, fabsf(h->wi.z)));
    perfect_table_place(&p->table, h->wi, &h->place);
    return 1;
}

/* ---- lobes ---- */

/* For one normal: how much more often than in the library reflection is taken, the same for refraction, and the
 * resulting probability of reflection. */
typedef struct lobe_choice {
    float more[2], reflects;
} lobe_choice;

/* There is a choice where both lobes lead to their side of the surface. */
static lobe_choice choose_lobe(const perfect_hit *h, vndf_vec3 wm, float share)
{
    vndf_vec3 wi = h->view.wi;
    float cosine = dot(wi, wm), f = vndf_fresnel_dielectric(cosine, h->eta);
    float square = 1.0f - (1.0f - cosine * cosine) / (h->eta * h->eta);
    int refracts = square > 0.0f && (cosine / h->eta - sqrtf(square)) * wm.z < wi.z / h->eta;
    float r = 2.0f * cosine * wm.z > wi.z ? share : 0.0f, t = refracts ? 1.0f - share : 0.0f;
    float total = f * r + (1.0f - f) * t;
    lobe_choice c = {{0.0f, 0.0f}, 0.0f};
    if (total > 0.0f)
        c = (lobe_choice){{r / total, t / total}, f * r / total};
    return c;
}

/* ---- drawing ---- */

static void scale_sample(vndf_scattered *s, float more)
{
    s->density *= more;
    for (int i = 0; i < 3; i++)
        s->weight[i] /= more;
    if (!(more > 0.0f)) /* beside total reflection rounding took a lobe that is not there */
        *s = (vndf_scattered){.wo = s->wo, .lobe = VNDF_LOBE_NONE};
}

void path_perfect_sample(const perfect_hit *h, const float u[3], vndf_scattered *s)
{
    float drawn[3] = {u[0], u[1], u[2]};
    perfect_cell cell = perfect_table_draw(&h->is->table, &h->place, drawn);
    lobe_choice c = {{1.0f, 1.0f}, 1.0f};
    if (h->is->table.lobes > 1) {
        c = choose_lobe(h, vndf_sample(&h->view, drawn[0], drawn[1], NULL), cell.share);
        drawn[2] = drawn[2] < c.reflects ? 0.0f : 1.0f;
    }
    vndf_bsdf_sample(&h->bsdf, drawn, s);
    scale_sample(s, cell.density * c.more[s->lobe != VNDF_LOBE_REFLECTION]);
    s->wo = out_of_frame(h, s->wo);
}

/* ---- a given direction ---- */

void path_perfect_eval(const perfect_hit *h, vndf_vec3 wo, float value[3])
{
    vndf_bsdf_eval(&h->bsdf, into_frame(h, wo), 0, value);
}

/* The microfacet normal that leads from wi to wo, on the same side or not: along wi + r wo, r the index on the
 * side of wo over that on the side of wi. In double: near r = 1, and for small roughness, the sum cancels. */
static vndf_vec3 normal_between(const perfect_hit *h, vndf_vec3 wo)
{
    int reflects = wo.z * h->wi.z > 0.0f;
    vndf_vec3 wi = h->view.wi;
    double r = reflects ? 1.0 : (double)h->eta, height = fabs((double)wo.z);
    double x = (double)wi.x + r * (double)wo.x, y = (double)wi.y + r * (double)wo.y;
    double z = (double)wi.z + (reflects ? r : -r) * height, to = copysign(1.0 / sqrt(x * x + y * y + z * z), z);
    return vec((float)(x * to), (float)(y * to), (float)(z * to));
}

float path_perfect_pdf(const perfect_hit *h, vndf_vec3 wo)
{
    vndf_vec3 w = into_frame(h, wo);
    float density = vndf_bsdf_pdf(&h->bsdf, w), u1, u2;
    if (!(density > 0.0f))
        return 0.0f;
    vndf_vec3 wm = normal_between(h, w);
    vndf_invert(&h->view, wm, &u1, &u2);
    perfect_cell cell = perfect_table_at(&h->is->table, &h->place, u1, u2);
    lobe_choice c = {{1.0f, 1.0f}, 1.0f};
    if (h->is->table.lobes > 1)
        c = choose_lobe(h, wm, cell.share);
    return density * cell.density * c.more[w.z * h->wi.z < 0.0f];
}
