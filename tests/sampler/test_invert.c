/* Numbers, normal, numbers: vndf_invert gives numbers that vndf_sample turns into the same normal, within 1e-5 where
 * its slopes are over the roughness, or within what four steps of 2^-24 of the numbers do there; for mixtures it names
 * the lobe, among others of weight 0. It notices an inverse that is not that of the map, Kepler's equation solved too
 * coarsely, a wrong half turn, a cell's neighbour, and lobes that are counted without those of weight 0. */
#include "sampler/seen.h"

static int invert(const seen *s, vndf_vec3 wm, int lobe, float *u1, float *u2)
{
    if (s->kind == SEEN_MIXTURE)
        return vndf_mixture_invert(&s->mixture, wm, lobe, u1, u2);
    vndf_invert(&s->view, wm, u1, u2);
    return 0;
}

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
    int drawn = 0;
    vndf_vec3 wm = s->kind == SEEN_MIXTURE ? vndf_mixture_sample(&s->mixture, u1, u2, NULL, &drawn)
                                           : seen_draw(s, u1, u2, NULL);
    slope_frame f = slope_frame_from(&s->of.lobe[drawn].surface, s->wi, 0);
    float v1 = -1, v2 = -1;
    int lobe = invert(s, wm, drawn, &v1, &v2);
    *lost = seen_apart(&f, wm, seen_draw(s, v1, v2, NULL));
    if (lobe != drawn || !(v1 >= 0 && v1 <= 1 && v2 >= 0 && v2 <= 1))
        return 0;
    return *lost <= 1e-5 + rounding(&f) || *lost <= led_by_steps(s, &f, u1, u2, wm);
}

static seen random_view(const vndf_distribution *d, seen_kind kind, unsigned long long *state)
{
    float a = (float)random_decade(state, kind == SEEN_SURFACE ? -4 : -2, 0.3),
          b = (float)random_decade(state, -2, 0.3);
    float mean = kind == SEEN_SURFACE ? 0 : (float)random_between(state, -0.5, 0.5),
          shear = kind == SEEN_SURFACE ? 0 : a / 2;
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

static void test_subject(const subject *of, size_t index)
{
    unsigned long long state = 9 + index;
    size_t count = test_amount(3000, 20000, 1000000), missed = 0;
    for (size_t n = 0; n < count; n++) {
        seen s = random_view(of->d, (seen_kind)(n % 3), &state);
        float u1 = (float)random_between(&state, 0x1p-20, 1 - 0x1p-20),
              u2 = (float)random_between(&state, 0x1p-20, 1 - 0x1p-20);
        double lost = 0;
        if (comes_back(&s, u1, u2, &lost) || missed++ > 3)
            continue;
        seen_print(&s, of->name);
        fprintf(stderr, "    kind %d, u %.9g %.9g: off by %.3g\n", (int)s.kind, (double)u1, (double)u2, lost);
    }
    TEST(missed <= count / 10000);
}

int main(int arguments, char **argument)
{
    return subjects_test(arguments, argument, test_subject);
}
