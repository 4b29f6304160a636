/* Linearly transformed cosines. A texel is fitted, by a search, to the numbers of M,
 *
 *     M = (X Y Z) (a d c; 0 b e; 0 0 1),
 *
 * Z the mean direction of the reflected light, Y across the plane of Z and the normal, for the least integral of
 * |f cos/E - density|^3, by samples of both. Of isotropic roughness that plane is wi's, and d = e = 0; with alpha_x and
 * alpha_y that differ all five are fitted (KT, Heitz, Dupuy & Narayanan, "Bringing Linearly Transformed Cosines to
 * Anisotropic GGX", 2022). Neighbours begin where the last one ended. */
#include <math.h>
#include <string.h>

#include "bake/bake.h"

enum { SIDE = 20, SAMPLES = SIDE * SIDE, NUMBERS = 5, TURNS = 60 };

static const double FINEST = 1e-3; /* step of a search */

/* What a texel is fitted to: samples of the BSDF with the f cos that they were drawn with, and room for those of the
 * cosine. */
typedef struct target {
    vndf_material material;
    bake_points drawn;
    float cosines[SAMPLES]; /* f cos of the samples */
    float other[3][SAMPLES], other_density[SAMPLES], other_value[2][SAMPLES];
    bake_sum sum;
    double frame[3][3]; /* X, Y, Z */
    int numbers;        /* that are fitted: log a, log b, c, and unless wi is along an axis d, e */
    double wrong;       /* half the integral of |f cos/E - density|, of the numbers that error_of saw last */
} target;

/* ---- the transformed cosine ---- */

/* M of the numbers, by rows. A cosine may be turned about its axis: it is turned until its y is Y's azimuth, so that
 * the matrices of neighbours are near each other, and their middle number is not 0. */
static void matrix_of(const target *t, const double p[NUMBERS], double m[3][3])
{
    const double a = exp(p[0]), b = exp(p[1]), c = p[2], d = p[3], e = p[4];
    const double x = t->frame[1][0], y = t->frame[1][1];
    const double inner[3][3] = {{a * y + d * x, d * y - a * x, c}, {b * x, b * y, e}, {0, 0, 1}};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            m[i][k] = 0;
            for (int n = 0; n < 3; n++)
                m[i][k] += t->frame[n][i] * inner[n][k];
        }
}

