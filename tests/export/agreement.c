/* What scripts ask about kernels that another program runs, and whether they answer as the library does:
 *
 *     vndf_agreement make WHAT COUNT QUESTIONS TABLE...
 *     vndf_agreement check WHAT BITS|ROUNDED|FAST QUESTIONS ANSWERS TABLE...
 *
 * The first writes questions, in turn about GGX, Beckmann and each table, the second judges answers.
 *
 * WHAT is `normals`, or the effects of a BSDF. Roughness is 0.02 to 1 on both axes, of BSDFs 0.05 to 1,
 * directions are of the whole sphere. Of eight questions one is of a matrix that turns, with a mean slope, one
 * of numbers at the edges of the unit square, one of a hard direction: exactly along z, next to it, at the
 * horizon. Answers in BITS, of an exported C without contracted products, are the library's, bit for bit;
 * ROUNDED ones, of other languages and of all BSDFs, whose library computes in double, and FAST ones, whose
 * compiler reorders sums, differ by no more than the limits below. No normal is turned away, not unit or below
 * the surface, no density is 0 or not finite, but straight from below; no scattered direction has a weight or
 * a density that is negative or not finite, and weight times density is f times the cosine. Exit status: 0
 * good, 1 not, 2 wrong use. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/random.h"
#include "export/effects.h"
#include "export/exported.h"
#include "vndf.h"

enum { SUBJECTS_MAX = 64, ANSWERS = sizeof(exported_answer) / sizeof(float) };

typedef struct subjects {
    const vndf_distribution *is[SUBJECTS_MAX];
    float base[SUBJECTS_MAX]; /* the first number of each */
    int count;
} subjects;

/* A record of the files of either kind; the answers of both are as many numbers. */
typedef union asked {
    exported_question normal;
    exported_hit hit;
} asked;
typedef union answered {
    float number[ANSWERS];
    exported_answer normal;
    exported_scattered hit;
} answered;

/* ---- questions ---- */

/* The distribution of a question. */
static const vndf_distribution *subject_of(const subjects *s, const exported_surface *of)
{
    int i = 0;
    while (i + 1 < s->count && s->base[i] != of->distribution)
        i++;
    return s->is[i];
}

static void put_direction(random_stream *stream, size_t index, float wi[3])
{
    static const double hard[] = {1, 1 - 1e-7, 1e-3, 1e-7, 0, -1e-7, -1e-3, -0.64};
    double z = index % 8 == 5 ? hard[index / 8 % 8] : 2 * random_double(stream) - 1, s = sqrt(1 - z * z);
    double phi = index % 16 == 5 ? 0 : 6.283185307179586 * random_double(stream);
    wi[0] = (float)(s * cos(phi));
    wi[1] = (float)(s * sin(phi));
    wi[2] = (float)z;
}

static void turn(random_stream *stream, exported_surface *m)
{
    double a = 6.283185307179586 * random_double(stream), x = (double)m->xx, y = (double)m->yy;
    m->xx = (float)(cos(a) * x);
    m->xy = (float)(-sin(a) * y);
    m->yx = (float)(sin(a) * x);
    m->yy = (float)(cos(a) * y);
    m->mean_x = random_float(stream) - 0.5f;
    m->mean_y = random_float(stream) - 0.5f;
}

static exported_question question(const subjects *s, size_t index)
{
    static const float edges[] = {0.0f, 0x1p-24f, 1 - 0x1p-24f, 1.0f};
    random_stream stream = random_from(1000003u + index);
    exported_question q = {.of.distribution = s->base[index % (size_t)s->count]};
    q.of.xx = 0.02f * powf(50.0f, random_float(&stream));
    q.of.yy = 0.02f * powf(50.0f, random_float(&stream));
    index /= (size_t)s->count;
    put_direction(&stream, index, q.wi);
    q.u1 = random_float(&stream);
    q.u2 = random_float(&stream);
    if (index % 8 == 3)
        turn(&stream, &q.of);
    if (index % 8 == 7) {
        q.u1 = edges[index / 8 % 4];
        q.u2 = index / 32 % 2 ? edges[index / 64 % 4] : q.u2;
    }
    return q;
}

