/* Kernels of `vndf export`, run by whatever runs their language here, answer as the library does.
 *
 *     test_exported [compilers|cuda]                  each compiler of C and C++ that is here; nvcc
 *     test_exported opencl|glsl|hlsl|wgsl PYTHON      a device, by run_kernel.py
 *
 * A run has two kernels with prefixes of their own, normals and a BSDF, and asks both by ask.h in their language; the
 * BSDF fetches its numbers. Questions are, in turn, about GGX, Beckmann and a table. Roughness is 0.02 to 1 on both
 * axes, of BSDFs 0.05 to 1, directions are of the whole sphere. Of eight questions one is of a matrix that turns, with
 * a mean slope, one of numbers at the edges of the unit square, one of a hard direction: exactly along z, next to it,
 * at the horizon. Parameters of the family are below its knots, at them, between and above; one normal of four is
 * bounded.
 *
 * Answers in BITS, of an exported C without contracted products, are the library's, bit for bit, but for mixtures
 * between knots, whose shares it has in double; of BSDFs, which the library computes in double, they are those of the
 * same text in float (event_text.c). ROUNDED ones, of other languages and of all BSDFs beside the library, which
 * computes in double, and FAST ones, whose compiler reorders sums, differ by no more than the limits below. No normal
 * is turned away, not unit or below the surface, no density is 0 or not finite, but straight from below; no scattered
 * direction has a weight or a density that is negative or not finite. */
#define _XOPEN_SOURCE 700
#include <float.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/random.h"
#include "cli/sort.h"
#include "export/event_text.h"
#include "export/export.h"
#include "harness/test.h"
#include "sampler/sampler.h"
#include "vndf_build.h"

enum { QUESTIONS = 12000, NUMBERS = 16 };

/* Questions and answers, as ask.h has them: the places of a question. */
enum { OF, XX, XY, YX, YY, MEAN_X, MEAN_Y, WI, U = 10, WO = 13 };
typedef struct record {
    float n[NUMBERS];
} record;

/* What is asked about, until the end: GGX, Beckmann and a table, with where its numbers begin, and a family. */
enum { SUBJECTS = 3 };
static struct subject {
    const vndf_distribution *is;
    float base;
} subject[SUBJECTS];
static vndf_family *tails;
static export_document tables;

/* ---- what runs kernels ---- */

typedef enum agreement { BITS, ROUNDED, FAST } agreement;

#define HERE VNDF_SOURCE_DIR "/tests/export/"
#define STRICT                                                                         \
  "-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror -ffp-contract=off -I. " HERE \
  "answer.c -lm -o answer && ./answer"
#define PYTHON "$PYTHON " HERE "run_kernel.py "

/* Between them they call all of the text. */
static const vndf_effects glass = {.lobes = VNDF_LOBES_BOTH, .fresnel = VNDF_FRESNEL_DIELECTRIC},
                          clear = {.lobes = VNDF_LOBES_TRANSMISSION, .masking = VNDF_MASKING_NONE},
                          film = {.lobes = VNDF_LOBES_BOTH,
                                  .fresnel = VNDF_FRESNEL_SCHLICK,
                                  .masking = VNDF_MASKING_V_CAVITIES,
                                  .transport = VNDF_TRANSPORT_IMPORTANCE},
                          foil = {.fresnel = VNDF_FRESNEL_CONDUCTOR,
                                  .masking = VNDF_MASKING_SEPARABLE,
                                  .reflection = VNDF_REFLECTION_RETRO},
                          bare = {.lobes = VNDF_LOBES_REFLECTION};

