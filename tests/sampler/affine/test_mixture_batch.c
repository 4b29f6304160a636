/* A batch of mixtures gives to the bit what the calls of one give, samples with their lobes and answers alike, for
 * every instruction set there is, distribution and count, shared or not, in place or not: one to eight lobes of several
 * distributions, some without a matrix of their own or of weight 0, directions of the whole sphere, and invalid
 * numbers. With the argument avx2 or avx512 that instruction set alone. */
#include <float.h>

#include "harness/constants.h"
#include "sampler/batch_case.h"

enum { COUNT_MOST = 700 };
enum { XX, XY, YX, YY, MEAN_X, MEAN_Y, WEIGHT, OF_LOBE };
enum { WI_X, WI_Y, WI_Z, U1, U2, X, Y, Z, OUT, OUT_2, ARRAYS };

typedef struct numbers {
    float lobe[VNDF_MIXTURE_LOBES][OF_LOBE][COUNT_MOST], of[ARRAYS][COUNT_MOST];
    int which[COUNT_MOST];
} numbers;

static double uniform(unsigned long long *state, double from, double to)
{
    return from + (to - from) * test_uniform_double(state);
}

static void fill_lobe(float of[OF_LOBE][COUNT_MOST], size_t i, unsigned long long *state)
{
    double alpha = exp(uniform(state, -5, 0)), kind = test_uniform(state);
    for (int k = XX; k <= YY; k++)
        of[k][i] = (float)uniform(state, -alpha, alpha);
    for (int k = MEAN_X; k <= MEAN_Y; k++)
        of[k][i] = kind < 0.3 ? 0.0f : (float)uniform(state, -0.3, 0.3);
    of[WEIGHT][i] = kind > 0.9 ? 0.0f : (float)exp(uniform(state, -5, 5));
}

/* One in twenty has a number that is odd. The first are ordinary: they serve all where they are shared. */
static void fill(numbers *n, unsigned long long seed)
{
    static const float odd[] = {0.0f, -0.0f, 1e-42f, -1e-30f, 1e30f, FLT_MAX, HUGE_VALF, -HUGE_VALF, NAN};
    unsigned long long state = seed;
    for (size_t i = 0; i < COUNT_MOST; i++) {
        double z = uniform(&state, -0.5, 1), phi = uniform(&state, 0, 2 * PI), s = sqrt(1 - z * z);
        double length = test_uniform(&state) < 0.05f ? exp(uniform(&state, -80, 80)) : 1;
        for (int l = 0; l < VNDF_MIXTURE_LOBES; l++)
            fill_lobe(n->lobe[l], i, &state);
        n->of[WI_X][i] = (float)(length * s * cos(phi));
        n->of[WI_Y][i] = (float)(length * s * sin(phi));
        n->of[WI_Z][i] = (float)(length * z);
        for (int k = U1; k <= U2; k++)
            n->of[k][i] = i % 30 == 3 ? 0.0f : i % 30 == 5 ? 1.0f : test_uniform(&state);
        double tall = uniform(&state, -0.1, 1), turn = uniform(&state, 0, 2 * PI), across = sqrt(1 - tall * tall);
        n->of[X][i] = (float)(across * cos(turn));
        n->of[Y][i] = (float)(across * sin(turn));
        n->of[Z][i] = (float)tall;
        n->which[i] = (int)(test_random_bits(&state) % 5) - 1;
        if (i % 20 == 19) {
            float *at = i % 3 ? n->lobe[i / 20 % 2][i / 40 % OF_LOBE] : n->of[i / 20 % (Z + 1)];
            at[i] = odd[i / 20 % (sizeof odd / sizeof *odd)];
        }
    }
    n->of[WI_Z][1] = fabsf(n->of[WI_Z][1]);
    n->lobe[0][WEIGHT][1] = 1;
}

typedef enum kind { SAMPLE, PDF, VISIBLE, NDF, AREA, LAMBDA, G1, INVERT, KINDS } kind;
static const char *const kind_names[KINDS] = {"sample", "pdf", "visible", "ndf", "area", "lambda", "g1", "invert"};