/* The library's material of a question; without a mean slope where its effects have none. */
static vndf_material material_of(const subjects *s, const char *text, exported_hit *q)
{
    char why[EFFECTS_ERROR_MAX];
    export_effects chosen;
    vndf_description is = {.affine = {NULL, q->of.xx, q->of.xy, q->of.yx, q->of.yy, q->of.mean_x, q->of.mean_y},
                           .eta = EXPORTED_ETA,
                           .f0 = EXPORTED_F0,
                           .conductor_eta = EXPORTED_CONDUCTOR_ETA,
                           .conductor_k = EXPORTED_CONDUCTOR_K};
    vndf_material material;
    if (!effects_read(&chosen, text, why)) {
        fprintf(stderr, "%s\n", why);
        exit(2);
    }
    is.distribution = subject_of(s, &q->of);
    is.effects = effects_of(&chosen);
    is.effects.shape = VNDF_SHAPE_AFFINE;
    if (vndf_material_resolve(&is, &material, NULL) == VNDF_OK)
        return material;
    is.effects.shape = VNDF_SHAPE_MATRIX;
    q->of.mean_x = q->of.mean_y = 0;
    if (vndf_material_resolve(&is, &material, NULL) != VNDF_OK)
        exit(2);
    return material;
}

static exported_hit hit_of(const subjects *s, size_t index, const char *effects)
{
    random_stream stream = random_from(2000003u + index);
    exported_hit q = {.of.distribution = s->base[index % (size_t)s->count]};
    q.of.xx = 0.05f * powf(20.0f, random_float(&stream));
    q.of.yy = 0.05f * powf(20.0f, random_float(&stream));
    index /= (size_t)s->count;
    put_direction(&stream, index, q.wi);
    put_direction(&stream, index + 4, q.wo);
    for (int i = 0; i < 3; i++)
        q.u[i] = random_float(&stream);
    if (index % 4 == 3)
        turn(&stream, &q.of);
    material_of(s, effects, &q);
    return q;
}

/* `effects` is NULL for normals, here and below. */
static int make(const subjects *s, const char *effects, size_t count, const char *file)
{
    FILE *to = fopen(file, "wb");
    for (size_t i = 0; to && i < count; i++) {
        asked q;
        if (effects)
            q.hit = hit_of(s, i, effects);
        else
            q.normal = question(s, i);
        if (fwrite(&q, effects ? sizeof q.hit : sizeof q.normal, 1, to) != 1)
            return 2;
    }
    return to && fclose(to) == 0 ? 0 : 2;
}

/* ---- answers ---- */

static void put(float to[3], vndf_vec3 v)
{
    to[0] = v.x;
    to[1] = v.y;
    to[2] = v.z;
}

static vndf_vec3 vector(const float v[3])
{
    const vndf_vec3 w = {v[0], v[1], v[2]};
    return w;
}

/* The library's; densities are of the normals that the kernel drew. */
static exported_answer answer_of(const subjects *s, const exported_question *q, const exported_answer *given)
{
    vndf_affine m = {subject_of(s, &q->of), q->of.xx, q->of.xy, q->of.yx, q->of.yy, q->of.mean_x, q->of.mean_y};
    vndf_vec3 wi = vector(q->wi), wm = vector(given->wm);
    exported_answer a;
    vndf_view view = vndf_affine_view_from(&m, wi);
    put(a.wm, vndf_sample(&view, q->u1, q->u2, &a.sampled));
    a.pdf = vndf_pdf(&view, wm);
    a.visible = vndf_visible(&view, wm);
    a.ndf = vndf_affine_ndf(&m, wm);
    a.lambda = vndf_affine_lambda(&m, wi);
    a.g1 = vndf_affine_g1(&m, wi);
    a.g2 = vndf_affine_g2(&m, wi, wm, VNDF_G2_HEIGHT_CORRELATED);
    a.area = vndf_affine_projected_area(&m, wi);
    vndf_mixture mixture = {.count = 2, .lobe = {{m, 0.6f}, {{vndf_ggx(), 0.3f, 0, 0, 0.3f, 0, 0}, 0.4f}}};
    vndf_mixture_view lobes = vndf_mixture_view_from(&mixture, wi);
    put(a.mixed, vndf_mixture_sample(&lobes, q->u1, q->u2, &a.mixed_sampled, NULL));
    a.mixed_pdf = vndf_mixture_pdf(&lobes, vector(given->mixed));
    return a;
}

static int is_refused(const exported_question *q, const float wm[3], float pdf)
{
    double square = 0, facing = 0;
    for (int i = 0; i < 3; i++) {
        square += (double)wm[i] * (double)wm[i];
        facing += (double)wm[i] * (double)q->wi[i];
    }
    int blind = q->wi[0] == 0 && q->wi[1] == 0 && q->wi[2] < 0;
    return !(fabs(square - 1) < 1e-6 && wm[2] >= 0 && (blind || (facing > -1.5e-7 && pdf > 0 && pdf <= FLT_MAX)));
}

