/* Random walks, of closed forms and tables, mirrors, metal and glass. For each hit
 *
 *   samples   are unit and on the side that the lobe says; without absorption each that leaves has weight 1 (closed
 *             forms: to the bit; tables, whose weight holds the ratio of true to drawn density: in the mean, 4.5
 *             sigma), and the order limit of 64 loses less than 1e-3 of them; cut after one event they are the same
 *             or lost; radiance is over the square of the index ratio across the boundary
 *   eval      over 96 bins of the sphere its integral, all orders, is the mean weight of the samples that fall in: 5
 *             sigmas, 6e-7 each, of some 3000, where both are known: 100 samples, none of them a tenth of all;
 *             and so is the sum over these
 *   one event cut after it, eval is single scattering with height-correlated masking, to 3e-5; radiance is over that
 *             square */
#include "bsdf/bsdf_case.h"

enum { HEIGHTS = 12, TURNS = 8, BINS = HEIGHTS * TURNS }; /* of the sphere, of equal areas */

/* ---- materials: of one wavelength ---- */

enum { MIRROR, METAL, GLASS, DENSE, DIAMOND, WALKS };

static vndf_description walk_of(int kind)
{
    static const float etas[WALKS] = {1.5f, 1.5f, 1.5f, 1 / 1.5f, 2.4f};
    vndf_description is = {
        .effects = {.scattering = VNDF_SCATTERING_MULTIPLE}, .wavelengths = 1, .eta = etas[kind]};
    if (kind == METAL) {
        is.effects.fresnel = VNDF_FRESNEL_SCHLICK;
        is.f0[0] = 0.6f;
    } else if (kind >= GLASS) {
        is.effects.lobes = VNDF_LOBES_BOTH;
        is.effects.fresnel = VNDF_FRESNEL_DIELECTRIC;
        is.effects.transport = VNDF_TRANSPORT_IMPORTANCE;
    }
    return is;
}

typedef struct setting {
    float alpha[2];       /* over the distribution's scale */
    double cosine, least; /* of the energy this part has to be compared with eval; 0: no comparison */
} setting;

static const setting SETTINGS[] = {
    {{1, 1}, 0.95, 0.9},       {{0.3f, 0.3f}, 0.6, 0.9},    {{1, 1}, 0.3, 0.9},      {{0.1f, 1}, 0.5, 0.8},
    {{0.5f, 0.5f}, 1e-3, 0.8}, {{0.05f, 0.05f}, 0.8, 0.5},  {{0.1f, 0.1f}, 0.9, 0},  {{1e-3f, 1e-3f}, 0.5, 0},
    {{1, 1}, 1e-6, 0},         {{0.05f, 0.05f}, 0.1736, 0}, {{0.3f, 0.3f}, 1e-3, 0},
};
enum { SETTING_COUNT = sizeof SETTINGS / sizeof *SETTINGS };

/* A hit, which must not move, and the same by single scattering, by a walk of one event, and for radiance. */
typedef struct hit {
    vndf_description is;
    vndf_material material[4];
    vndf_bsdf walk, single, once, radiant;
    int passes; /* light may go to the other side */
} hit;

static void hit_at(hit *h, const vndf_description *is, const oracle_ndf *ndf, const float alpha[2], vndf_vec3 wi)
{
    float per = 1 / (float)vndf_distribution_info(ndf->distribution).scale;
    vndf_bsdf *to[4] = {&h->walk, &h->single, &h->once, &h->radiant};
    h->is = *is;
    h->is.surface = vndf_rough(ndf->distribution, alpha[0] * per, alpha[1] * per);
    h->passes = is->effects.lobes != VNDF_LOBES_REFLECTION;
    for (int i = 0; i < 4; i++) {
        vndf_description of = h->is;
        of.effects.scattering = i == 1 ? VNDF_SCATTERING_SINGLE : VNDF_SCATTERING_MULTIPLE;
        of.effects.transport = i == 3 ? VNDF_TRANSPORT_RADIANCE : is->effects.transport;
        of.order_limit = i == 2 ? 1 : 0;
        TEST(vndf_material_resolve(&of, &h->material[i], NULL) == VNDF_OK &&
             vndf_bsdf_at(to[i], &h->material[i], wi));
    }
}