/* Optimised once in each language, since a compiler does not know by which of its names it is called. */
static const struct run {
    const char *name, *language, *command;
    agreement how;
    int embeds; /* the kernel of normals has its numbers; else it fetches them */
    const vndf_effects *effects;
} runs[] = {
    {"compilers", "c", "gcc -x c -std=c99 -O1 " STRICT, BITS, 1, &glass},
    {"compilers", "c", "clang -x c -std=c99 -O0 " STRICT, BITS, 1, &clear},
    {"compilers", "cpp", "g++ -x c++ -std=c++11 -O0 " STRICT, BITS, 1, &film},
    {"compilers", "cpp", "clang++ -x c++ -std=c++11 -O1 " STRICT, BITS, 1, &foil},
    {"compilers", "c", "gcc -x c -std=c99 -O3 -ffast-math " STRICT, FAST, 1, &bare},
    {"cuda", "cuda", "nvcc -x cu $GPU -O3 -I. " HERE "answer.c -o answer && ./answer", ROUNDED, 1, &glass},
    {"opencl", "opencl", PYTHON "opencl", ROUNDED, 1, &glass},
    {"opencl", "opencl", PYTHON "opencl", ROUNDED, 0, &foil},
    {"opencl", "opencl", PYTHON "opencl", ROUNDED, 0, &film},
    {"glsl", "glsl", PYTHON "glsl", ROUNDED, 1, &glass},
    {"glsl", "glsl", PYTHON "glsl", ROUNDED, 0, &foil},
    {"glsl", "glsl", PYTHON "glsl", ROUNDED, 0, &film},
    {"hlsl", "hlsl", PYTHON "hlsl", ROUNDED, 0, &glass},
    {"wgsl", "wgsl", PYTHON "wgsl", ROUNDED, 0, &glass},
    {"wgsl", "wgsl", PYTHON "wgsl", ROUNDED, 0, &foil},
    {"wgsl", "wgsl", PYTHON "wgsl", ROUNDED, 0, &film},
};

/* ---- questions ---- */

static vndf_vec3 vector(const float *v)
{
    const vndf_vec3 w = {v[0], v[1], v[2]};
    return w;
}

static void put(float *to, vndf_vec3 v)
{
    to[0] = v.x;
    to[1] = v.y;
    to[2] = v.z;
}

static vndf_surface surface_of(const record *q)
{
    int i = 0;
    while (i + 1 < SUBJECTS && subject[i].base != q->n[OF])
        i++;
    const vndf_surface m = {subject[i].is, q->n[XX], q->n[XY], q->n[YX], q->n[YY], q->n[MEAN_X], q->n[MEAN_Y]};
    return m;
}

static void put_direction(random_stream *stream, size_t index, float *wi)
{
    static const double hard[] = {1, 1 - 1e-7, 1e-3, 1e-7, 0, -1e-7, -1e-3, -0.64};
    double z = index % 8 == 5 ? hard[index / 8 % 8] : 2 * random_double(stream) - 1, s = sqrt(1 - z * z);
    double phi = index % 16 == 5 ? 0 : 6.283185307179586 * random_double(stream);
    wi[0] = (float)(s * cos(phi));
    wi[1] = (float)(s * sin(phi));
    wi[2] = (float)z;
}

static void turn(random_stream *stream, record *q)
{
    double a = 6.283185307179586 * random_double(stream), x = (double)q->n[XX], y = (double)q->n[YY];
    q->n[XX] = (float)(cos(a) * x);
    q->n[XY] = (float)(-sin(a) * y);
    q->n[YX] = (float)(sin(a) * x);
    q->n[YY] = (float)(cos(a) * y);
    q->n[MEAN_X] = random_float(stream) - 0.5f;
    q->n[MEAN_Y] = random_float(stream) - 0.5f;
}

/* The library's material of a question, which loses its mean slope where its effects have none. Optics are those of
 * ask.h. */
static vndf_material material_of(const vndf_effects *effects, record *q)
{
    vndf_description is = {.surface = surface_of(q),
                           .effects = *effects,
                           .eta = 1.5f,
                           .f0 = {0.0f, 0.04f, 0.9f},
                           .conductor_eta = {0.2f, 0.9f, 1.5f},
                           .conductor_k = {3.9f, 2.4f, 1.9f}};
    vndf_material material;
    is.effects.shape = VNDF_SHAPE_TILTED;
    if (vndf_material_resolve(&is, &material, NULL) == VNDF_OK)
        return material;
    is.effects.shape = VNDF_SHAPE_LEVEL;
    q->n[MEAN_X] = q->n[MEAN_Y] = 0;
    TEST(vndf_material_resolve(&is, &material, NULL) == VNDF_OK);
    return material;
}

