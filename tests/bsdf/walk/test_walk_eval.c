/* The mean of eval is what sample scatters: over 96 bins of the sphere, all orders, the integral of eval against
 * the mean weight of the samples that fall in; and f does not change when wi and wo change places, across the
 * boundary with the square of the index ratio (Walter et al. 2007, section 5): means at 5 sigmas, 6e-7 each, of
 * some 3000.
 *
 * Bins are compared where there are errors to speak of: 100 samples and evaluations, none of them a tenth of
 * all. */
#include "bsdf/walk/walk_proposal.h"

/* ---- the two histograms ---- */

static void sample_bins(const walk_hit *h, size_t count, walk_mean bins[], size_t hits[])
{
    unsigned long long state = 31;
    for (size_t i = 0; i < count; i++) {
        float u[3];
        vndf_scattered w;
        walk_numbers(&state, u);
        vndf_bsdf_sample(&h->bsdf, u, &w);
        walk_add(&bins[walk_bin(w.wo)], (double)w.weight[0]);
        hits[walk_bin(w.wo)] += w.lobe != VNDF_LOBE_NONE;
    }
}

/* NaN in z where there is none: total reflection. */
static vndf_vec3 propose(const walk_hit *h, unsigned long long *state)
{
    float u[3];
    walk_numbers(state, u);
    int below = walk_transmits(&h->is) && test_uniform(state) < 0.5f;
    return u[2] < 0.5f ? walk_propose_cosine(below, u[0], u[1]) : walk_propose_event(h, below, u[0], u[1]);
}

static void eval_bins(const walk_hit *h, size_t count, walk_mean bins[], size_t hits[])
{
    unsigned long long state = 32;
    for (size_t i = 0; i < count; i++) {
        vndf_vec3 wo = propose(h, &state);
        if (!(wo.z != 0.0f) || isnan(wo.z))
            continue;
        double value = walk_eval(h, wo, i);
        TEST(value >= 0.0 && value < HUGE_VAL);
        walk_add(&bins[walk_bin(wo)], value / walk_proposal_density(h, wo));
        hits[walk_bin(wo)]++;
    }
}

static int is_known(const walk_mean *m, size_t hits)
{
    return hits >= 100 && m->largest < 0.1 * m->sum;
}

static void test_bins(const walk_hit *h, const char *name, double least)
{
    size_t count = walk_count(100000), drawn[WALK_BINS] = {0}, seen[WALK_BINS] = {0};
    walk_mean sampled[WALK_BINS], evaluated[WALK_BINS];
    double all = 0.0, compared = 0.0, part = test_long() ? least : 0.6 * least;
    for (int b = 0; b < WALK_BINS; b++) {
        walk_mean none = {0, 0, (double)count, 0};
        sampled[b] = evaluated[b] = none;
    }
    sample_bins(h, count, sampled, drawn);
    eval_bins(h, count, evaluated, seen);
    for (int b = 0; b < WALK_BINS; b++) {
        all += sampled[b].sum;
        if (!is_known(&sampled[b], drawn[b]) || !is_known(&evaluated[b], seen[b]))
            continue;
        compared += sampled[b].sum;
        if (!TEST(walk_agree(&sampled[b], &evaluated[b], 5.0, 0.0))) {
            walk_describe(h, name);
            fprintf(stderr, "    bin %d: sample %g, eval %g +- %g\n", b, walk_value(&sampled[b]),
                    walk_value(&evaluated[b]), sqrt(walk_variance(&evaluated[b])));
        }
    }
    if (!TEST(compared > part * all))
        walk_describe(h, name);
}

typedef struct setting {
    float alpha_x, alpha_y; /* over the distribution's scale */
    double cosine, least;   /* and of the energy this part has to be compared */
} setting;

static const setting SETTINGS[] = {{1, 1, 0.95, 0.9},   {0.3f, 0.3f, 0.6, 0.9},  {1, 1, 0.3, 0.9},
                                   {0.1f, 1, 0.5, 0.8}, {0.5f, 0.5f, 1e-3, 0.8}, {0.05f, 0.05f, 0.8, 0.5}};
enum { SETTING_COUNT = 6, WALK_COUNT = 3 };

static void test_subject(int subject)
{
    vndf_description walks[WALK_COUNT] = {walk_of_metal(), walk_of_glass(1.5f), walk_of_glass(1.0f / 1.5f)};
    const vndf_distribution *d = walk_subject(subject);
    float scale = (float)vndf_distribution_info(d).scale;
    for (int i = 0; d && i < SETTING_COUNT * WALK_COUNT; i++) {
        const setting *s = &SETTINGS[i % SETTING_COUNT];
        walk_hit h;
        if (subject > 0 && i % 5 != subject % 5)
            continue;
        walk_hit_at(&h, &walks[i / SETTING_COUNT], d, s->alpha_x / scale, s->alpha_y / scale,
                    walk_direction(s->cosine, 0.9));
        test_bins(&h, walk_subject_name(subject), s->least);
    }
    walk_subject_free(d);
}

/* ---- reciprocity ---- */

/* f of one pair, from either side. */
static walk_mean mean_of_f(const vndf_description *is, vndf_surface surface, vndf_vec3 wi, vndf_vec3 wo)
{
    walk_mean mean = {0, 0, (double)walk_count(30000), 0};
    walk_hit h;
    walk_hit_at(&h, is, surface.distribution, surface.alpha_x, surface.alpha_y, wi);
    for (double i = 0; i < mean.count; i += 1.0)
        walk_add(&mean, walk_eval(&h, wo, (uint64_t)i) / fabs((double)wo.z));
    return mean;
}

static void test_pair(const vndf_distribution *d, float ax, float ay, vndf_vec3 wi, vndf_vec3 wo)
{
    vndf_surface surface = {d, ax, ay};
    vndf_description glass = walk_of_glass(1.5f), back = glass, metal = walk_of_metal();
    vndf_vec3 below = {wo.x, wo.y, -wo.z};
    walk_mean f = mean_of_f(&metal, surface, wi, wo), g = mean_of_f(&metal, surface, wo, wi);
    TEST(walk_value(&f) > 0.0 && walk_agree(&f, &g, 5.0, 0.0));
    f = mean_of_f(&glass, surface, wi, wo), g = mean_of_f(&glass, surface, wo, wi);
    TEST(walk_value(&f) > 0.0 && walk_agree(&f, &g, 5.0, 0.0));
    glass.effects.transport = VNDF_TRANSPORT_RADIANCE; /* against importance the other way */
    f = mean_of_f(&glass, surface, wi, below), g = mean_of_f(&back, surface, below, wi);
    TEST(walk_value(&f) > 0.0 && walk_agree(&f, &g, 5.0, 0.0));
}

static void test_reciprocity(int subject)
{
    const vndf_distribution *d = walk_subject(subject);
    float scale = (float)vndf_distribution_info(d).scale;
    for (int i = 0; d && i < 6; i++) {
        double from = i % 2 ? 0.9 : 0.2, to = i % 3 ? 0.35 : 0.8;
        test_pair(d, 1.0f / scale, (i < 3 ? 1.0f : 0.4f) / scale, walk_direction(from, 0.3),
                  walk_direction(to, 2.0 + i));
    }
    walk_subject_free(d);
}

int main(int arguments, char **argument)
{
    for (int i = 0; i < WALK_FEW; i++)
        if (arguments < 2 || atoi(argument[1]) == i) {
            test_subject(i);
            test_reciprocity(i);
        }
    return test_done();
}
