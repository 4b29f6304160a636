/* Linearly transformed cosines. A texel is fitted by the simplex method of Nelder & Mead (1965) to three numbers of M,
 *
 *     M = (X Y Z) (a 0 c; 0 b 0; 0 0 1),       Z the mean direction of the reflected light, Y across the plane of it,
 *
 * for the least integral of |f cos/E - density|^3, by samples of both. Neighbours begin where the last one ended. */
#include <math.h>
#include <string.h>

#include "bake/bake.h"

enum { SIDE = 20, SAMPLES = SIDE * SIDE };

/* What a texel is fitted to: samples of the BSDF with the f cos that they were drawn with, and room for those of the
 * cosine. */
typedef struct target {
    vndf_material material;
    bake_points drawn;
    float cosines[SAMPLES]; /* f cos of the samples */
    float other[3][SAMPLES], other_density[SAMPLES], other_value[2][SAMPLES];
    bake_sum sum;
    double x, z;  /* the mean direction */
    double wrong; /* half the integral of |f cos/E - density|, of the numbers that error_of saw last */
} target;

/* ---- the transformed cosine ---- */

/* M of the numbers (log a, log b, c), by rows. */
static void matrix_of(const target *t, const double p[3], double m[3][3])
{
    double a = exp(p[0]), b = exp(p[1]), c = p[2];
    const double rows[3][3] = {{t->z * a, 0, t->z * c + t->x}, {0, b, 0}, {-t->x * a, 0, t->z - t->x * c}};
    memcpy(m, rows, sizeof rows);
}

/* Its inverse over the middle number, which leaves directions as they are. */
static bake_cosine inverse_of(double m[3][3])
{
    double det = m[0][0] * m[2][2] - m[0][2] * m[2][0], y = m[1][1];
    bake_cosine c = {{m[2][2] / det * y, -m[0][2] / det * y, 1, -m[2][0] / det * y, m[0][0] / det * y}};
    return c;
}