static record question_of(size_t index, const vndf_effects *effects)
{
    static const float edges[] = {0.0f, 0x1p-24f, 1 - 0x1p-24f, 1.0f};
    const vndf_family_facts facts = vndf_family_info(tails);
    random_stream stream = random_from((effects ? 2000003u : 1000003u) + index);
    record q = {{subject[index % SUBJECTS].base}};
    float least = effects ? 0.05f : 0.02f;
    q.n[XX] = least * powf(1 / least, random_float(&stream));
    q.n[YY] = least * powf(1 / least, random_float(&stream));
    index /= SUBJECTS;
    put_direction(&stream, index, q.n + WI);
    if (effects)
        put_direction(&stream, index + 4, q.n + WO);
    for (int i = 0; i < 3; i++)
        q.n[U + i] = random_float(&stream);
    if (index % (effects ? 4 : 8) == 3)
        turn(&stream, &q);
    if (index % 8 == 7 && !effects) {
        q.n[U] = edges[index / 8 % 4];
        q.n[U + 1] = index / 32 % 2 ? edges[index / 64 % 4] : q.n[U + 1];
    }
    if (effects)
        material_of(effects, &q);
    else if (index % 8 == 0)
        q.n[WO] = vndf_family_parameter(tails, index / 8 % facts.count);
    else
        q.n[WO] = facts.low + (facts.high - facts.low) * (1.5f * random_float(&stream) - 0.25f);
    q.n[WO + 1] = effects ? q.n[WO + 1] : (float)(index % 4 == 2);
    return q;
}

/* ---- answers ---- */

/* What 99% and 99.9% of the answers but those at the edges of the unit square, the rims of the visible normals, may
 * differ by in their numbers first to last: absolutely (1), as shares of 1 + the number (2), or relatively (0). The
 * last thousandth has the rim of the visible normals, where a rounding moves much. */
typedef struct limit {
    const char *name;
    int first, last, is_absolute;
    double most_of, nearly_all;
} limit;

static const limit NORMALS[] = {
    {"normal", 0, 2, 1, 2e-6, 1e-5},
    {"its density", 3, 3, 0, 2e-5, 3e-4},
    {"pdf", 4, 4, 0, 5e-5, 1e-3},
    {"visible", 5, 5, 0, 5e-5, 1e-3},
    {"D", 6, 6, 0, 5e-5, 3e-4},
    {"Lambda", 7, 7, 2, 1e-5, 3e-5},
    {"G1, G2", 8, 9, 1, 1e-6, 3e-6},
    {"area", 10, 10, 0, 1e-4, 1e-3},
    {"mixed normal", 11, 13, 1, 5e-6, 3e-2},
    {"its density", 14, 14, 0, 1e-4, 1e-2},
    {"mixed pdf", 15, 15, 0, 1e-4, 1e-3},
};

/* Samples whose lobe is another than the library's, by a rounding of F or of a horizon, have no other limit.
 * Beside total reflection 1 - F hangs on the last digits of directions. */
enum { LOBE = 7 };
static const limit SCATTERED[] = {
    {"lobe", LOBE, LOBE, 1, 0, 1},        {"wo", 0, 2, 1, 1e-6, 1e-5},          {"weight", 3, 5, 2, 5e-6, 1e-4},
    {"its density", 6, 6, 0, 2e-5, 1e-4}, {"f", 8, 10, 0, 1e-4, 5e-3},          {"pdf", 11, 11, 0, 1e-4, 5e-3},
    {"f of wo", 12, 14, 0, 1e-4, 5e-3},   {"pdf of wo", 15, 15, 0, 1e-4, 5e-3},
};

enum { LIMITS_MAX = sizeof NORMALS / sizeof *NORMALS, SCATTERED_LIMITS = sizeof SCATTERED / sizeof *SCATTERED };

