/* Numbers, normal, numbers: vndf_invert gives numbers that vndf_sample turns into the same normal, within 1e-5 where
 * its slopes are over the roughness, or within what four steps of 2^-24 of the numbers do there; for mixtures it names
 * the lobe, among others of weight 0. And the density that comes with a sample is that of vndf_pdf at the normal
 * returned: above the horizon within 1e-5 for 99.9% of the samples and 1e-4 for 99.99%, below it 1e-4 and 1e-3, where
 * roughness is at least 0.02 and no lobe of D is narrower than a tenth of its slope. It notices an inverse that is not
 * that of the map, Kepler's equation solved too coarsely, a wrong half turn, a cell's neighbour, lobes that are counted
 * without those of weight 0, and a density that is formed another way where a sample is drawn. */
#include "sampler/seen.h"

static float moved(float u, int steps)
{
    return (float)fmin(1, fmax(0, (double)u + steps * 0x1p-24));
}

static double led_by_steps(const seen *s, const slope_frame *f, float u1, float u2, vndf_vec3 wm)
{
    double most = 0;
    for (int i = 0; i < 9; i++)
        most = fmax(most,
                    seen_apart(f, seen_draw(s, moved(u1, 4 * (i % 3 - 1)), moved(u2, 4 * (i / 3 - 1)), NULL), wm));
    return most;
}

/* A normal that leans so far that its own rounding is seen over the roughness has as much room. */
static double rounding(const slope_frame *f)
{
    double least = f->det / hypot(hypot(f->xx, f->xy), hypot(f->yx, f->yy));
    return 0x1p-22 * (1 + hypot(f->mean_x, f->mean_y)) * (f->mean_x != 0 || f->mean_y != 0 ? 1 / least : 1);
}

static int comes_back(const seen *s, float u1, float u2, double *lost)
{
    int drawn = 0, lobe = 0;
    float v1 = -1, v2 = -1;
    vndf_vec3 wm = seen_draw(s, u1, u2, NULL);
    if (s->kind == SEEN_MIXTURE) {
        vndf_mixture_sample(&s->mixture, u1, u2, NULL, &drawn);
        lobe = vndf_mixture_invert(&s->mixture, wm, drawn, &v1, &v2);
    } else
        vndf_invert(&s->view, wm, &v1, &v2);
    slope_frame f = slope_frame_from(&s->of.lobe[drawn].surface, s->wi, 0);
    *lost = seen_apart(&f, wm, seen_draw(s, v1, v2, NULL));
    if (lobe != drawn || !(v1 >= 0 && v1 <= 1 && v2 >= 0 && v2 <= 1))
        return 0;
    return *lost <= 1e-5 + rounding(&f) || *lost <= led_by_steps(s, &f, u1, u2, wm);
}

/* Surfaces, matrices with a mean slope, and mixtures of both with a lobe of weight 0. */
static seen random_view(const vndf_distribution *d, seen_kind kind, unsigned long long *state)
{
    const int plain = kind == SEEN_SURFACE;
    float a = (float)random_decade(state, plain ? -4 : -2, 0.3), b = (float)random_decade(state, -2, 0.3);
    float mean = plain ? 0 : (float)random_between(state, -0.5, 0.5), shear = plain ? 0 : a / 2;
    const vndf_mixture of = {kind == SEEN_MIXTURE ? 3 : 1,
                             {{{d, a, shear, -shear, b, mean, mean}, 0.6f},
                              {{d, a, 0, 0, a, 0, 0}, 0},
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
        seen s = random_view(of->d, (seen_kind)(n % 3), state);
        float u1 = (float)random_between(state, 0x1p-20, 1 - 0x1p-20),
              u2 = (float)random_between(state, 0x1p-20, 1 - 0x1p-20);
        double lost = 0;
        if (comes_back(&s, u1, u2, &lost) || missed++ > 3)
            continue;
        seen_print(&s, of->name);
        fprintf(stderr, "    kind %d, u %.9g %.9g: off by %.3g\n", (int)s.kind, (double)u1, (double)u2, lost);
    }
    TEST(missed <= count / 10000);
}

/* Every fifth view is of a mixture; of views that see at least 1e-8 of what is seen at grazing incidence. */
static void test_density(const subject *of, int below, size_t count, unsigned long long *state)
{
    static const float alphas[] = {0.02f, 0.1f, 0.3f, 1};
    const double limit = (below ? 1e-4 : 1e-5) * (of->shape.breaks[0] > 0 ? 3 : 1); /* a jump is narrow */
    size_t measured = 0, apart[2] = {0, 0};
    for (size_t i = 0; i < count; i++) {
        float ax = alphas[i % 4], ay = i / 4 % 2 ? ax : alphas[i / 8 % 4], pdf;
        vndf_vec3 wi = random_direction(state, 0);
        wi.z = below ? -wi.z : wi.z;
        const vndf_mixture two = {2, {{seen_straight(of->d, ax, ay), 0.3f}, {seen_straight(of->d, 1, 1), 0.7f}}};
        seen s = i % 5 == 4 ? seen_from(SEEN_MIXTURE, &two, wi) : seen_surface(of->d, ax, ay, wi);
        if (!seen_at_all(&s, 1e-8f))
            continue;
        vndf_vec3 wm = seen_draw(&s, test_uniform(state), test_uniform(state), &pdf);
        double error = fabs((double)seen_pdf(&s, wm) / (double)pdf - 1);
        measured++;
        apart[0] += !(error <= limit), apart[1] += !(error <= 10 * limit);
    }
    if (!(TEST(apart[0] <= measured / 1000) & TEST(apart[1] <= measured / 10000)))
        fprintf(stderr, "  %s %s: of %lu densities %lu are apart by %g, %lu by %g\n", of->name,
                below ? "below" : "above", (unsigned long)measured, (unsigned long)apart[0], limit,
                (unsigned long)apart[1], 10 * limit);
}

static void test_subject(const subject *of, size_t index)
{
    unsigned long long state = 9 + index;
    test_inverse(of, test_amount(3000, 20000, 1000000), &state);
    for (int below = 0; below < 2; below++)
        test_density(of, below, test_amount(20000, 100000, 400000), &state);
}

int main(int arguments, char **argument)
{
    return subjects_test(arguments, argument, test_subject);
}
