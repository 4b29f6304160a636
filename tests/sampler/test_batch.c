/* Every batch call gives, to the bit, what the call for one element gives: surfaces, affine ones and mixtures, for
 * every instruction set, counts that fill no register, arrays without alignment, shared roughness, directions and
 * weights, matrices that are absent, results in the place of inputs, and inputs at the edge of what is valid or beyond.
 * It notices a lane that goes another way than one alone, and a block's end. With the argument avx2 or avx512 that set
 * alone. */
#include "sampler/seen.h"

enum { MOST = 300 };

/* The arrays of inputs; the last two are weights of lobes. */
enum { XX, XY, YX, YY, MEAN_X, MEAN_Y, WI_X, WI_Y, WI_Z, U1, U2, NX, NY, NZ, W0, W1, INPUTS };
enum { OUTPUTS = 5 };

typedef enum call { SAMPLE, WEIGHT, PDF, VISIBLE, INVERT, NDF, AREA, LAMBDA, G1, CALLS } call;
static const char *const call_names[CALLS] = {"sample", "sample_weight", "pdf",    "visible", "invert",
                                              "ndf",    "area",          "lambda", "g1"};

/* One batch; `flat`: xy, yx and the mean slopes are NULL. */
typedef struct batch_case {
    seen_kind kind;
    const vndf_distribution *d;
    size_t count;
    unsigned shared;
    int flat;
    vndf_instructions limit;
    float *in[INPUTS]; /* each begins at the second number of its block */
} batch_case;

static size_t place_in(const batch_case *b, int input, size_t i)
{
    unsigned bit = input <= MEAN_Y ? VNDF_SHARED_ALPHA
                   : input <= WI_Z ? VNDF_SHARED_WI
                   : input >= W0   ? VNDF_SHARED_WEIGHT
                                   : 0;
    return b->shared & bit ? 0 : i;
}

static float value_in(const batch_case *b, int input, size_t i)
{
    int absent = b->flat && (input == XY || input == YX || input == MEAN_X || input == MEAN_Y);
    return absent ? 0 : b->in[input][place_in(b, input, i)];
}

/* ---- one element ---- */

/* The second lobe of mixtures is GGX, with the matrix transposed. */
static seen element(const batch_case *b, size_t i)
{
    const vndf_affine a = {b->d,
                           value_in(b, XX, i),
                           value_in(b, XY, i),
                           value_in(b, YX, i),
                           value_in(b, YY, i),
                           value_in(b, MEAN_X, i),
                           value_in(b, MEAN_Y, i)};
    const vndf_affine c = {vndf_ggx(), a.xx, a.yx, a.xy, a.yy, a.mean_x, a.mean_y};
    const vndf_mixture of = {b->kind == SEEN_MIXTURE ? 2 : 1, {{a, value_in(b, W0, i)}, {c, value_in(b, W1, i)}}};
    return seen_from(b->kind, &of, (vndf_vec3){value_in(b, WI_X, i), value_in(b, WI_Y, i), value_in(b, WI_Z, i)});
}

/* The lobe goes as a float. */
static void expect_drawn(const batch_case *b, const seen *s, call which, size_t i, float out[OUTPUTS])
{
    float u1 = b->in[U1][i], u2 = b->in[U2][i];
    int lobe = 0;
    vndf_vec3 wm = {b->in[NX][i], b->in[NY][i], b->in[NZ][i]};
    if (which == INVERT && b->kind == SEEN_MIXTURE) {
        out[2] = (float)vndf_mixture_invert(&s->mixture, wm, -1, &out[0], &out[1]);
        return;
    }
    if (which == INVERT) {
        vndf_invert(&s->view, wm, &out[0], &out[1]);
        return;
    }
    wm = which == WEIGHT           ? vndf_sample_weight(&s->view, u1, u2, &out[3], &out[4])
         : b->kind == SEEN_MIXTURE ? vndf_mixture_sample(&s->mixture, u1, u2, &out[3], &lobe)
                                   : seen_draw(s, u1, u2, &out[3]);
    out[0] = wm.x, out[1] = wm.y, out[2] = wm.z;
    if (b->kind == SEEN_MIXTURE)
        out[4] = (float)lobe;
}

