/* What scripts ask about kernels that another program runs, and whether they answer as the library does:
 *
 *     vndf_agreement make COUNT QUESTIONS TABLE...               writes questions, in turn about GGX, Beckmann, each
 *     table vndf_agreement check BITS|ROUNDED|FAST QUESTIONS ANSWERS TABLE...   judges answers
 *
 * Roughness is 0.02 to 1 on both axes, directions are of the whole sphere. Of eight questions one is of a matrix that
 * turns, with a mean slope, one of numbers at the edges of the unit square, one of a hard direction: exactly along z,
 * next to it, at the horizon. Answers in BITS, of an exported C without contracted products, are the library's, bit for
 * bit; ROUNDED ones, of other languages, and FAST ones, whose compiler reorders sums, differ by no more
 * than the limits below. No normal is turned away, not unit or below the surface, no density is 0 or not finite, but
 * straight from below. Exit status: 0 good, 1 not, 2 wrong use. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "agreement.h"

enum { ANSWERS = sizeof(exported_answer) / sizeof(float) };

/* ---- questions ---- */

void put_direction(random_stream *stream, size_t index, float wi[3])
{
    static const double hard[] = {1, 1 - 1e-7, 1e-3, 1e-7, 0, -1e-7, -1e-3, -0.64};
    double z = index % 8 == 5 ? hard[index / 8 % 8] : 2 * random_double(stream) - 1, s = sqrt(1 - z * z);
    double phi = index % 16 == 5 ? 0 : 6.283185307179586 * random_double(stream);
    wi[0] = (float)(s * cos(phi));
    wi[1] = (float)(s * sin(phi));
    wi[2] = (float)z;
}

void turn(random_stream *stream, exported_surface *m)
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

static int make(const subjects *s, size_t count, const char *file)
{
    FILE *to = fopen(file, "wb");
    for (size_t i = 0; to && i < count; i++) {
        exported_question q = question(s, i);
        if (fwrite(&q, sizeof q, 1, to) != 1)
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

/* The library's; densities are of the normals that the kernel drew. */
static exported_answer answer_of(const subjects *s, const exported_question *q, const exported_answer *given)
{
    vndf_affine m = {NULL, q->of.xx, q->of.xy, q->of.yx, q->of.yy, q->of.mean_x, q->of.mean_y};
    vndf_vec3 wi = {q->wi[0], q->wi[1], q->wi[2]}, wm = {given->wm[0], given->wm[1], given->wm[2]};
    vndf_vec3 mixed = {given->mixed[0], given->mixed[1], given->mixed[2]};
    exported_answer a;
    for (int i = 0; i < s->count; i++)
        if (s->base[i] == q->of.distribution)
            m.distribution = s->is[i];
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
    a.mixed_pdf = vndf_mixture_pdf(&lobes, mixed);
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

/* What 99% and 99.9% of the answers but those at the edges of the unit square, the rims of the visible normals, may
 * differ by: components of normals, shares of 1 + |Lambda| and G absolutely, the others relatively. The last thousandth
 * has the rim of the visible normals, where a rounding moves much. */
static const limit LIMITS[] = {
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
enum { LIMITS_COUNT = sizeof LIMITS / sizeof LIMITS[0] };

double difference(const limit *l, const float *a, const float *b)
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

int judge(const limit *l, double *off, size_t count, double slack)
{
    qsort(off, count, sizeof *off, ascending);
    double most_of = off[count * 99 / 100], nearly_all = off[count * 999 / 1000];
    int bad = !(most_of <= slack * l->most_of && nearly_all <= slack * l->nearly_all);
    printf("%s %-12s %.1e of 99%%, %.1e of 99.9%%, %.1e of all\n", bad ? "!" : " ", l->name, most_of, nearly_all,
           off[count - 1]);
    return bad;
}

static int check(const subjects *s, const char *how, const char *questions, const char *answers)
{
    FILE *asked = fopen(questions, "rb"), *said = fopen(answers, "rb");
    exported_question q;
    exported_answer a;
    size_t count = 0, inner = 0, room = 0, refused = 0, other_bits = 0;
    double *off[LIMITS_COUNT] = {NULL};
    int bad = 0;
    if (!asked || !said)
        return 2;
    while (fread(&q, sizeof q, 1, asked) == 1 && fread(&a, sizeof a, 1, said) == 1) {
        exported_answer own = answer_of(s, &q, &a);
        if (inner == room) {
            room = 2 * room + 1024;
            for (int i = 0; i < LIMITS_COUNT; i++)
                if (!(off[i] = realloc(off[i], room * sizeof(double))))
                    return 2;
        }
        int at_edge = q.u1 < 1e-6f || q.u1 > 1 - 1e-6f || q.u2 < 1e-6f || q.u2 > 1 - 1e-6f;
        for (int i = 0; i < LIMITS_COUNT; i++)
            off[i][inner] = difference(&LIMITS[i], (const float *)&a, (const float *)&own);
        int differs = 0;
        for (int i = 0; i < ANSWERS; i++)
            differs |= memcmp((const float *)&a + i, (const float *)&own + i, sizeof(float)) != 0;
        other_bits += (size_t)differs;
        refused += (size_t)(is_refused(&q, a.wm, a.sampled) || is_refused(&q, a.mixed, a.mixed_sampled));
        count++;
        inner += !at_edge;
    }
    printf("%zu answers, %zu refused, %zu with other bits than the library's\n", count, refused, other_bits);
    for (int i = 0; inner && i < LIMITS_COUNT; i++)
        bad += judge(&LIMITS[i], off[i], inner, strcmp(how, "FAST") == 0 ? 10 : 1);
    return !count || bad || refused || (strcmp(how, "BITS") == 0 && other_bits);
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
    if (argc >= 4 && strcmp(argv[1], "make") == 0 && load(&s, argv + 4, argc - 4))
        return make(&s, strtoul(argv[2], NULL, 10), argv[3]);
    if (argc >= 5 && strcmp(argv[1], "check") == 0 && load(&s, argv + 5, argc - 5))
        return check(&s, argv[2], argv[3], argv[4]);
    if (argc >= 5 && strcmp(argv[1], "make-bsdf") == 0 && load(&s, argv + 5, argc - 5))
        return make_of_bsdf(&s, strtoul(argv[2], NULL, 10), argv[3], argv[4]);
    if (argc >= 5 && strcmp(argv[1], "check-bsdf") == 0 && load(&s, argv + 5, argc - 5))
        return check_of_bsdf(&s, argv[2], argv[3], argv[4]);
    return 2;
}
