/* Numbers, normal, numbers: vndf_invert gives numbers that vndf_sample turns into the same normal, within 1e-5 where
 * its slopes are over the roughness, or within what four steps of 2^-24 of the numbers do there, for drawn normals and
 * for any between two of them, so the map has no jump; for mixtures it names the lobe, among others of weight 0. The
 * map is monotone in each number but for rounding: of tables u1 turns the azimuth of the stretched normal and u2 moves
 * its slope, of GGX they do so with the mirrored direction, of Beckmann u1 moves the slope along wi and u2 that
 * across. It notices an inverse that is not that of the map, Kepler's equation solved too coarsely, a wrong half turn,
 * a cell's neighbour, a jump where two cells or formulas meet, and lobes that are counted without those of weight 0. */
#include "sampler/seen.h"

static float moved(float u, int steps)
{
    return (float)fmin(1, fmax(0, (double)u + steps * 0x1p-24));
}

/* How far four steps of the numbers move their normal, which is wm. */
static double led_by_steps(const seen *s, const bins_frame *f, float u1, float u2, vndf_vec3 wm)
{
    double most = 0;
    for (int i = 0; i < 9; i++)
        most = fmax(most,
                    bins_apart(f, seen_draw(s, moved(u1, 4 * (i % 3 - 1)), moved(u2, 4 * (i / 3 - 1)), NULL), wm));
    return most;
}

/* A normal that leans so far that its own rounding is seen over the roughness has as much room. */
static double rounding(const bins_frame *f)
{
    double least = fabs(f->det) / hypot(hypot(f->xx, f->xy), hypot(f->yx, f->yy));
    return 0x1p-22 * (1 + hypot(f->mean_x, f->mean_y)) * (f->mean_x != 0 || f->mean_y != 0 ? 1 / least : 1);
}

/* A unit normal between two, which faces what both face. */
static vndf_vec3 between(vndf_vec3 a, vndf_vec3 b, float t)
{
    vndf_vec3 w = {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)};
    const float per = (float)(1 / length_of(w));
    return (vndf_vec3){w.x * per, w.y * per, w.z * per};
}

/* Whether, without a lobe, it is that which draws the normal most often. */
static int finds_likeliest(const vndf_mixture_view *m, vndf_vec3 wm)
{
    float u1, u2, often[VNDF_MIXTURE_LOBES] = {0}, most = 0;
    for (int i = 0; i < m->count; i++)
        most = fmaxf(most, often[m->part[i].lobe] = m->part[i].share * vndf_pdf(&m->part[i].view, wm));
    int lobe = vndf_mixture_invert(m, wm, -1, &u1, &u2);
    return lobe >= 0 && often[lobe] == most;
}

/* The normal of two of these numbers or, with `t` above 0, one between that and the normal of the others, where D is
 * not so small that no number stands for it. */
static int comes_back(const seen *s, const float u[4], float t, double *lost)
{
    const float u1 = u[0], u2 = u[1];
    int drawn = 0, lobe = 0;
    float v1 = -1, v2 = -1;
    vndf_vec3 wm = seen_draw(s, u1, u2, NULL), other = between(wm, seen_draw(s, u[2], u[3], NULL), t);
    if (s->kind != SEEN_MIXTURE && seen_pdf(s, other) > 1e-3f * seen_pdf(s, wm))
        wm = other;
    if (s->kind == SEEN_MIXTURE) {
        vndf_mixture_sample(&s->mixture, u1, u2, NULL, &drawn);
        lobe = finds_likeliest(&s->mixture, wm) ? vndf_mixture_invert(&s->mixture, wm, drawn, &v1, &v2) : -1;
    } else
        vndf_invert(&s->view, wm, &v1, &v2);
    bins_frame f = bins_frame_of(&s->of.lobe[drawn].surface, s->wi);
    const vndf_vec3 back = seen_draw(s, v1, v2, NULL);
    *lost = bins_apart(&f, wm, back);
    if (lobe != drawn || !(v1 >= 0 && v1 <= 1 && v2 >= 0 && v2 <= 1))
        return 0;
    return *lost <= 1e-5 + rounding(&f) || *lost <= led_by_steps(s, &f, v1, v2, back);
}

/* Surfaces, matrices with a mean slope, and mixtures of both with a lobe of weight 0. */
static seen random_view(const vndf_distribution *d, size_t n, unsigned long long *state)
{
    const int plain = n % 3 == 0;
    const seen_kind kind = n % 3 == 2 ? SEEN_MIXTURE : SEEN_SURFACE;
    float a = (float)random_decade(state, plain ? -4 : -2, 0.3), b = (float)random_decade(state, -2, 0.3);
    float mean = plain ? 0 : (float)random_between(state, -0.5, 0.5), shear = plain ? 0 : a / 2;
    const vndf_mixture of = {kind == SEEN_MIXTURE ? 3 : 1,
                             {{{d, a, shear, -shear, b, mean, mean}, 0.6f},
                              {vndf_rough(d, a, a), 0},
                              {{vndf_ggx(), b, 0, 0, b, mean, 0}, 0.4f}}};
    vndf_vec3 wi = random_direction(state, -0.3);
    seen s = seen_from(kind, &of, wi);
    if (seen_at_all(&s, 1e-6f))
        return s;
    wi.z = -wi.z;
    return seen_from(kind, &of, wi);
}

static void test_inverse(const subject *of, size_t count, unsigned long long *state)
{
    size_t missed = 0;
    for (size_t n = 0; n < count; n++) {
        seen s = random_view(of->d, n, state);
        float u[4];
        for (int i = 0; i < 4; i++)
            u[i] = (float)random_between(state, 0x1p-20, 1 - 0x1p-20);
        double lost = 0;
        if (comes_back(&s, u, n % 2 ? test_uniform(state) : 0, &lost) || missed++ > 3)
            continue;
        seen_print(&s, of->name);
        fprintf(stderr, "    kind %d, u %.9g %.9g: off by %.3g\n", (int)s.kind, (double)u[0], (double)u[1], lost);
    }
    TEST(missed <= count / 10000);
}

static void test_subject(const subject *of, size_t index)
{
    unsigned long long state = 9 + index;
    test_inverse(of, test_amount(3000, 20000, 1000000), &state);
}

int main(int arguments, char **argument)
{
    return subjects_test(arguments, argument, test_subject);
}
