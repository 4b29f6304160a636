/* Every batch call gives, to the bit, what the call for one element gives: plain surfaces, sheared and leaning ones,
 * both in one batch, and mixtures, for every instruction set, counts that fill no register, arrays without alignment,
 * shared surfaces, directions and weights, matrices that are absent, zeros of either sign, results in the place of
 * inputs, inputs at the edge of what is valid or beyond, directions of length 1e-22 to 1e22, roughness 1e-16 to 1e16
 * and weights 1e-44 to 1e38, also where denormals are flushed to zero. It notices a lane that goes another way than one
 * alone, and a block's end. With the argument avx2 or avx512 that set alone. */
#include "sampler/seen.h"

enum { MOST = 600 };

/* The arrays of inputs; the last two are weights of lobes. */
enum { XX, XY, YX, YY, MEAN_X, MEAN_Y, WI_X, WI_Y, WI_Z, U1, U2, NX, NY, NZ, W0, W1, INPUTS };
enum { OUTPUTS = 5 };

/* After the quantities of seen.h. */
enum { SAMPLE = QUANTITIES, WEIGHT, INVERT, CALLS };
static const char *const call_names[] = {"sample", "sample_weight", "invert"};

enum { PLAIN, SHEARED, MIXED_LOBES, KINDS };

/* One batch; `flat`: yx and the mean slopes are NULL; of plain surfaces xy is, too. */
typedef struct batch_case {
    int kind;
    const vndf_distribution *d;
    size_t count;
    unsigned shared;
    int flat;
    vndf_instructions limit;
    float *in[INPUTS]; /* each begins at the second number of its block */
} batch_case;

static float value_in(const batch_case *b, int input, size_t i)
{
    const unsigned bit = input <= MEAN_Y ? VNDF_SHARED_SURFACE
                         : input <= WI_Z ? VNDF_SHARED_WI
                         : input >= W0   ? VNDF_SHARED_WEIGHT
                                         : 0;
    const int absent = b->kind == PLAIN ? input == XY || (input >= YX && input <= MEAN_Y && input != YY)
                                        : b->flat && (input == YX || input == MEAN_X || input == MEAN_Y);
    return absent ? 0 : b->in[input][b->shared & bit ? 0 : i];
}

/* ---- one element ---- */

/* The second lobe of mixtures is GGX, with the matrix transposed. */
static seen element(const batch_case *b, size_t i)
{
    float v[INPUTS];
    for (int j = 0; j < INPUTS; j++)
        v[j] = value_in(b, j, i);
    const vndf_surface one = {b->d, v[XX], v[XY], v[YX], v[YY], v[MEAN_X], v[MEAN_Y]};
    const vndf_surface two = {vndf_ggx(), v[XX], v[YX], v[XY], v[YY], v[MEAN_X], v[MEAN_Y]};
    const vndf_mixture of = {b->kind == MIXED_LOBES ? 2 : 1, {{one, v[W0]}, {two, v[W1]}}};
    return seen_from(b->kind == MIXED_LOBES ? SEEN_MIXTURE : SEEN_SURFACE, &of,
                     (vndf_vec3){v[WI_X], v[WI_Y], v[WI_Z]});
}

/* The lobe goes as a float. Returns how many numbers there are. */
static size_t expect(const batch_case *b, int which, size_t i, float out[OUTPUTS])
{
    const seen s = element(b, i);
    const int mixed = b->kind == MIXED_LOBES;
    const float u1 = b->in[U1][i], u2 = b->in[U2][i];
    vndf_vec3 wm = {b->in[NX][i], b->in[NY][i], b->in[NZ][i]};
    int lobe = 0;
    if (which < QUANTITIES) {
        out[0] = seen_quantity(&s, (quantity)which, which < AREA ? wm : s.wi);
        return 1;
    }
    if (which == INVERT) {
        if (mixed)
            vndf_mixture_invert(&s.mixture, wm, -1, &out[0], &out[1]);
        else
            vndf_invert(&s.view, wm, &out[0], &out[1]);
        return 2;
    }
    if (mixed) {
        wm = vndf_mixture_sample(&s.mixture, u1, u2, &out[3], &lobe);
        out[4] = which == SAMPLE ? (float)lobe : out[3] > 0 ? vndf_mixture_visible(&s.mixture, wm) / out[3] : 0;
    } else
        wm = which == WEIGHT ? vndf_sample_weight(&s.view, u1, u2, &out[3], &out[4])
                             : vndf_sample(&s.view, u1, u2, &out[3]);
    out[0] = wm.x, out[1] = wm.y, out[2] = wm.z;
    return which == WEIGHT || mixed ? 5 : 4;
}