static double difference(const limit *l, const float *a, const float *b)
{
    double most = 0;
    for (int i = l->first; i <= l->last; i++) {
        double d = fabs((double)a[i] - (double)b[i]), scale = fmax(fabs((double)a[i]), fabs((double)b[i]));
        d = l->is_absolute == 1 ? d : l->is_absolute == 2 ? d / (1 + scale) : scale > 1e-30 ? d / scale : 0;
        most = d <= most ? most : isnan(d) ? HUGE_VAL : d;
    }
    return most;
}

static int is_refused(const record *q, const float *wm, float pdf)
{
    const float *wi = q->n + WI;
    double square = 0, facing = 0;
    for (int i = 0; i < 3; i++) {
        square += (double)wm[i] * (double)wm[i];
        facing += (double)wm[i] * (double)wi[i];
    }
    int blind = wi[0] == 0 && wi[1] == 0 && wi[2] < 0;
    return !(fabs(square - 1) < 1e-6 && wm[2] >= 0 && (blind || (facing > -1.5e-7 && pdf > 0 && pdf <= FLT_MAX)));
}

/* What an answer differs by from the library's in each limit (-1 from edges of the unit square on: not judged), where
 * densities are of the normals that the kernel drew; whether it is refused. *marked: it has other bits. */
static int compare_normal(const record *q, const record *a, double *off, int *marked)
{
    const vndf_surface m = surface_of(q);
    const vndf_vec3 wi = vector(q->n + WI), wm = vector(a->n);
    const float u1 = q->n[U], u2 = q->n[U + 1];
    const int at_edge = u1 < 1e-6f || u1 > 1 - 1e-6f || u2 < 1e-6f || u2 > 1 - 1e-6f;
    record own;
    vndf_view view = vndf_view_from(&m, wi);
    if (q->n[WO + 1] > 0) {
        const vndf_drawn_normal n = vndf_sample_by(&view, VNDF_NORMALS_BOUNDED, u1, u2);
        put(own.n, n.wm);
        own.n[3] = n.density;
        own.n[4] = vndf_pdf_by(&view, VNDF_NORMALS_BOUNDED, wm);
    } else {
        put(own.n, vndf_sample(&view, u1, u2, &own.n[3]));
        own.n[4] = vndf_pdf(&view, wm);
    }
    own.n[5] = vndf_visible(&view, wm);
    own.n[6] = vndf_ndf(&m, wm);
    own.n[7] = vndf_lambda(&m, wi);
    own.n[8] = vndf_g1(&m, wi);
    own.n[9] = vndf_g2(&m, wi, wm, VNDF_G2_HEIGHT_CORRELATED);
    own.n[10] = vndf_projected_area(&m, wi);
    vndf_mixture mixture;
    vndf_family_at(tails, q->n[WO], &m, &mixture);
    const size_t exact = mixture.count == 2 ? 11 : NUMBERS;
    mixture.lobe[mixture.count++] = (vndf_mixture_lobe){{vndf_ggx(), 0.3f, 0, 0, 0.3f, 0, 0}, 0.6f};
    vndf_mixture_view lobes = vndf_mixture_view_from(&mixture, wi);
    put(own.n + 11, vndf_mixture_sample(&lobes, u1, u2, &own.n[14], NULL));
    own.n[15] = vndf_mixture_pdf(&lobes, vector(a->n + 11));
    for (int i = 0; i < LIMITS_MAX; i++)
        off[i] = at_edge ? -1 : difference(&NORMALS[i], a->n, own.n);
    *marked = memcmp(a, &own, exact * sizeof *own.n) != 0;
    return is_refused(q, a->n, a->n[3]) || is_refused(q, a->n + 11, a->n[14]);
}

static size_t other_events; /* answers of BSDFs with other bits than the text in float */