/* f |cos_o|. */
static double eval(const vndf_bsdf *bsdf, vndf_vec3 wo, uint64_t seed)
{
    float f;
    vndf_bsdf_eval(bsdf, wo, seed, &f);
    return (double)f * fabs((double)wo.z);
}

/* ---- means and their errors ---- */

typedef struct mean {
    double sum, squares, count, largest, hits;
} mean;

static void add(mean *m, double x)
{
    m->sum += x;
    m->squares += x * x;
    m->largest = fmax(m->largest, x);
    m->hits++;
}

/* The square of its error. */
static double variance_of(const mean *m)
{
    double value = m->sum / m->count;
    return fmax(m->squares / m->count - value * value, 0) / m->count;
}

static int is_known(const mean *m)
{
    return m->hits >= 100 && m->largest < 0.1 * m->sum;
}

static size_t bin_of(vndf_vec3 w)
{
    const double row = 0.5 * ((double)w.z + 1), column = 0.5 * (atan2((double)w.y, (double)w.x) / PI + 1);
    return (size_t)fmin(fmax(row, 0) * HEIGHTS, HEIGHTS - 1) * TURNS + (size_t)fmin(column * TURNS, TURNS - 1);
}

/* ---- samples ---- */

/* `other` is lost or goes where s goes, its weight over some number. */
static int is_same(const vndf_bsdf *other, const float u[3], const vndf_scattered *s, double over)
{
    vndf_scattered t;
    vndf_bsdf_sample(other, u, &t);
    return t.lobe == VNDF_LOBE_NONE || (memcmp(&s->wo, &t.wo, sizeof t.wo) == 0 && s->lobe == t.lobe &&
                                        TEST_RELATIVE((double)t.weight[0] * over, (double)s->weight[0], 1e-6));
}

/* Draws into bins. */
static int check_samples(const hit *h, size_t count, int is_closed, mean bins[BINS])
{
    const double most_lost = 1e-3;
    unsigned long long state = 20160724;
    mean all = {0};
    double index2 = (double)h->is.eta * (double)h->is.eta;
    int lossless = h->is.effects.fresnel != VNDF_FRESNEL_SCHLICK, good = 1;
    for (int b = 0; b < BINS; b++)
        bins[b] = (mean){.count = (double)count};
    for (size_t i = 0; i < count; i++) {
        float u[3];
        vndf_scattered s;
        bsdf_numbers(&state, u);
        vndf_bsdf_sample(&h->walk, u, &s);
        double length2 = (double)s.wo.x * s.wo.x + (double)s.wo.y * s.wo.y + (double)s.wo.z * s.wo.z;
        int is_lost = s.lobe == VNDF_LOBE_NONE;
        good &= TEST_NEAR(length2, 1, 1e-6) & TEST(!is_lost || s.weight[0] == 0) &
                TEST(is_lost || !is_closed || !lossless || s.weight[0] == 1) &
                TEST(is_lost || (s.lobe == VNDF_LOBE_REFLECTION) == (s.wo.z > 0));
        if (i < 1000)
            good &= TEST(is_same(&h->once, u, &s, 1)) & TEST(is_same(&h->radiant, u, &s, s.wo.z > 0 ? 1 : index2));
        if (!is_lost) {
            add(&all, (double)s.weight[0]);
            add(&bins[bin_of(s.wo)], (double)s.weight[0]);
        }
    }
    double lost = 1 - all.hits / (double)count, noise = 4.5 * sqrt(most_lost / (double)count);
    all.count = all.hits;
    /* the area of a table of default size is within some 1e-4 of that of its D, and a walk meets some facets */
    double within = 4.5 * sqrt(variance_of(&all)) + (is_closed ? 1e-6 : 1e-3);
    return good & TEST(!lossless || fabs(all.sum / all.count - 1) <= within) & TEST(lost <= most_lost + noise);
}

/* ---- eval ---- */

/* Half by single scattering, half evenly over the sphere or its upper half; 0 where single scattering loses it. */
static int propose(const hit *h, unsigned long long *state, vndf_vec3 *wo)
{
    float u[3];
    vndf_scattered s;
    bsdf_numbers(state, u);
    vndf_bsdf_sample(&h->single, u, &s);
    *wo = s.wo;
    if (test_uniform(state) < 0.5f)
        return s.lobe != VNDF_LOBE_NONE;
    double z = test_uniform_double(state), side = h->passes && test_uniform(state) < 0.5f ? -1 : 1;
    *wo = oracle_toward(side * z, 2 * PI * test_uniform_double(state));
    return wo->z != 0;
}