static float expect_value(const seen *s, call which, vndf_vec3 wm)
{
    switch (which) {
    case PDF: return seen_pdf(s, wm);
    case VISIBLE: return seen_visible(s, wm);
    case AREA: return seen_area(s, s->wi);
    case NDF: return seen_shape(s, SEEN_NDF, wm);
    case LAMBDA: return seen_shape(s, SEEN_LAMBDA, s->wi);
    default: return seen_shape(s, SEEN_G1, s->wi);
    }
}

static void expect(const batch_case *b, call which, size_t i, float out[OUTPUTS])
{
    seen s = element(b, i);
    memset(out, 0, OUTPUTS * sizeof *out);
    if (which <= WEIGHT || which == INVERT)
        expect_drawn(b, &s, which, i, out);
    else
        out[0] = expect_value(&s, which, (vndf_vec3){b->in[NX][i], b->in[NY][i], b->in[NZ][i]});
}

/* ---- all of them ---- */

static void run_surface(const batch_case *b, call which, float *const out[OUTPUTS])
{
    const vndf_batch of = {b->d,      b->count,    b->shared & 3, b->limit,   b->in[XX],
                           b->in[YY], b->in[WI_X], b->in[WI_Y],   b->in[WI_Z]};
    const vndf_normals to = {out[0], out[1], out[2]}, wm = {b->in[NX], b->in[NY], b->in[NZ]};
    switch (which) {
    case SAMPLE: vndf_sample_n(&of, b->in[U1], b->in[U2], to, out[3]); break;
    case WEIGHT: vndf_sample_weight_n(&of, b->in[U1], b->in[U2], to, out[3], out[4]); break;
    case PDF: vndf_pdf_n(&of, wm, out[0]); break;
    case VISIBLE: vndf_visible_n(&of, wm, out[0]); break;
    case INVERT: vndf_invert_n(&of, wm, out[0], out[1]); break;
    case NDF: vndf_ndf_n(&of, wm, out[0]); break;
    case AREA: vndf_projected_area_n(&of, out[0]); break;
    case LAMBDA: vndf_lambda_n(&of, out[0]); break;
    default: vndf_g1_n(&of, out[0]);
    }
}

static const float *matrix_of(const batch_case *b, int input)
{
    return b->flat ? NULL : b->in[input];
}

static void run_affine(const batch_case *b, call which, float *const out[OUTPUTS])
{
    const vndf_affine_batch of = {b->d,
                                  b->count,
                                  b->shared & 3,
                                  b->limit,
                                  b->in[XX],
                                  matrix_of(b, XY),
                                  matrix_of(b, YX),
                                  b->in[YY],
                                  matrix_of(b, MEAN_X),
                                  matrix_of(b, MEAN_Y),
                                  b->in[WI_X],
                                  b->in[WI_Y],
                                  b->in[WI_Z]};
    const vndf_normals to = {out[0], out[1], out[2]}, wm = {b->in[NX], b->in[NY], b->in[NZ]};
    switch (which) {
    case SAMPLE: vndf_affine_sample_n(&of, b->in[U1], b->in[U2], to, out[3]); break;
    case WEIGHT: vndf_affine_sample_weight_n(&of, b->in[U1], b->in[U2], to, out[3], out[4]); break;
    case PDF: vndf_affine_pdf_n(&of, wm, out[0]); break;
    case VISIBLE: vndf_affine_visible_n(&of, wm, out[0]); break;
    case INVERT: vndf_affine_invert_n(&of, wm, out[0], out[1]); break;
    case NDF: vndf_affine_ndf_n(&of, wm, out[0]); break;
    case AREA: vndf_affine_projected_area_n(&of, out[0]); break;
    case LAMBDA: vndf_affine_lambda_n(&of, out[0]); break;
    default: vndf_affine_g1_n(&of, out[0]);
    }
}