/* The same of a BSDF; f and density are of the direction that the kernel drew, too. *marked: it is scattered. */
static int compare_hit(const vndf_effects *effects, record *q, const record *a, double *off, int *marked)
{
    vndf_material material = material_of(effects, q);
    vndf_bsdf b;
    vndf_scattered drawn;
    float f[VNDF_WAVELENGTHS];
    record own;
    const int there = vndf_bsdf_at(&b, &material, vector(q->n + WI));
    vndf_bsdf_sample(&b, q->n + U, &drawn);
    put(own.n, drawn.wo);
    memcpy(own.n + 3, drawn.weight, 3 * sizeof *f);
    own.n[6] = drawn.density;
    own.n[LOBE] = (float)drawn.lobe;
    vndf_bsdf_eval_pdf(&b, vector(q->n + WO), 0, f, &own.n[11]);
    memcpy(own.n + 8, f, 3 * sizeof *f);
    vndf_bsdf_eval_pdf(&b, vector(a->n), 0, f, &own.n[15]);
    memcpy(own.n + 12, f, 3 * sizeof *f);
    for (int i = 0; i < SCATTERED_LIMITS; i++)
        off[i] = own.n[LOBE] != a->n[LOBE] && i > 0 && i < 4 ? 0 : difference(&SCATTERED[i], a->n, own.n);
    double square = 0;
    for (int i = 0; i < 3; i++)
        square += (double)a->n[i] * (double)a->n[i];
    int bad = 0;
    for (int i = 3; i < NUMBERS; i++)
        bad |= !(a->n[i] >= 0 && a->n[i] <= FLT_MAX);
    *marked = there && a->n[LOBE] > 0;
    event_text(effects, &material.is.surface, vector(q->n + WI), vector(q->n + U), vector(q->n + WO), own.n);
    other_events += memcmp(own.n, a->n, sizeof own.n) != 0;
    return bad || !(fabs(square - 1) < 3e-6) || (a->n[LOBE] > 0) != (a->n[6] > 0);
}

static int judge(const limit *l, double *off, size_t count, double slack)
{
    sort_numbers(off, count);
    double most_of = off[count * 99 / 100], nearly_all = off[count * 999 / 1000];
    int bad = !(most_of <= slack * l->most_of && nearly_all <= slack * l->nearly_all);
    printf("%s %-12s %.1e of 99%%, %.1e of 99.9%%, %.1e of all\n", bad ? "!" : " ", l->name, most_of, nearly_all,
           off[count - 1]);
    return bad;
}

/* Judges the answers to the questions about a kernel. */
static void check(const vndf_effects *effects, agreement how, record *asked, const record *said)
{
    static double off[LIMITS_MAX][QUESTIONS];
    const limit *limits = effects ? SCATTERED : NORMALS;
    const int limit_count = effects ? SCATTERED_LIMITS : LIMITS_MAX;
    int bad = 0, mark;
    other_events = 0;
    size_t judged = 0, refused = 0, marked = 0;
    for (size_t i = 0; i < QUESTIONS; i++) {
        double here[LIMITS_MAX];
        refused += (size_t)(effects ? compare_hit(effects, &asked[i], &said[i], here, &mark)
                                    : compare_normal(&asked[i], &said[i], here, &mark));
        for (int k = 0; k < limit_count; k++)
            off[k][judged] = here[k];
        marked += (size_t)mark;
        judged += here[0] >= 0;
    }
    printf("%zu refused, %zu %s\n", refused, marked, effects ? "scattered" : "with other bits than the library's");
    for (int k = 0; k < limit_count; k++)
        bad += judge(&limits[k], off[k], judged, how == FAST ? 10 : 1);
    TEST(!bad && !refused && judged > QUESTIONS / 2);
    TEST(effects ? marked >= QUESTIONS / 4 : how != BITS || !marked);
    if (effects && how == BITS)
        printf("%zu with other bits than the text in float\n", other_events);
#ifdef VNDF_EVENT_TEXT
    TEST(!effects || how != BITS || !other_events);
#endif
}

/* ---- a run ---- */

/* Files are normals.kernel, normals.asked, bsdf.said, ... */
static FILE *file_of(const vndf_effects *effects, const char *what, const char *mode)
{
    char path[40];
    snprintf(path, sizeof path, "%s.%s", effects ? "bsdf" : "normals", what);
    return fopen(path, mode);
}