static int check_eval(const hit *h, size_t count, double least, const mean sampled[BINS])
{
    unsigned long long state = 32;
    mean evaluated[BINS];
    double all = 0, compared = 0, sum = 0, variance = 0;
    int good = 1;
    for (int b = 0; b < BINS; b++)
        evaluated[b] = (mean){.count = (double)count};
    for (size_t i = 0; i < count; i++) {
        vndf_vec3 wo;
        if (!propose(h, &state, &wo))
            continue;
        double value = eval(&h->walk, wo, i), even = 0.5 / PI * (h->passes ? 0.5 : 1);
        good &= TEST(value >= 0 && value < HUGE_VAL);
        add(&evaluated[bin_of(wo)], value / (0.5 * ((double)vndf_bsdf_pdf(&h->single, wo) + even)));
    }
    for (int b = 0; b < BINS; b++) {
        const mean *s = &sampled[b], *e = &evaluated[b];
        all += s->sum;
        if (!is_known(s) || !is_known(e))
            continue;
        compared += s->sum;
        double off = e->sum / e->count - s->sum / s->count, square = variance_of(s) + variance_of(e);
        sum += off;
        variance += square;
        if (!TEST(fabs(off) <= 5 * sqrt(square))) {
            good = 0;
            fprintf(stderr, "    bin %d: sample %g, eval %g more, error %g\n", b, s->sum / s->count, off,
                    sqrt(square));
        }
    }
    good &= TEST(fabs(sum) <= 5 * sqrt(variance));
    return good & TEST(compared > 0.6 * least * all);
}

/* ---- one event ---- */

static int check_single(const hit *h)
{
    unsigned long long state = 77;
    int good = 1;
    for (int k = 0; k < 1000; k++) {
        vndf_vec3 wo = bsdf_direction(&state);
        double want = eval(&h->single, wo, 0);
        good &= TEST(vndf_bsdf_pdf(&h->walk, wo) > 0 || (!h->passes && wo.z < 0));
        good &= TEST_NEAR(eval(&h->once, wo, 1), want, 3e-5 * want + 1e-12);
        want = eval(&h->walk, wo, 1) / (wo.z < 0 ? (double)h->is.eta * (double)h->is.eta : 1);
        good &= TEST_NEAR(eval(&h->radiant, wo, 1), want, 1e-6 * want + 1e-12);
    }
    return good;
}

static void test_subject(const oracle_ndf *ndf, size_t subject)
{
    size_t count = test_amount(20000, 25000, 100000);
    for (size_t i = 0; i < SETTING_COUNT * WALKS; i++) {
        const setting *s = &SETTINGS[i % SETTING_COUNT];
        int kind = (int)(i / SETTING_COUNT);
        vndf_description is = walk_of(kind);
        mean bins[BINS];
        hit h;
        if (subject > 0 && i % 5 != subject % 5)
            continue;
        hit_at(&h, &is, ndf, s->alpha, oracle_toward(s->cosine, 0.9));
        int good = check_samples(&h, count, !ndf->owned, bins);
        good &= check_single(&h);
        if (s->least > 0 && kind != MIRROR &&
            kind != DIAMOND) /* heavy tails have more values than have a variance */
            good &= check_eval(&h, test_amount(20000, 25000, 25000), s->least, bins);
        if (!good)
            fprintf(stderr, "  %s, alpha %g %g, cos %g, walk %d\n", ndf->name, (double)h.is.surface.xx,
                    (double)h.is.surface.yy, s->cosine, kind);
    }
}

int main(int arguments, char **argument)
{
    /* the closed forms and shipped tables as different as they come */
    static const char *const names[] = {
        "ggx",     "beckmann",          "student-t-1.8", "hazy", "epd-0.6", "sgd-nickel-g", "student-t-2.5-small",
        "gtr-1.5", "abc-two-layer-gold"};
    oracle_ndf ndf;
    for (size_t i = 0;
         bsdf_next(&i, &ndf, names, test_amount(4, 4, sizeof names / sizeof *names), arguments, argument); i++) {
        test_subject(&ndf, i);
        oracle_ndf_close(&ndf);
    }
    return test_done();
}