/* ---- all of them ---- */

static void run(const batch_case *b, int which, float *const out[OUTPUTS])
{
    static int lobe[MOST];
    float *const *in = b->in, *const none[INPUTS] = {NULL}, *const *m = b->flat ? none : in;
    vndf_batch of = {.surface = {b->d, in[XX], in[XY], m[YX], in[YY], m[MEAN_X], m[MEAN_Y]},
                     .count = b->count,
                     .shared = b->shared,
                     .limit = b->limit};
    of.wi_x = in[WI_X], of.wi_y = in[WI_Y], of.wi_z = in[WI_Z];
    if (b->kind == PLAIN)
        of.surface = (vndf_surface_batch){.distribution = b->d, .xx = in[XX], .yy = in[YY]};
    if (b->kind == MIXED_LOBES) {
        of.lobes = 2, of.drawn = lobe;
        of.lobe[0] = (vndf_lobe_batch){of.surface, in[W0]};
        of.lobe[1] = (vndf_lobe_batch){{vndf_ggx(), in[XX], m[YX], in[XY], in[YY], m[MEAN_X], m[MEAN_Y]}, in[W1]};
    }
    const vndf_normals to = {out[0], out[1], out[2]}, wm = {in[NX], in[NY], in[NZ]};
    switch (which) {
    case SAMPLE: vndf_sample_n(&of, in[U1], in[U2], to, out[3]); break;
    case WEIGHT: vndf_sample_weight_n(&of, in[U1], in[U2], to, out[3], out[4]); break;
    case DENSITY: vndf_pdf_n(&of, wm, out[0]); break;
    case VISIBLE: vndf_visible_n(&of, wm, out[0]); break;
    case INVERT: vndf_invert_n(&of, wm, out[0], out[1]); break;
    case NDF: vndf_ndf_n(&of, wm, out[0]); break;
    case AREA: vndf_projected_area_n(&of, out[0]); break;
    case LAMBDA: vndf_lambda_n(&of, out[0]); break;
    default: vndf_g1_n(&of, out[0]);
    }
    for (size_t i = 0; i < b->count && which == SAMPLE && b->kind == MIXED_LOBES; i++)
        out[4][i] = (float)lobe[i];
}

/* ---- comparison ---- */

/* With `in_place`, results go where the normals, or the numbers and the density's input, stood. */
static void test_call(batch_case *b, int which, int in_place, const char *name)
{
    static float want[MOST][OUTPUTS], room[OUTPUTS][MOST + 2], kept[INPUTS][MOST + 2];
    static const int places[OUTPUTS] = {NX, U1, NZ, NY, U2};
    float *out[OUTPUTS], got[OUTPUTS] = {0};
    size_t outputs = 0, wrong = b->count;
    int whole = 1;
    for (size_t i = 0; i < b->count; i++)
        outputs = expect(b, which, i, want[i]);
    for (int i = 0; i < INPUTS; i++)
        memcpy(kept[i], b->in[i] - 1, sizeof kept[i]);
    for (int i = 0; i < OUTPUTS; i++) {
        out[i] = in_place ? b->in[places[i]] : room[i] + 1;
        out[i][b->count] = 12345;
    }
    run(b, which, out);
    for (size_t j = 0; j < outputs; j++) {
        for (size_t i = 0; i < b->count && wrong == b->count; i++)
            if (memcmp(&out[j][i], &want[i][j], sizeof(float)) != 0)
                wrong = i;
        whole &= out[j][b->count] == 12345;
    }
    for (size_t j = 0; j < outputs; j++)
        got[j] = out[j][wrong];
    for (int i = 0; i < INPUTS; i++)
        memcpy(b->in[i] - 1, kept[i], sizeof kept[i]);
    if (TEST(wrong == b->count) & TEST(whole))
        return;
    fprintf(stderr, "  %s, %s, set %d, %lu elements, shared %u, %s, %s\n", name,
            which < QUANTITIES ? quantity_names[which] : call_names[which - QUANTITIES], (int)b->limit,
            (unsigned long)b->count, b->shared, b->flat ? "flat" : "whole", in_place ? "in place" : "apart");
    if (wrong == b->count)
        return;
    seen s = element(b, wrong);
    seen_print(&s, "element");
    for (size_t j = 0; j < outputs; j++)
        fprintf(stderr, "    %.9g, alone %.9g\n", (double)got[j], (double)want[wrong][j]);
}

/* ---- inputs ---- */

/* Directions from everywhere, mostly from below, all from above or all from below, some of them level. */
enum { MIXED, MOSTLY_BELOW, ALL_ABOVE, ALL_BELOW, SIDES };

