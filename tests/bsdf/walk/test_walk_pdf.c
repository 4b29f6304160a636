/* vndf_bsdf_pdf of a walk is a density: its integral over the directions that it covers is 1 within 1e-4, it is
 * positive there, and it is near the law of the samples: a total variation over 96 bins below 0.42 everywhere (0.39
 * measured, for a hazy mirror of roughness 0.1 x 1), and below 0.05 where alpha is 0.1 (0.034). */
#include "bsdf/walk/walk_proposal.h"

/* integral of pdf = sum over the parts of a proposal of the mean of pdf/proposal, which is bounded: points of a
 * lattice whose steps are powers of the plastic number's inverse, nearly as even as any. */
static double integral_of(const walk_hit *h, walk_mean bins[WALK_BINS])
{
    int parts = walk_transmits(&h->is) ? 4 : 2, count = 100000;
    double sum = 0.0;
    for (int i = 0; i < parts * count; i++) {
        double u1 = fmod((i / parts + 0.5) * 0.75487766624669276, 1.0);
        double u2 = fmod((i / parts + 0.5) * 0.56984029099805327, 1.0);
        vndf_vec3 wo = i % 2 ? walk_propose_event(h, i % parts / 2, (float)u1, (float)u2)
                             : walk_propose_cosine(i % parts / 2, u1, u2);
        if (isnan(wo.z) || wo.z == 0.0f)
            continue;
        double density = (double)vndf_bsdf_pdf(&h->bsdf, wo), ratio = density / walk_proposal_density(h, wo);
        TEST(density > 0.0 && density < HUGE_VAL);
        sum += ratio / (parts * count);
        bins[walk_bin(wo)].sum += ratio / (parts * count);
    }
    return sum;
}

static double distance_of(const walk_hit *h, const walk_mean bins[WALK_BINS])
{
    enum { SAMPLES = 40000 };
    double counts[WALK_BINS] = {0}, distance = 0.0;
    unsigned long long state = 8;
    for (int i = 0; i < SAMPLES; i++) {
        float u[3];
        vndf_scattered w;
        walk_numbers(&state, u);
        vndf_bsdf_sample(&h->bsdf, u, &w);
        counts[walk_bin(w.wo)] += w.lobe == VNDF_LOBE_NONE ? 0.0 : 1.0 / SAMPLES;
    }
    for (int b = 0; b < WALK_BINS; b++)
        distance += 0.5 * fabs(counts[b] - bins[b].sum);
    return distance;
}

static void test_view(const walk_hit *h, const char *name, double furthest)
{
    walk_mean bins[WALK_BINS] = {{0, 0, 0, 0}};
    double mass = integral_of(h, bins), distance = distance_of(h, bins);
    if (!(TEST_NEAR(mass, 1.0, 1e-4) & TEST(distance < furthest))) {
        walk_describe(h, name);
        fprintf(stderr, "    distance %g\n", distance);
    }
}

typedef struct setting {
    float alpha_x, alpha_y; /* over the distribution's scale */
    double cosine, distance;
} setting;

static const setting SETTINGS[] = {{1, 1, 0.95, 0.42},   {0.3f, 0.3f, 0.6, 0.42},  {1, 1, 0.2, 0.42},
                                   {0.1f, 1, 0.5, 0.42}, {0.5f, 0.5f, 0.05, 0.42}, {0.1f, 0.1f, 0.9, 0.05}};
enum { SETTING_COUNT = 6, WALK_COUNT = 4 };

static void test_subject(int subject)
{
    vndf_description walks[WALK_COUNT] = {walk_of_mirror(), walk_of_glass(1.5f), walk_of_glass(1.0f / 1.5f),
                                          walk_of_glass(2.4f)};
    const vndf_distribution *d = walk_subject(subject);
    float scale = (float)vndf_distribution_info(d).scale;
    for (int i = 0; d && i < SETTING_COUNT * WALK_COUNT; i++) {
        const setting *s = &SETTINGS[i % SETTING_COUNT];
        walk_hit h;
        if (subject > 0 && i % 5 != subject % 5)
            continue;
        walk_hit_at(&h, &walks[i / SETTING_COUNT], d, s->alpha_x / scale, s->alpha_y / scale,
                    walk_direction(s->cosine, 0.9));
        test_view(&h, walk_subject_name(subject), s->distance);
    }
    walk_subject_free(d);
}

int main(int arguments, char **argument)
{
    for (int i = 0; i < WALK_FEW; i++)
        if (arguments < 2 || atoi(argument[1]) == i)
            test_subject(i);
    return test_done();
}