/* Writes a kernel with ask.h, and the questions. */
static int prepare(const struct run *r, const vndf_effects *effects, record *asked)
{
    static char ask[1 << 14];
    memset(ask, 0, sizeof ask);
    FILE *text = fopen(HERE "ask.h", "r"), *kernel = file_of(effects, "kernel", "w"),
         *questions = file_of(effects, "asked", "wb");
    export_document d = tables;
    d.to = language_named(r->language);
    d.embeds = r->embeds && !effects;
    d.scatters = effects != NULL;
    d.effects = effects ? *effects : d.effects;
    d.only = "ask";
    for (size_t i = 0; i < QUESTIONS; i++)
        asked[i] = question_of(i, effects);
    if (!TEST(text && fread(ask, 1, sizeof ask - 1, text) > 0 && fclose(text) == 0))
        return 0;
    static const char normals[] = "/* ---- normals ---- */", hits[] = "/* ---- BSDFs: instead ---- */";
    char *first = strstr(ask, normals), *second = strstr(ask, hits);
    if (effects)
        memmove(first, second, strlen(second) + 1);
    else
        *second = '\0';
    return TEST(kernel && questions && document_prefix(&d, effects ? "bsdf" : "normals") &&
                document_write(&d, kernel, ask) &&
                fwrite(asked, sizeof *asked, QUESTIONS, questions) == QUESTIONS && fclose(kernel) == 0 &&
                fclose(questions) == 0);
}

/* Whether there is what runs it. */
static int run(const struct run *r)
{
    static record asked[2][QUESTIONS], said[QUESTIONS];
    const vndf_effects *const effects[] = {NULL, r->effects};
    char found[80];
    snprintf(found, sizeof found, "command -v %.*s >/dev/null", (int)strcspn(r->command, " "), r->command);
    if (system(found) != 0)
        return 0;
    if (!prepare(r, NULL, asked[0]) || !prepare(r, r->effects, asked[1]))
        return 1;
    printf("%s\n", r->command);
    fflush(stdout);
    const int status = system(r->command);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 77) /* it says why */
        return 1;
    for (int i = 0; i < 2 && TEST(status == 0); i++) {
        FILE *answers = file_of(effects[i], "said", "rb");
        if (TEST(answers && fread(said, sizeof *said, QUESTIONS, answers) == QUESTIONS && fclose(answers) == 0))
            check(effects[i], r->how, asked[i], said);
    }
    return 1;
}

/* No more numbers than GLSL may embed. */
static int begin(void)
{
    const vndf_family_options few = {.knots = 3, .max_bytes = 2048};
    vndf_distribution *small = vndf_load(VNDF_SOURCE_DIR "/tables/student-t-2.5-small.vndf", NULL);
    FILE *numbers = fopen("numbers.f32", "wb");
    tails = vndf_build_family("student-t:{p}", 1.6, 6, &few, NULL);
    tables.lobes = 4;
    if (!TEST(small && tails && document_add(&tables, "tails", NULL, tails) == 1))
        return 0;
    subject[0] = (struct subject){vndf_ggx(), -1.0f};
    subject[1] = (struct subject){vndf_beckmann(), -2.0f};
    subject[2] = (struct subject){small, (float)tables.count};
    return TEST(document_add(&tables, "small", small, NULL) == 1 && numbers &&
                fwrite(tables.numbers, sizeof(float), tables.count, numbers) == tables.count &&
                fclose(numbers) == 0 && tables.count < language_named("glsl")->most_embedded);
}

int main(int argc, char **argv)
{
    const char *name = argc > 1 ? argv[1] : "compilers";
    char folder[] = "exported.XXXXXX", removal[40];
    int ran = 0;
    setenv("PYTHON", argc > 2 ? argv[2] : "python3", 1);
    setenv("GPU", access("/dev/nvidia0", F_OK) == 0 ? "-arch=native" : "", 1);
    if (!TEST(mkdtemp(folder) && chdir(folder) == 0) || !begin())
        return test_done();
    for (size_t i = 0; i < sizeof runs / sizeof *runs; i++)
        ran += strcmp(runs[i].name, name) == 0 && run(&runs[i]);
    if (!ran)
        puts("SKIPPED: no compiler here");
    snprintf(removal, sizeof removal, "rm -r %s", folder);
    TEST(chdir("..") == 0 && system(removal) == 0);
    return test_done();
}