/* What 99% and 99.9% of the answers may differ by: of their numbers first to last, absolutely (1), as shares of 1 + the
 * number (2), or relatively (0). */
typedef struct limit {
    const char *name;
    int first, last, is_absolute;
    double most_of, nearly_all;
} limit;

/* What 99% and 99.9% of the answers but those at the edges of the unit square, the rims of the visible normals, may
 * differ by: components of normals, shares of 1 + |Lambda| and G absolutely, the others relatively. The last thousandth
 * has the rim of the visible normals, where a rounding moves much. */
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

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static int judge(const limit *l, double *off, size_t count, double slack)
{
    qsort(off, count, sizeof *off, ascending);
    double most_of = off[count * 99 / 100], nearly_all = off[count * 999 / 1000];
    int bad = !(most_of <= slack * l->most_of && nearly_all <= slack * l->nearly_all);
    printf("%s %-12s %.1e of 99%%, %.1e of 99.9%%, %.1e of all\n", bad ? "!" : " ", l->name, most_of, nearly_all,
           off[count - 1]);
    return bad;
}

/* ---- BSDFs ---- */

/* The library's; of the direction that the kernel drew f and density. */
static exported_scattered scattered_of(const vndf_bsdf *b, const exported_hit *q, const exported_scattered *given)
{
    exported_scattered a = {.lobe = 0};
    vndf_scattered s;
    float f[VNDF_WAVELENGTHS];
    vndf_bsdf_sample(b, q->u, &s);
    put(a.wo, s.wo);
    memcpy(a.weight, s.weight, sizeof a.weight);
    a.sampled = s.density;
    a.lobe = (float)s.lobe;
    vndf_bsdf_eval_pdf(b, vector(q->wo), 0, f, &a.pdf);
    memcpy(a.f, f, sizeof a.f);
    vndf_bsdf_eval_pdf(b, vector(given->wo), 0, f, &a.own_pdf);
    memcpy(a.own_f, f, sizeof a.own_f);
    return a;
}

static int is_bad_scattering(const exported_scattered *a)
{
    double square = 0;
    int bad = !(a->sampled >= 0 && a->sampled <= FLT_MAX) || (a->lobe > 0) != (a->sampled > 0);
    for (int i = 0; i < 3; i++) {
        square += (double)a->wo[i] * (double)a->wo[i];
        bad |= !(a->weight[i] >= 0 && a->weight[i] <= FLT_MAX && a->f[i] >= 0 && a->f[i] <= FLT_MAX);
    }
    return bad || !(fabs(square - 1) < 3e-6) || !(a->pdf >= 0 && a->pdf <= FLT_MAX);
}

/* Samples whose lobe is another than the library's, by a rounding of F or of a horizon, have no other limit.
 * Beside total reflection 1 - F hangs on the last digits of directions. */
static const limit SCATTERED[] = {
    {"lobe", 7, 7, 1, 0, 1},
    {"wo", 0, 2, 1, 1e-6, 1e-5},
    {"weight", 3, 5, 2, 5e-6, 1e-4},
    {"its density", 6, 6, 0, 2e-5, 1e-4},
    {"f", 8, 10, 0, 1e-4, 5e-3},
    {"pdf", 11, 11, 0, 1e-4, 5e-3},
    {"f of wo", 12, 14, 0, 1e-4, 5e-3},
    {"pdf of wo", 15, 15, 0, 1e-4, 5e-3},
    {"f cos = weight density", 0, 0, 0, 1e-4, 5e-3},
};

/* f cos over weight times density, less 1, of the kernel's own numbers. */
static double inconsistency(const vndf_bsdf *b, const exported_scattered *a)
{
    double most = 0, cosine = fabs((double)vndf_bsdf_cosine(b, vector(a->wo)));
    for (int i = 0; i < 3; i++) {
        double there = (double)a->own_f[i] * cosine, here = (double)a->weight[i] * (double)a->sampled;
        most = fmax(most, fmax(there, here) > 1e-20 ? fabs(there - here) / fmax(there, here) : 0);
    }
    return most;
}

/* ---- judgement ---- */

