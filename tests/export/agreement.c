#include "export/agreement.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "cli/random.h"
#include "measure/stress.h"

/* cos 130 degrees */
static const double below = -0.6427876;

const char *agreement_name(int id)
{
    static const char *const names[AGREEMENT_COUNT] = {
        "sampled", "repeated", "pdf",    "visible", "ndf",         "area",        "lambda",
        "g1",      "g2",       "normal", "mixed",   "mixed again", "mixed normal"};
    return names[id];
}

const char *agreement_region_name(int region)
{
    static const char *const names[AGREEMENT_REGIONS] = {"above", "to 130 degrees", "deeper", "turned", "edges"};
    return names[region];
}

/* ---- questions ----------------------------------------------------------------------------------- */

static float between(random_stream *stream, double from, double to)
{
    return (float)(from + (to - from) * random_double(stream));
}

static float roughness(random_stream *stream)
{
    return 0.02f * powf(50.0f, random_float(stream));
}

/* One number of the two is on the border, and sometimes both. */
static void put_edges(random_stream *stream, exported_question *q)
{
    static const float edges[] = {0.0f, 0x1p-24f, 1 - 0x1p-24f, 1.0f};
    unsigned long long which = random_bits(stream) >> 32;
    if (which % 3 != 0)
        q->u1 = edges[which / 4 % 4];
    if (which % 3 != 1)
        q->u2 = edges[which / 16 % 4];
}

/* Half of the directions are above the horizon, cosines from 1 to -1. */
static void put_direction(random_stream *stream, float wi[3])
{
    double z = 2 * random_double(stream) - 1, phi = 6.283185307179586 * random_double(stream);
    double s = sqrt(1 - z * z);
    wi[0] = (float)(s * cos(phi));
    wi[1] = (float)(s * sin(phi));
    wi[2] = (float)z;
}

/* R(a) diag(alpha) R(b), and a mean slope. */
static void turn(random_stream *stream, exported_question *q)
{
    double a = 6.283185307179586 * random_double(stream), b = 6.283185307179586 * random_double(stream);
    double x = (double)q->xx, y = (double)q->yy, ca = cos(a), sa = sin(a), cb = cos(b), sb = sin(b);
    q->xx = (float)(ca * x * cb - sa * y * sb);
    q->xy = (float)(-ca * x * sb - sa * y * cb);
    q->yx = (float)(sa * x * cb + ca * y * sb);
    q->yy = (float)(-sa * x * sb + ca * y * cb);
    q->mean_x = between(stream, -0.5, 0.5);
    q->mean_y = between(stream, -0.5, 0.5);
}

exported_question agreement_question(const exported_subjects *subjects, int subject, size_t index)
{
    random_stream stream = random_from(1000003u * (unsigned long long)subject + index);
    vndf_vec3 up = {0, 0, 1};
    float x = roughness(&stream), y = roughness(&stream);
    exported_question q = exported_question_of(subjects, subject, x, y, up);
    put_direction(&stream, q.wi);
    if (index % 8 == 3)
        turn(&stream, &q);
    q.u1 = random_float(&stream);
    q.u2 = random_float(&stream);
    if (index % 8 == 7)
        put_edges(&stream, &q);
    return q;
}

/* ---- answers ------------------------------------------------------------------------------------- */

int agreement_begin(agreement *a, size_t capacity)
{
    *a = (agreement){.capacity = capacity};
    for (int region = 0; region < AGREEMENT_REGIONS; region++)
        for (int id = 0; id < AGREEMENT_COUNT; id++)
            if (!(a->difference[region][id] = malloc((capacity + 1) * sizeof(double))))
                return 0;
    return 1;
}

void agreement_end(agreement *a)
{
    for (int region = 0; region < AGREEMENT_REGIONS; region++)
        for (int id = 0; id < AGREEMENT_COUNT; id++)
            free(a->difference[region][id]);
}