static void run_mixture(const batch_case *b, call which, float *const out[OUTPUTS])
{
    static int lobe[MOST];
    const float *x = matrix_of(b, MEAN_X), *y = matrix_of(b, MEAN_Y);
    const vndf_mixture_batch of = {
        b->count,
        b->shared,
        b->limit,
        b->in[WI_X],
        b->in[WI_Y],
        b->in[WI_Z],
        2,
        {{b->d, b->in[XX], matrix_of(b, XY), matrix_of(b, YX), b->in[YY], x, y, b->in[W0]},
         {vndf_ggx(), b->in[XX], matrix_of(b, YX), matrix_of(b, XY), b->in[YY], x, y, b->in[W1]}}};
    const vndf_normals to = {out[0], out[1], out[2]}, wm = {b->in[NX], b->in[NY], b->in[NZ]};
    switch (which) {
    case SAMPLE: vndf_mixture_sample_n(&of, b->in[U1], b->in[U2], to, out[3], lobe); break;
    case PDF: vndf_mixture_pdf_n(&of, wm, out[0]); break;
    case VISIBLE: vndf_mixture_visible_n(&of, wm, out[0]); break;
    case INVERT: vndf_mixture_invert_n(&of, wm, NULL, out[0], out[1], lobe); break;
    case NDF: vndf_mixture_ndf_n(&of, wm, out[0]); break;
    case AREA: vndf_mixture_projected_area_n(&of, out[0]); break;
    case LAMBDA: vndf_mixture_lambda_n(&of, out[0]); break;
    default: vndf_mixture_g1_n(&of, out[0]);
    }
    for (size_t i = 0; i < b->count && (which == SAMPLE || which == INVERT); i++)
        out[which == SAMPLE ? 4 : 2][i] = (float)lobe[i];
}

/* ---- comparison ---- */

static size_t outputs_of(const batch_case *b, call which)
{
    return which == SAMPLE   ? 4 + (b->kind == SEEN_MIXTURE)
           : which == WEIGHT ? 5
           : which == INVERT ? 2 + (b->kind == SEEN_MIXTURE)
                             : 1;
}

/* With `in_place`, results go where the normals, or the numbers and the density's input, stood. */
static void test_call(batch_case *b, call which, int in_place, const char *name)
{
    static float want[MOST][OUTPUTS], room[OUTPUTS][MOST + 2], kept[INPUTS][MOST + 2];
    static const int places[OUTPUTS] = {NX, U1, NZ, NY, U2};
    float *out[OUTPUTS];
    size_t outputs = outputs_of(b, which), wrong = b->count;
    for (size_t i = 0; i < b->count; i++)
        expect(b, which, i, want[i]);
    for (int i = 0; i < INPUTS; i++)
        memcpy(kept[i], b->in[i] - 1, sizeof kept[i]);
    for (int i = 0; i < OUTPUTS; i++) {
        out[i] = in_place ? b->in[places[i]] : room[i] + 1;
        out[i][b->count] = 12345;
    }
    (b->kind == SEEN_SURFACE ? run_surface : b->kind == SEEN_AFFINE ? run_affine : run_mixture)(b, which, out);
    for (size_t i = 0; i < b->count; i++)
        for (size_t j = 0; j < outputs; j++)
            if (memcmp(&out[j][i], &want[i][j], sizeof(float)) != 0 && wrong == b->count)
                wrong = i;
    int whole = 1;
    for (size_t j = 0; j < outputs; j++)
        whole &= out[j][b->count] == 12345;
    float got[OUTPUTS];
    for (size_t j = 0; j < outputs && wrong < b->count; j++)
        got[j] = out[j][wrong];
    for (int i = 0; i < INPUTS; i++)
        memcpy(b->in[i] - 1, kept[i], sizeof kept[i]);
    if (TEST(wrong == b->count) & TEST(whole))
        return;
    fprintf(stderr, "  %s, %s, set %d, %lu elements, shared %u, %s, %s\n", name, call_names[which], (int)b->limit,
            (unsigned long)b->count, b->shared, b->flat ? "flat" : "whole", in_place ? "in place" : "apart");
    if (wrong < b->count) {
        seen s = element(b, wrong);
        seen_print(&s, "element");
        fprintf(stderr, "    u %.9g %.9g wm %.9g %.9g %.9g\n", (double)b->in[U1][wrong], (double)b->in[U2][wrong],
                (double)b->in[NX][wrong], (double)b->in[NY][wrong], (double)b->in[NZ][wrong]);
        for (size_t j = 0; j < outputs; j++)
            fprintf(stderr, "    %.9g, alone %.9g\n", (double)got[j], (double)want[wrong][j]);
    }
}