double bake_cosine_density(const bake_cosine *c, const double wo[3])
{
    const double *k = c->inverse;
    double x = k[0] * wo[0] + k[1] * wo[2], y = k[2] * wo[1], z = k[3] * wo[0] + k[4] * wo[2];
    double square = x * x + y * y + z * z, det = fabs(k[2] * (k[0] * k[4] - k[1] * k[3]));
    return z > 0 && wo[2] > 0 ? z * det / (3.14159265358979 * square * square) : 0;
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
static double error_of(target *t, const double p[3])
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

/* Samples, E and the mean direction. */
static int target_of(target *t, const bake_settings *s, float alpha, double cosine)
{
    const vndf_description of = bake_mirror(s, alpha);
    bake_points *p = &t->drawn;
    vndf_error error;
    double x = 0, z = 0;
    for (int i = 0; i < SAMPLES; i++) {
        p->u[0][i] = ((float)(i % SIDE) + 0.5f) / SIDE;
        p->u[1][i] = ((float)(i / SIDE) + 0.5f) / SIDE;
        p->u[2][i] = 0.5f;
    }
    if (vndf_material_resolve(&of, &t->material, &error) != VNDF_OK)
        return 0;
    bake_sample(&t->material, cosine, SAMPLES, p);
    /* f cos as it was drawn: that of a rounded direction differs on smooth surfaces. */
    for (int i = 0; i < SAMPLES; i++) {
        if (p->lobe[i] == VNDF_LOBE_NONE)
            p->wo[2][i] = -1; /* lost */
        t->cosines[i] = p->weight[0][i] * p->density[i];
        x += (double)p->weight[0][i] * (double)p->wo[0][i];
        z += (double)p->weight[0][i] * (double)p->wo[2][i];
    }
    t->sum = bake_direction(s, alpha, cosine);
    t->x = cosine > 0.9999 ? 0 : x / hypot(x, z);
    t->z = sqrt(1 - t->x * t->x);
    return t->sum.all > 0 && z > 0;
}

/* ---- the simplex method ---- */

enum { NUMBERS = 3, CORNERS = NUMBERS + 1, STEPS = 90 };

typedef struct corner {
    double at[NUMBERS], error;
} corner;

/* The corner at `mean` + `by` (mean - the last one). */
static corner beyond(target *t, const corner *all, double by)
{
    corner c;
    for (int k = 0; k < NUMBERS; k++) {
        double mean = 0;
        for (int i = 0; i < NUMBERS; i++)
            mean += all[i].at[k] / NUMBERS;
        c.at[k] = mean + by * (mean - all[NUMBERS].at[k]);
    }
    c.error = error_of(t, c.at);
    return c;
}

static void put_in_order(corner *c)
{
    for (int i = 1; i < CORNERS; i++)
        for (int k = i; k > 0 && c[k].error < c[k - 1].error; k--) {
            corner swap = c[k];
            c[k] = c[k - 1];
            c[k - 1] = swap;
        }
}

/* Moves p to where the error is least nearby. `step`: how far to look at first. */
static void minimise(target *t, double p[NUMBERS], double step)
{
    corner c[CORNERS];
    for (int i = 0; i < CORNERS; i++) {
        memcpy(c[i].at, p, sizeof c[i].at);
        if (i < NUMBERS) /* c is a slope, and looked at in parts of the width of the lobe */
            c[i].at[i] += i < 2 ? step : step * 2 * exp(p[0]);
        c[i].error = error_of(t, c[i].at);
    }
    for (int n = 0; n < STEPS; n++) {
        put_in_order(c);
        if (c[NUMBERS].error - c[0].error <= 1e-4 * c[0].error)
            break;
        corner other = beyond(t, c, 1);
        if (other.error < c[0].error) {
            corner farther = beyond(t, c, 2);
            other = farther.error < other.error ? farther : other;
        } else if (other.error >= c[NUMBERS - 1].error)
            other = beyond(t, c, other.error < c[NUMBERS].error ? 0.5 : -0.5);
        if (other.error < c[NUMBERS].error) {
            c[NUMBERS] = other;
            continue;
        }
        for (int i = 1; i < CORNERS; i++) {
            for (int k = 0; k < NUMBERS; k++)
                c[i].at[k] = (c[i].at[k] + c[0].at[k]) / 2;
            c[i].error = error_of(t, c[i].at);
        }
    }
    put_in_order(c);
    memcpy(p, c[0].at, sizeof c[0].at);
}

/* ---- the table ---- */

/* Rougher first, from straight above to grazing: what is smooth is the easiest, and begins what follows. */
int bake_ltc(const bake_settings *s, baked_list *list)
{
    const char *const axis[] = {"cosine: 1 - (i/(n - 1))^2", "roughness: i/(n - 1)"};
    const size_t n = s->size, count[] = {n, n};
    static target t;
    baked *inverse =
        baked_add(list, "ltc_inverse",
                  "the inverse of M over its middle number: xx, zx, xz, zz, as mat3(xx,0,zx, 0,1,0, xz,0,zz)", 2,
                  axis, count, 4);
    baked *norm =
        inverse ? baked_add(list, "ltc_norm",
                            "E of F = 1, its part by (1 - cos)^5, and the error: half the integral of |f cos/E "
                            "- density|",
                            2, axis, count, 3)
                : NULL;
    double row[NUMBERS] = {0, 0, 0};
    if (!norm)
        return 0;
    for (size_t i = n; i-- > 0;) {
        double p[NUMBERS];
        float alpha = bake_alpha(s->mapping, (double)i / (double)(n - 1));
        memcpy(p, row, sizeof p);
        for (size_t j = 0; j < n; j++) {
            double v = (double)j / (double)(n - 1), m[3][3];
            if (!target_of(&t, s, alpha, fmax(1 - v * v, 2e-3)))
                return 0;
            if (j == 0)
                p[2] = 0;
            minimise(&t, p, i == n - 1 && j == 0 ? 0.3 : 0.1);
            if (j == 0)
                memcpy(row, p, sizeof p);
            error_of(&t, p);
            matrix_of(&t, p, m);
            bake_cosine c = inverse_of(m);
            float *k = inverse->value + 4 * (j * n + i), *e = norm->value + 3 * (j * n + i);
            k[0] = (float)c.inverse[0], k[1] = (float)c.inverse[3];
            k[2] = (float)c.inverse[1], k[3] = (float)c.inverse[4];
            e[0] = (float)t.sum.all, e[1] = (float)t.sum.grazing, e[2] = (float)t.wrong;
            norm->worst = fmax(norm->worst, t.wrong);
            norm->mean += t.wrong / (double)(n * n);
            if (progress_show((double)((n - 1 - i) * n + j) / (double)(n * n), "ltc", s->progress))
                return 0;
        }
    }
    inverse->error = norm->error = "half the integral of |f cos/E - density| over all texels";
    inverse->worst = norm->worst;
    inverse->mean = norm->mean;
    return 1;
}