static void fill(float in[INPUTS][MOST + 2], const vndf_distribution *d, int extreme, int side,
                 unsigned long long *state)
{
    static const float odd[] = {NAN, INFINITY, 0, -1, 1e-42f, 1e30f, 1, -0.0f};
    for (size_t i = 0; i < MOST + 2; i++) {
        const double length = extreme ? random_decade(state, -22, 22) : 1;
        vndf_vec3 wi = random_direction(state, i % 3 ? 0 : -1);
        double z = i % 7 == 0 ? random_decade(state, -12, -2) : (double)wi.z;
        z = side < ALL_ABOVE ? z : i % 21 == 0 ? 0 : side == ALL_ABOVE ? fabs(z) : -fabs(z);
        float numbers[INPUTS];
        for (int j = 0; j < INPUTS; j++)
            numbers[j] = j == XX || j == YY   ? (float)random_decade(state, extreme ? -16 : -4, extreme ? 16 : 1)
                         : j <= MEAN_Y        ? (float)random_between(state, -1, 1)
                         : extreme && j >= W0 ? (float)random_decade(state, -44, 38)
                                              : test_uniform(state);
        seen s = seen_surface(vndf_rough(d, numbers[XX], numbers[YY]), wi);
        vndf_vec3 wm = i % 3 ? seen_draw(&s, numbers[U1], numbers[U2], NULL) : random_direction(state, -0.2);
        numbers[WI_X] = (float)(length * (double)wi.x), numbers[WI_Y] = (float)(length * (double)wi.y);
        numbers[WI_Z] = (float)(length * (side < ALL_ABOVE && (i % 14 == 0) != side ? -z : z));
        numbers[NX] = wm.x, numbers[NY] = wm.y, numbers[NZ] = wm.z;
        if (i % 9 == 0)
            numbers[U1 + i / 9 % 2] = i / 18 % 2 ? 1.0f : 0.0f;
        for (int j = XY; j <= MEAN_Y && i % 5 == 3; j++)
            numbers[j] = j == YY ? numbers[j] : i % 2 ? 0.0f : -0.0f;
        if (i % 10 == 3)
            numbers[WI_X + i / 10 % 3] = i % 4 < 2 ? 0.0f : -0.0f, numbers[U1] = 0.5f;
        if (i % 23 == 5)
            /* but no infinite normal, which times a mean slope of 0 is NaN */
            numbers[test_random_bits(state) % (i % 5 == 3 ? NX : INPUTS)] = odd[test_random_bits(state) % 8];
        if (i % 61 == 7) /* no knot is there */
            numbers[WI_X] = INFINITY, numbers[WI_Z] = -INFINITY;
        for (int j = 0; j < INPUTS; j++)
            in[j][i] = numbers[j];
    }
}

static void test_limit(const subject *of, vndf_instructions limit)
{
    static const size_t counts[] = {MOST, 1, 0, 3, 8, 17, 33, 129};
    static float in[INPUTS][MOST + 2];
    unsigned long long state = 21;
    for (size_t round = 0; round < test_amount(8, 32, 400); round++) {
        batch_case b = {PLAIN, of->d, counts[round % 8], (unsigned)(round / 2 % 8), round % 3 == 1, limit, {NULL}};
        const int extreme = round % 4 == 2;
        fill(in, of->d, extreme, (int)(round / 3 % SIDES), &state);
        set_flushing(round % 5 == 2);
        for (int i = 0; i < INPUTS; i++)
            b.in[i] = in[i] + 1;
        for (int which = 0; which < CALLS; which++)
            for (b.kind = PLAIN; b.kind < KINDS; b.kind++)
                test_call(&b, which, round % 4 == 3, of->name);
        set_flushing(0);
    }
}

/* The one asked for, or the best and each that this machine has. */
static int only;

static void test_subject(const subject *of, size_t index)
{
    for (int limit = VNDF_INSTRUCTIONS_BEST; limit <= VNDF_INSTRUCTIONS_AVX512; limit++)
        if ((!only || limit == only) && (!limit || (int)vndf_instructions_used((vndf_instructions)limit) == limit))
            test_limit(of, (vndf_instructions)limit);
    (void)index;
}

int main(int arguments, char **argument)
{
    const subject none = {"none", NULL, NULL, {0}};
    only = arguments < 2                        ? 0
           : strcmp(argument[1], "avx512") == 0 ? VNDF_INSTRUCTIONS_AVX512
                                                : VNDF_INSTRUCTIONS_AVX2;
    test_subject(&none, 0);
    return subjects_test(1, argument, test_subject);
}