static vndf_mixture_batch batch_of(const vndf_distribution *d, numbers *n, size_t count, int lobes,
                                   unsigned shared, vndf_instructions limit)
{
    const vndf_distribution *all[] = {d, vndf_ggx(), d, vndf_beckmann()};
    vndf_mixture_batch b = {.count = count, .shared = shared, .limit = limit, .lobes = lobes};
    b.wi_x = n->of[WI_X] + 1;
    b.wi_y = n->of[WI_Y] + 1;
    b.wi_z = n->of[WI_Z] + 1;
    for (int l = 0; l < lobes && l < VNDF_MIXTURE_LOBES; l++) {
        float(*of)[COUNT_MOST] = n->lobe[l];
        int bare = l % 3 == 1;
        vndf_lobe_batch lobe = {all[l % 4],
                                of[XX] + 1,
                                bare ? NULL : of[XY] + 1,
                                bare ? NULL : of[YX] + 1,
                                of[YY] + 1,
                                bare ? NULL : of[MEAN_X] + 1,
                                bare ? NULL : of[MEAN_Y] + 1,
                                of[WEIGHT] + 1};
        b.lobe[l] = lobe;
    }
    return b;
}

static vndf_normals normals_of(numbers *n)
{
    vndf_normals wm = {n->of[X] + 1, n->of[Y] + 1, n->of[Z] + 1};
    return wm;
}

static void call_batch(kind which, const vndf_mixture_batch *b, numbers *n, float *to)
{
    vndf_normals wm = normals_of(n);
    switch (which) {
    case SAMPLE: vndf_mixture_sample_n(b, n->of[U1] + 1, n->of[U2] + 1, wm, to, n->which + 1); break;
    case PDF: vndf_mixture_pdf_n(b, wm, to); break;
    case VISIBLE: vndf_mixture_visible_n(b, wm, to); break;
    case NDF: vndf_mixture_ndf_n(b, wm, to); break;
    case AREA: vndf_mixture_projected_area_n(b, to); break;
    case LAMBDA: vndf_mixture_lambda_n(b, to); break;
    case G1: vndf_mixture_g1_n(b, to); break;
    default: vndf_mixture_invert_n(b, wm, n->which + 1, to, n->of[OUT_2] + 1, n->which + 1); break;
    }
}

static float number_at(const float *from, size_t i)
{
    return from ? from[i] : 0.0f;
}

static vndf_mixture mixture_at(const vndf_mixture_batch *b, size_t i)
{
    size_t a = b->shared & VNDF_SHARED_ALPHA ? 0 : i;
    vndf_mixture m = {.count = b->lobes};
    for (int l = 0; l < b->lobes && l < VNDF_MIXTURE_LOBES; l++) {
        const vndf_lobe_batch *of = &b->lobe[l];
        vndf_affine surface = {of->distribution,        of->xx[a], number_at(of->xy, a),
                               number_at(of->yx, a),    of->yy[a], number_at(of->mean_x, a),
                               number_at(of->mean_y, a)};
        m.lobe[l].surface = surface;
        m.lobe[l].weight = of->weight[b->shared & VNDF_SHARED_WEIGHT ? 0 : i];
    }
    return m;
}

/* What the calls of one give for element i: up to four numbers and a lobe. */
static int call_one(kind which, const vndf_mixture_batch *b, const numbers *n, size_t i, float to[4])
{
    size_t w = b->shared & VNDF_SHARED_WI ? 0 : i;
    vndf_mixture m = mixture_at(b, i);
    vndf_vec3 wi = {b->wi_x[w], b->wi_y[w], b->wi_z[w]}, wm = {n->of[X][i + 1], n->of[Y][i + 1], n->of[Z][i + 1]};
    vndf_mixture_view view = vndf_mixture_view_from(&m, wi);
    int lobe = 0;
    switch (which) {
    case SAMPLE:
        wm = vndf_mixture_sample(&view, n->of[U1][i + 1], n->of[U2][i + 1], &to[0], &lobe);
        to[1] = wm.x;
        to[2] = wm.y;
        to[3] = wm.z;
        return lobe;
    case PDF: to[0] = vndf_mixture_pdf(&view, wm); return 0;
    case VISIBLE: to[0] = vndf_mixture_visible(&view, wm); return 0;
    case NDF: to[0] = vndf_mixture_ndf(&m, wm); return 0;
    case AREA: to[0] = vndf_mixture_projected_area(&m, wi); return 0;
    case LAMBDA: to[0] = vndf_mixture_lambda(&m, wi); return 0;
    case G1: to[0] = vndf_mixture_g1(&m, wi); return 0;
    default: return vndf_mixture_invert(&view, wm, n->which[i + 1], &to[0], &to[1]);
    }
}