/* What an answer differs by in each limit, from edges of the unit square on (-1: not judged); whether it is refused. */
static int compare_normal(const subjects *s, const exported_question *q, const answered *a, double *off,
                          int *other_bits)
{
    const answered own = {.normal = answer_of(s, q, &a->normal)};
    int at_edge = q->u1 < 1e-6f || q->u1 > 1 - 1e-6f || q->u2 < 1e-6f || q->u2 > 1 - 1e-6f;
    for (size_t i = 0; i < sizeof NORMALS / sizeof *NORMALS; i++)
        off[i] = at_edge ? -1 : difference(&NORMALS[i], a->number, own.number);
    *other_bits = memcmp(a, &own, sizeof own) != 0;
    return is_refused(q, a->normal.wm, a->normal.sampled) ||
           is_refused(q, a->normal.mixed, a->normal.mixed_sampled);
}

static int compare_hit(const subjects *s, const char *effects, exported_hit *q, const answered *a, double *off,
                       int *kept)
{
    vndf_material material = material_of(s, effects, q);
    vndf_bsdf b;
    int there = vndf_bsdf_at(&b, &material, vector(q->wi)), last = sizeof SCATTERED / sizeof *SCATTERED - 1;
    const answered own = {.hit = scattered_of(&b, q, &a->hit)};
    for (int i = 0; i < last; i++)
        off[i] =
            own.hit.lobe != a->hit.lobe && i > 0 && i < 4 ? 0 : difference(&SCATTERED[i], a->number, own.number);
    off[last] = a->hit.lobe > 0 && a->hit.lobe < 3 ? inconsistency(&b, &a->hit) : 0;
    *kept = there && a->hit.lobe > 0;
    return is_bad_scattering(&a->hit);
}

static int check(const subjects *s, const char *effects, const char *how, const char *questions,
                 const char *answers)
{
    enum { MOST = 1 << 16, LIMITS = 16 };
    static double off[LIMITS][MOST];
    const limit *limits = effects ? SCATTERED : NORMALS;
    size_t limit_count = effects ? sizeof SCATTERED / sizeof *SCATTERED : sizeof NORMALS / sizeof *NORMALS;
    FILE *asked_from = fopen(questions, "rb"), *said = fopen(answers, "rb");
    asked q;
    answered a;
    size_t count = 0, judged = 0, refused = 0, marked = 0;
    int bad = 0, mark;
    while (asked_from && said && judged < MOST &&
           fread(&q, effects ? sizeof q.hit : sizeof q.normal, 1, asked_from) == 1 &&
           fread(&a, sizeof a, 1, said) == 1) {
        double here[LIMITS];
        refused += (size_t)(effects ? compare_hit(s, effects, &q.hit, &a, here, &mark)
                                    : compare_normal(s, &q.normal, &a, here, &mark));
        for (size_t i = 0; i < limit_count; i++)
            off[i][judged] = here[i];
        marked += (size_t)mark;
        judged += here[0] >= 0;
        count++;
    }
    printf("%s: %zu answers, %zu refused, %zu %s\n", effects ? effects : "normals", count, refused, marked,
           effects ? "scattered" : "with other bits than the library's");
    for (size_t i = 0; judged && i < limit_count; i++)
        bad += judge(&limits[i], off[i], judged, strcmp(how, "FAST") == 0 ? 10 : 1);
    return !count || bad || refused || (effects ? marked < count / 4 : strcmp(how, "BITS") == 0 && marked);
}

/* ---- the program ---- */

static int load(subjects *s, char **files, int count)
{
    size_t base = 0;
    s->is[0] = vndf_ggx();
    s->is[1] = vndf_beckmann();
    s->base[0] = -1.0f;
    s->base[1] = -2.0f;
    for (s->count = 2; s->count < count + 2 && s->count < SUBJECTS_MAX; s->count++) {
        vndf_error error = {VNDF_OK, ""};
        s->is[s->count] = vndf_load(files[s->count - 2], &error);
        s->base[s->count] = (float)base;
        if (!s->is[s->count]) {
            fprintf(stderr, "%s: %s\n", files[s->count - 2], error.message);
            return 0;
        }
        base += vndf_numbers(s->is[s->count], NULL, 0);
    }
    return 1;
}

int main(int argc, char **argv)
{
    subjects s;
    const char *effects = argc > 2 && strcmp(argv[2], "normals") != 0 ? argv[2] : NULL;
    if (argc >= 5 && strcmp(argv[1], "make") == 0 && load(&s, argv + 5, argc - 5))
        return make(&s, effects, strtoul(argv[3], NULL, 10), argv[4]);
    if (argc >= 6 && strcmp(argv[1], "check") == 0 && load(&s, argv + 6, argc - 6))
        return check(&s, effects, argv[3], argv[4], argv[5]);
    return 2;
}