/* ---- inputs ---- */

static void fill(float in[INPUTS][MOST + 2], const vndf_distribution *d, unsigned long long *state)
{
    static const float odd[] = {NAN, INFINITY, 0, -1, 1e-42f, 1e30f, 1, -0.0f};
    for (size_t i = 0; i < MOST + 2; i++) {
        vndf_vec3 wi = random_direction(state, i % 3 ? 0 : -1);
        float z = i % 7 == 0 ? (float)random_decade(state, -12, -2) : wi.z;
        float numbers[INPUTS] = {(float)random_decade(state, -4, 1),
                                 (float)random_between(state, -1, 1),
                                 (float)random_between(state, -1, 1),
                                 (float)random_decade(state, -4, 1),
                                 (float)random_between(state, -1, 1),
                                 (float)random_between(state, -1, 1),
                                 wi.x,
                                 wi.y,
                                 i % 14 == 0 ? -z : z,
                                 test_uniform(state),
                                 test_uniform(state),
                                 0,
                                 0,
                                 0,
                                 test_uniform(state),
                                 test_uniform(state)};
        seen s = seen_surface(d, numbers[XX], numbers[YY], wi);
        vndf_vec3 wm = i % 3 ? seen_draw(&s, numbers[U1], numbers[U2], NULL) : random_direction(state, -0.2);
        numbers[NX] = wm.x, numbers[NY] = wm.y, numbers[NZ] = wm.z;
        if (i % 9 == 0)
            numbers[U1 + i / 9 % 2] = i % 2 ? 1.0f : 0.0f;
        if (i % 23 == 5)
            numbers[test_random_bits(state) % INPUTS] = odd[test_random_bits(state) % 8];
        for (int j = 0; j < INPUTS; j++)
            in[j][i] = numbers[j];
    }
}

static void test_subject(const subject *of, vndf_instructions limit)
{
    static const size_t counts[] = {MOST, 1, 0, 3, 8, 17, 33, 129};
    static float in[INPUTS][MOST + 2];
    unsigned long long state = 21;
    for (size_t round = 0; round < test_amount(8, 32, 400); round++) {
        batch_case b = {SEEN_SURFACE, of->d, counts[round % 8], (unsigned)(round / 2 % 8), round % 3 == 1,
                        limit,        {NULL}};
        fill(in, of->d, &state);
        for (int i = 0; i < INPUTS; i++)
            b.in[i] = in[i] + 1;
        for (int which = 0; which < CALLS; which++)
            for (int kind = SEEN_SURFACE; kind <= SEEN_MIXTURE; kind++) {
                b.kind = (seen_kind)kind;
                if (which != WEIGHT || kind != SEEN_MIXTURE)
                    test_call(&b, (call)which, round % 4 == 3, of->name);
            }
    }
}

static void test_sets(const subject *of, int only)
{
    for (int limit = VNDF_INSTRUCTIONS_BEST; limit <= VNDF_INSTRUCTIONS_AVX512; limit++)
        if ((!only || limit == only) && (!limit || (int)vndf_instructions_used((vndf_instructions)limit) == limit))
            test_subject(of, (vndf_instructions)limit);
}

int main(int arguments, char **argument)
{
    int only = arguments < 2                        ? 0
               : strcmp(argument[1], "avx512") == 0 ? VNDF_INSTRUCTIONS_AVX512
                                                    : VNDF_INSTRUCTIONS_AVX2;
    const subject none = {"none", NULL, NULL, {0}};
    test_sets(&none, only);
    for (size_t i = 0; i < SUBJECT_COUNT; i++) {
        subject s = subject_open(i);
        test_sets(&s, only);
        vndf_free(s.owned);
    }
    return test_done();
}