/* Not a number counts as infinite. */
static double known(double difference)
{
    return isnan(difference) ? INFINITY : fabs(difference);
}

/* Both nothing, as of a rim that underflows, is no difference. */
static double relative(double got, double want)
{
    if (got <= FLT_MIN && want <= FLT_MIN && got >= 0)
        return 0;
    return known(want > 0 ? got / want - 1 : got);
}

static vndf_vec3 vector(const float v[3])
{
    vndf_vec3 w = {v[0], v[1], v[2]};
    return w;
}

/* Whether wi sees less than 1e-10 of what it would see level with the mean plane, or is farther down than that. */
static int is_deep(const vndf_affine *surface, vndf_vec3 wi)
{
    double x = (double)surface->mean_x, y = (double)surface->mean_y, lift = (double)wi.x * x + (double)wi.y * y;
    double z = ((double)wi.z - lift) / sqrt(1 + x * x + y * y);
    vndf_vec3 level = {wi.x, wi.y, (float)lift};
    double size = stress_length(level), area = (double)vndf_affine_projected_area(surface, level) / size;
    return z < below || (z < 0 && !((double)vndf_affine_projected_area(surface, wi) > 1e-10 * area));
}

static agreement_region region_of(const exported_question *q, const vndf_affine *surface)
{
    int edge = q->u1 <= 0x1p-24f || q->u1 >= 1 - 0x1p-24f || q->u2 <= 0x1p-24f || q->u2 >= 1 - 0x1p-24f;
    if (is_deep(surface, vector(q->wi)))
        return AGREEMENT_DEEP;
    if (edge)
        return AGREEMENT_EDGES;
    if (q->xy != 0 || q->yx != 0)
        return AGREEMENT_TURNED;
    return q->wi[2] >= 0 ? AGREEMENT_ABOVE : AGREEMENT_BELOW;
}

static int is_refused(const exported_question *q, vndf_vec3 wm, float pdf)
{
    double length = stress_length(wm), turned = stress_turned_away(vector(q->wi), wm);
    return !(pdf > 0 && pdf <= FLT_MAX && fabs(length - 1) <= 4 * 0x1p-23 && turned <= 2 && wm.z >= 0);
}

/* Between normals whose slopes are over the larger roughness. */
static double distance(const exported_question *q, vndf_vec3 a, vndf_vec3 b)
{
    double per = 1 / sqrt((double)(q->xx * q->xx + q->xy * q->xy + q->yx * q->yx + q->yy * q->yy)), sum = 0;
    double u[3] = {(double)a.x * per, (double)a.y * per, (double)a.z};
    double v[3] = {(double)b.x * per, (double)b.y * per, (double)b.z};
    double lu = sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]), lv = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int i = 0; i < 3; i++)
        sum += (u[i] / lu - v[i] / lv) * (u[i] / lu - v[i] / lv);
    return sqrt(sum);
}

static vndf_mixture mixture_of(const vndf_affine *surface)
{
    vndf_mixture mixture = {.count = 2};
    mixture.lobe[0].surface = *surface;
    mixture.lobe[0].weight = 0.6f;
    mixture.lobe[1].surface = (vndf_affine){vndf_ggx(), 0.3f, 0, 0, 0.3f, 0, 0};
    mixture.lobe[1].weight = 0.4f;
    return mixture;
}