/* How many differ from the calls of one; *seen counts those that are not 0. */
static size_t differences(kind which, const vndf_mixture_batch *b, const numbers *given, const numbers *made,
                          const float *to, size_t *seen)
{
    size_t different = 0;
    for (size_t i = 0; i < b->count; i++) {
        float want[4] = {0, 0, 0, 0}, got[4] = {to[i], which == INVERT ? made->of[OUT_2][i + 1] : 0, 0, 0};
        for (int k = 0; which == SAMPLE && k < 3; k++)
            got[1 + k] = made->of[X + k][i + 1];
        int lobe = call_one(which, b, given, i, want), same = memcmp(want, got, sizeof want) == 0;
        different += !same || ((which == SAMPLE || which == INVERT) && lobe != made->which[i + 1]);
        *seen += got[0] > 0;
    }
    return different;
}

static void test_call(kind which, const vndf_distribution *d, const char *name, vndf_instructions limit)
{
    static const size_t counts[] = {0, 1, 3, 127, 128, 129, COUNT_MOST - 2};
    static const int lobes[] = {1, 2, 3, VNDF_MIXTURE_LOBES, 0, VNDF_MIXTURE_LOBES + 1, 2};
    static numbers given, made;
    for (unsigned c = 0; c < 7; c++)
        for (unsigned shared = 0; shared < 8; shared++) {
            size_t count = counts[c], seen = 0;
            int many = lobes[(c + shared) % 7];
            fill(&given, 99 + c);
            made = given;
            vndf_mixture_batch b = batch_of(d, &given, count, many, shared, limit);
            call_batch(which, &b, &made, made.of[OUT] + 1);
            size_t different = differences(which, &b, &given, &made, made.of[OUT] + 1, &seen);
            if (!TEST(different == 0))
                fprintf(stderr, "  %s, %s, instructions %d, shared %u, lobes %d: %lu of %lu differ\n", name,
                        kind_names[which], (int)limit, shared, many, (unsigned long)different,
                        (unsigned long)count);
            TEST(memcmp(&made.of[OUT][count + 1], &given.of[OUT][count + 1], sizeof(float)) == 0);
            TEST(memcmp(&made.of[X][count + 1], &given.of[X][count + 1], sizeof(float)) == 0);
            TEST(made.which[count + 1] == given.which[count + 1]);
            TEST(count < 500 || shared || !d || many < 1 || many > 2 || which == INVERT || seen > count / 5);
        }
}

/* Results over a matrix and the directions; without a density and without lobes. */
static void test_in_place(const vndf_distribution *d, vndf_instructions limit)
{
    static numbers given, made, aside;
    size_t seen = 0, count = COUNT_MOST - 2;
    fill(&given, 5);
    made = aside = given;
    vndf_mixture_batch apart = batch_of(d, &given, count, 3, 0, limit), b = batch_of(d, &made, count, 3, 0, limit);
    vndf_normals wm = {made.of[WI_X] + 1, made.of[WI_Y] + 1, made.of[WI_Z] + 1};
    vndf_mixture_sample_n(&b, made.of[U1] + 1, made.of[U2] + 1, wm, made.lobe[1][XX] + 1, made.which + 1);
    memcpy(made.of[X], made.of[WI_X], 3 * sizeof made.of[X]);
    TEST(differences(SAMPLE, &apart, &given, &made, made.lobe[1][XX] + 1, &seen) == 0);
    vndf_mixture_sample_n(&apart, given.of[U1] + 1, given.of[U2] + 1, normals_of(&aside), NULL, NULL);
    for (int k = X; k <= Z; k++)
        TEST(memcmp(aside.of[k] + 1, made.of[k] + 1, count * sizeof(float)) == 0);
}

static void test_distribution(const vndf_distribution *d, const char *name, vndf_instructions only)
{
    int first = only != VNDF_INSTRUCTIONS_BEST ? (int)only : VNDF_INSTRUCTIONS_PORTABLE;
    int last = only != VNDF_INSTRUCTIONS_BEST ? (int)only : VNDF_INSTRUCTIONS_AVX512;
    for (int limit = first; limit <= last; limit++) {
        for (int which = 0; which < KINDS; which++)
            test_call((kind)which, d, name, (vndf_instructions)limit);
        test_in_place(d, (vndf_instructions)limit);
    }
}

int main(int arguments, char **argument)
{
    return batch_main(arguments, argument, test_distribution);
}