static void cross(const double a[3], const double b[3], double c[3])
{
    for (int i = 0; i < 3; i++)
        c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* Its inverse over the middle number, which leaves directions as they are: columns are products of rows. */
static bake_cosine inverse_of(double m[3][3])
{
    double column[3][3];
    bake_cosine c;
    for (int i = 0; i < 3; i++)
        cross(m[(i + 1) % 3], m[(i + 2) % 3], column[i]);
    for (int i = 0; i < 9; i++)
        c.inverse[i / 3][i % 3] = column[i % 3][i / 3] / column[1][1];
    return c;
}

double bake_cosine_density(const bake_cosine *c, const double wo[3])
{
    double w[3], yz[3], square = 0, det = 0;
    cross(c->inverse[1], c->inverse[2], yz);
    for (int i = 0; i < 3; i++) {
        w[i] = c->inverse[i][0] * wo[0] + c->inverse[i][1] * wo[1] + c->inverse[i][2] * wo[2];
        square += w[i] * w[i];
        det += c->inverse[0][i] * yz[i];
    }
    return w[2] > 0 && wo[2] > 0 ? w[2] * fabs(det) / (3.14159265358979 * square * square) : 0;
}

/* ---- one texel ---- */

/* Adds what one set of samples finds: f cos of these directions, drawn with these densities. */
static double mean_cube(target *t, const bake_cosine *c, float *const wo[3], const float *cosines,
                        const float *density)
{
    double sum = 0;
    for (int i = 0; i < SAMPLES; i++) {
        const double w[3] = {(double)wo[0][i], (double)wo[1][i], (double)wo[2][i]};
        double g = bake_cosine_density(c, w), f = fmax((double)cosines[i], 0) / t->sum.all;
        double miss = fabs(f - g), p = (double)density[i] + g;
        if (!(p > 0) || !(w[2] > 0))
            continue;
        sum += miss * miss * miss / p;
        t->wrong += miss / p / (2 * SAMPLES);
    }
    return sum / SAMPLES;
}

/* The mean cube of the difference with these numbers. */
static double error_of(target *t, const double p[NUMBERS])
{
    double m[3][3];
    matrix_of(t, p, m);
    const bake_cosine c = inverse_of(m);
    const vndf_bsdf_batch batch = bake_batch(&t->material, t->drawn.wi, SAMPLES);
    const vndf_normals other = {t->other[0], t->other[1], t->other[2]};
    float *const value[2] = {t->other_value[0], t->other_value[1]};
    for (int i = 0; i < SAMPLES; i++) {
        double r = sqrt((double)t->drawn.u[0][i]), phi = 6.28318530717959 * (double)t->drawn.u[1][i];
        const double cosine[3] = {r * cos(phi), r * sin(phi), sqrt(1 - r * r)};
        double w[3], length = 0;
        for (int k = 0; k < 3; k++) {
            w[k] = m[k][0] * cosine[0] + m[k][1] * cosine[1] + m[k][2] * cosine[2];
            length += w[k] * w[k];
        }
        length = sqrt(length);
        for (int k = 0; k < 3; k++)
            t->other[k][i] = (float)(w[k] / length);
    }
    vndf_bsdf_eval_pdf_n(&batch, other, NULL, value, t->other_density);
    for (int i = 0; i < SAMPLES; i++)
        t->other_value[0][i] *= t->other[2][i];
    float *const from[3] = {t->drawn.wo[0], t->drawn.wo[1], t->drawn.wo[2]};
    float *const to[3] = {t->other[0], t->other[1], t->other[2]};
    t->wrong = 0;
    return mean_cube(t, &c, from, t->cosines, t->drawn.density) +
           mean_cube(t, &c, to, t->other_value[0], t->other_density);
}

/* Samples, E and the frame for light from wi. */
static int target_of(target *t, const bake_settings *s, const float alpha[2], const double wi[3])
{
    vndf_description of = bake_mirror(s, alpha[0]);
    bake_points *p = &t->drawn;
    vndf_error error;
    double mean[3] = {0, 0, 0}, length = 0;
    for (int i = 0; i < SAMPLES; i++) {
        p->u[0][i] = ((float)(i % SIDE) + 0.5f) / SIDE;
        p->u[1][i] = ((float)(i / SIDE) + 0.5f) / SIDE;
        p->u[2][i] = 0.5f;
    }
    of.surface.yy = alpha[1];
    if (vndf_material_resolve(&of, &t->material, &error) != VNDF_OK)
        return 0;
    bake_sample(&t->material, wi, SAMPLES, p);
    /* f cos as it was drawn: that of a rounded direction differs on smooth surfaces. */
    for (int i = 0; i < SAMPLES; i++) {
        if (p->lobe[i] == VNDF_LOBE_NONE)
            p->wo[2][i] = -1; /* lost */
        t->cosines[i] = p->weight[0][i] * p->density[i];
        for (int k = 0; k < 3; k++)
            mean[k] += (double)p->weight[0][i] * (double)p->wo[k][i];
    }
    t->sum = bake_mean(&of, wi, BAKE_SIDE, 0);
    t->numbers = fabs(wi[0]) < 1e-9 || wi[1] == 0 ? 3 : NUMBERS;
    for (int k = 0; k < 2; k++)
        if (fabs(wi[k]) < 1e-9) /* what is symmetric is kept so */
            mean[k] = 0;
    for (int k = 0; k < 3; k++)
        length += mean[k] * mean[k];
    double across = hypot(mean[0], mean[1]);
    const double y[3] = {across > 0 ? mean[1] / across : 0, across > 0 ? -mean[0] / across : 1, 0};
    for (int k = 0; k < 3; k++) {
        t->frame[1][k] = y[k];
        t->frame[2][k] = mean[k] / sqrt(length);
    }
    cross(t->frame[1], t->frame[2], t->frame[0]);
    return t->sum.all > 0 && mean[2] > 0;
}

/* Moves p to where the error is least nearby, by the pattern search of Hooke & Jeeves (1961): steps of each number,
 * then as far again as all of them went; the step is halved where none helps. c, d and e are slopes, and looked at in
 * parts of the width of the lobe. */
static void minimise(target *t, double p[NUMBERS], double step)
{
    double least = error_of(t, p), before[NUMBERS], next[NUMBERS];
    for (int turn = 0; turn < TURNS && step > FINEST; turn++) {
        const double from = least;
        memcpy(before, p, sizeof before);
        for (int i = 0; i <= 2 * t->numbers; i++) {
            const double wide = (i % 2 ? -step : step) * (i / 2 < 2 ? 1 : 2 * exp(p[0]));
            for (int k = 0; k < NUMBERS; k++)
                next[k] = i == 2 * t->numbers ? 2 * p[k] - before[k] : p[k] + (k == i / 2 ? wide : 0);
            const double error = error_of(t, next);
            if (error < least) {
                least = error;
                memcpy(p, next, sizeof next);
            }
        }
        step = least < from * (1 - 1e-4) ? step : step / 2;
    }
}

/* ---- the tables ---- */

/* A table: which of the twelve numbers of a texel its channels are, rows of the inverse over its middle number, behind
 * these E of F = 1, its part by (1 - cos)^5, and the error. */
typedef struct part {
    const char *name, *holds;
    int channels, number[4];
} part;

/* Tables of n roughnesses, `ratios` of alpha_y over alpha_x, n cosines and as many azimuths as ratios. Rougher first,
 * from straight above to grazing: what is smooth is the easiest, and begins what follows. The first direction of a
 * surface begins the next one; the first of a cosine, along x, the next cosine. */
static int fit_all(const bake_settings *s, baked_list *list, const part *parts, int tables,
                   const char *const *axis, size_t n, size_t ratios)
{
    static target t;
    const size_t surfaces = n * ratios, all = surfaces * n * ratios, count[] = {ratios > 1 ? surfaces : n, n, n};
    double p[NUMBERS] = {0}, of_surface[NUMBERS] = {0}, along_x[NUMBERS] = {0}, other[NUMBERS], m[3][3];
    baked *b = list->table + list->count;
    for (int k = 0; k < tables; k++)
        if (!baked_add(list, parts[k].name, parts[k].holds, ratios > 1 ? 3 : 2, axis, count, parts[k].channels))
            return 0;
    for (size_t done = 0; done < all; done++) {
        const size_t phi = done % ratios, theta = done / ratios % n, surface = surfaces - 1 - done / (ratios * n);
        const float alpha = bake_alpha(s->mapping, (double)(surface / ratios) / (double)(n - 1));
        const float alphas[2] = {alpha, fmaxf(alpha * (float)(surface % ratios + 1) / (float)ratios, 1e-3f)};
        const double v = (double)theta / (double)(n - 1); /* cosines are dense at grazing incidence */
        const double c = fmax(1 - v * v, 2e-3), r = sqrt(1 - c * c);
        const double turn = phi ? 1.5707963267949 * (double)phi / (double)(ratios - 1) : 0;
        const double wi[3] = {r * cos(turn), r * sin(turn), c};
        if (!target_of(&t, s, alphas, wi) || progress_show((double)done / (double)all, parts->name, s->progress))
            return 0;
        if (phi == 0)
            memcpy(p, theta ? along_x : of_surface, sizeof p);
        if (theta == 0)
            p[2] = 0;
        if (t.numbers == 3) /* the cosine is symmetric */
            p[3] = p[4] = 0;
        minimise(&t, p, done ? 0.1 : 0.3);
        error_of(&t, p);
        if (ratios > 1 && t.wrong >= 0.3) { /* a bad place: once more from the one along x, and farther */
            const double wrong = t.wrong;
            memcpy(other, along_x, sizeof other);
            minimise(&t, other, 0.4);
            error_of(&t, other);
            if (t.wrong < wrong)
                memcpy(p, other, sizeof p);
            error_of(&t, p);
        }
        if (phi == 0)
            memcpy(along_x, p, sizeof p);
        if (phi == 0 && theta == 0)
            memcpy(of_surface, p, sizeof p);
        matrix_of(&t, p, m);
        const bake_cosine found = inverse_of(m);
        const double more[3] = {t.sum.all, t.sum.grazing, t.wrong};
        const size_t at = ratios > 1 ? (surface * n + theta) * n + phi : theta * n + surface;
        for (int k = 0; k < tables; k++) {
            for (int i = 0; i < parts[k].channels; i++) {
                const int row = parts[k].number[i] / 4, column = parts[k].number[i] % 4;
                b[k].value[at * (size_t)parts[k].channels + (size_t)i] =
                    (float)(column < 3 ? found.inverse[row][column] : more[row]);
            }
            b[k].error = "half the integral of |f cos/E - density| over all texels";
            b[k].worst = fmax(b[k].worst, t.wrong);
            b[k].mean += t.wrong / (double)all;
        }
    }
    return 1;
}

int bake_ltc(const bake_settings *s, baked_list *list)
{
    static const part parts[] = {
        {"ltc_inverse",
         "the inverse of M over its middle number: xx, zx, xz, zz, as mat3(xx,0,zx, 0,1,0, xz,0,zz)",
         4,
         {0, 8, 2, 10}},
        {"ltc_norm",
         "E of F = 1, its part by (1 - cos)^5, and the error: half the integral of |f cos/E - density|",
         3,
         {3, 7, 11}},
    };
    static const char *const axis[] = {"cosine: 1 - (i/(n - 1))^2", "roughness: i/(n - 1)"};
    return fit_all(s, list, parts, 2, axis, s->size, 1);
}

int bake_anisotropic(const bake_settings *s, baked_list *list)
{
    static const part parts[] = {
        {"ltc_anisotropic_x", "row x of the inverse of M over its middle number, and E of F = 1", 4, {0, 1, 2, 3}},
        {"ltc_anisotropic_y", "row y of it, and the part of E by (1 - cos)^5", 4, {4, 5, 6, 7}},
        {"ltc_anisotropic_z",
         "row z of it, and the error: half the integral of |f cos/E - density|",
         4,
         {8, 9, 10, 11}},
    };
    static const char *const axis[] = {"n i + j: roughness of alpha_x i/(n - 1), alpha_y/alpha_x (j + 1)/n",
                                       "cosine: 1 - (i/(n - 1))^2", "azimuth from x: pi/2 i/(n - 1)"};
    const size_t n = s->size < BAKE_ANISOTROPIC ? s->size : BAKE_ANISOTROPIC;
    return fit_all(s, list, parts, 3, axis, n, n);
}