static void measure(const exported_question *q, const exported_answer *answer, const vndf_affine *surface,
                    double *d)
{
    vndf_vec3 wi = vector(q->wi), wm = vector(answer->wm), mixed = vector(answer->mixed);
    vndf_affine_view view = vndf_affine_view_from(surface, wi);
    vndf_mixture mixture = mixture_of(surface);
    vndf_mixture_view lobes = vndf_mixture_view_from(&mixture, wi);
    double pdf = (double)vndf_affine_pdf(&view, wm), both = (double)vndf_mixture_pdf(&lobes, mixed);
    double lambda = (double)vndf_affine_lambda(surface, wi);
    double g2 = (double)vndf_affine_g2(surface, wi, wm, VNDF_G2_HEIGHT_CORRELATED);
    d[AGREEMENT_SAMPLED] = relative((double)answer->sampled, pdf);
    d[AGREEMENT_REPEATED] = relative((double)answer->pdf, (double)answer->sampled);
    d[AGREEMENT_PDF] = relative((double)answer->pdf, pdf);
    d[AGREEMENT_VISIBLE] = relative((double)answer->visible, (double)vndf_affine_visible(&view, wm));
    d[AGREEMENT_NDF] = relative((double)answer->ndf, (double)vndf_affine_ndf(surface, wm));
    d[AGREEMENT_AREA] = relative((double)answer->area, (double)vndf_affine_projected_area(surface, wi));
    d[AGREEMENT_LAMBDA] = known(((double)answer->lambda - lambda) / (1 + fabs(lambda)));
    d[AGREEMENT_G1] = known((double)answer->g1 - (double)vndf_affine_g1(surface, wi));
    d[AGREEMENT_G2] = known((double)answer->g2 - g2);
    d[AGREEMENT_NORMAL] = known(distance(q, wm, vndf_affine_sample(&view, q->u1, q->u2, NULL)));
    d[AGREEMENT_MIXED] = relative((double)answer->mixed_sampled, both);
    d[AGREEMENT_MIXED_REPEATED] = relative((double)answer->mixed_pdf, (double)answer->mixed_sampled);
    d[AGREEMENT_MIXED_NORMAL] = known(distance(q, mixed, vndf_mixture_sample(&lobes, q->u1, q->u2, NULL, NULL)));
}

void agreement_note(agreement *a, const exported_subjects *subjects, const exported_question *q,
                    const exported_answer *answer)
{
    vndf_affine surface = exported_surface(subjects, q);
    agreement_region region = region_of(q, &surface);
    double d[AGREEMENT_COUNT];
    if (a->asked[region] >= a->capacity)
        return;
    measure(q, answer, &surface, d);
    for (int id = 0; id < AGREEMENT_COUNT; id++)
        a->difference[region][id][a->asked[region]] = d[id];
    a->asked[region]++;
    a->refused[region] += is_refused(q, vector(answer->wm), answer->sampled) ||
                          is_refused(q, vector(answer->mixed), answer->mixed_sampled);
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void agreement_sort(agreement *a)
{
    for (int region = 0; region < AGREEMENT_REGIONS; region++)
        for (int id = 0; id < AGREEMENT_COUNT; id++)
            qsort(a->difference[region][id], a->asked[region], sizeof(double), ascending);
}

double agreement_part(const agreement *a, int region, int id, double part)
{
    size_t count = a->asked[region];
    return count ? a->difference[region][id][(size_t)(part * (double)(count - 1))] : 0;
}

/* ---- limits -------------------------------------------------------------------------------------- */

/* Of 99.9% of the answers, and of all; 0 for what is not judged. */
typedef struct limit {
    double most_of, all;
} limit;

/* Some twice what 1e6 questions about each of 17 distributions found for 99.9%, and several times that for all; above
 * the horizon `all` is the aim of the exported kernels. */
static const limit limits[AGREEMENT_REGIONS][AGREEMENT_COUNT] = {
    [AGREEMENT_ABOVE] = {[AGREEMENT_SAMPLED] = {5e-6, 1e-3},
                         [AGREEMENT_REPEATED] = {1e-5, 1e-3},
                         [AGREEMENT_PDF] = {1e-5, 1e-3},
                         [AGREEMENT_VISIBLE] = {2e-5, 1e-3},
                         [AGREEMENT_NDF] = {5e-6, 1e-4},
                         [AGREEMENT_AREA] = {2e-5, 3e-5},
                         [AGREEMENT_LAMBDA] = {5e-7, 1e-6},
                         [AGREEMENT_G1] = {3e-7, 1e-6},
                         [AGREEMENT_G2] = {4e-7, 1e-6},
                         [AGREEMENT_NORMAL] = {2e-5, 2e-3},
                         [AGREEMENT_MIXED] = {2e-5, 1e-3},
                         [AGREEMENT_MIXED_REPEATED] = {1e-5, 1e-3},
                         [AGREEMENT_MIXED_NORMAL] = {2e-4, 2.1}},
    [AGREEMENT_BELOW] = {[AGREEMENT_SAMPLED] = {2e-5, 3e-5},
                         [AGREEMENT_REPEATED] = {4e-5, 2e-4},
                         [AGREEMENT_PDF] = {4e-5, 2e-4},
                         [AGREEMENT_VISIBLE] = {3e-5, 1e-4},
                         [AGREEMENT_NDF] = {2e-5, 1e-4},
                         [AGREEMENT_AREA] = {2e-5, 3e-5},
                         [AGREEMENT_LAMBDA] = {5e-7, 1e-6},
                         [AGREEMENT_G1] = {1e-9, 1e-9},
                         [AGREEMENT_G2] = {1e-9, 1e-9},
                         [AGREEMENT_NORMAL] = {2e-5, 2e-3},
                         [AGREEMENT_MIXED] = {2e-5, 1e-4},
                         [AGREEMENT_MIXED_REPEATED] = {3e-5, 2e-4},
                         [AGREEMENT_MIXED_NORMAL] = {2e-4, 2.1}},
    [AGREEMENT_TURNED] = {[AGREEMENT_SAMPLED] = {3e-5, 1e-3},
                          [AGREEMENT_REPEATED] = {3e-5, 1e-3},
                          [AGREEMENT_PDF] = {3e-5, 1e-3},
                          [AGREEMENT_VISIBLE] = {3e-5, 2e-4},
                          [AGREEMENT_NDF] = {3e-5, 2e-4},
                          [AGREEMENT_AREA] = {2e-5, 5e-5},
                          [AGREEMENT_LAMBDA] = {2e-6, 1e-5},
                          [AGREEMENT_G1] = {3e-7, 1e-6},
                          [AGREEMENT_G2] = {4e-7, 1e-6},
                          [AGREEMENT_NORMAL] = {2e-5, 2e-3},
                          [AGREEMENT_MIXED] = {2e-5, 5e-4},
                          [AGREEMENT_MIXED_REPEATED] = {3e-5, 5e-4},
                          [AGREEMENT_MIXED_NORMAL] = {2e-4, 2.1}},
    [AGREEMENT_EDGES] = {[AGREEMENT_AREA] = {2e-5, 3e-5},
                         [AGREEMENT_LAMBDA] = {5e-7, 1e-6},
                         [AGREEMENT_G1] = {3e-7, 1e-6},
                         [AGREEMENT_G2] = {4e-7, 1e-6}},
};

static size_t judge_one(const agreement *a, int region, int id, double slack)
{
    double most_of = agreement_part(a, region, id, 0.999), all = agreement_part(a, region, id, 1);
    const limit *is = &limits[region][id];
    int bad = is->all > 0 && !(most_of <= slack * is->most_of && all <= slack * is->all);
    printf("%s   %-12s %.1e of 99.9%%, %.1e of all\n", bad ? "!" : " ", agreement_name(id), most_of, all);
    return (size_t)bad;
}

size_t agreement_judge(const agreement *a, const char *name, double slack)
{
    size_t bad = 0;
    for (int region = 0; region < AGREEMENT_REGIONS; region++) {
        printf("%s %s, %s: %zu answers, %zu refused\n", a->refused[region] ? "!" : " ", name,
               agreement_region_name(region), a->asked[region], a->refused[region]);
        bad += a->refused[region];
        for (int id = 0; id < AGREEMENT_COUNT; id++)
            if (limits[region][id].all > 0)
                bad += judge_one(a, region, id, slack);
    }
    return bad;
}
