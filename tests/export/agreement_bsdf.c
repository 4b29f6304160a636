/* Questions to exported BSDFs, and whether they answer as the library does: samples from the same numbers, f and
 * densities, and whether weight times density is f times the cosine. No sample has a weight or a density that is
 * negative or not finite, or a direction that is not unit. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "agreement.h"
#include "export/effects.h"

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
    if (!effects_read(&chosen, text, why))
        exit(2);
    for (int i = 0; i < s->count; i++)
        if (s->base[i] == q->of.distribution)
            is.distribution = s->is[i];
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

static exported_hit question(const subjects *s, size_t index, const char *effects)
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

int make_of_bsdf(const subjects *s, size_t count, const char *file, const char *effects)
{
    FILE *to = fopen(file, "wb");
    for (size_t i = 0; to && i < count; i++) {
        exported_hit q = question(s, i, effects);
        if (fwrite(&q, sizeof q, 1, to) != 1)
            return 2;
    }
    return to && fclose(to) == 0 ? 0 : 2;
}

/* ---- answers ---- */

static vndf_vec3 vector(const float v[3])
{
    const vndf_vec3 w = {v[0], v[1], v[2]};
    return w;
}

/* The library's; of the direction that the kernel drew f and density. */
static exported_scattered answer_of(const vndf_bsdf *b, const exported_hit *q, const exported_scattered *given)
{
    exported_scattered a = {.lobe = 0};
    vndf_scattered s;
    float f[VNDF_WAVELENGTHS];
    vndf_bsdf_sample(b, q->u, &s);
    a.wo[0] = s.wo.x;
    a.wo[1] = s.wo.y;
    a.wo[2] = s.wo.z;
    memcpy(a.weight, s.weight, sizeof a.weight);
    a.sampled = s.density;
    a.lobe = (float)s.lobe;
    vndf_bsdf_eval_pdf(b, vector(q->wo), 0, f, &a.pdf);
    memcpy(a.f, f, sizeof a.f);
    vndf_bsdf_eval_pdf(b, vector(given->wo), 0, f, &a.own_pdf);
    memcpy(a.own_f, f, sizeof a.own_f);
    return a;
}

static int is_refused(const exported_scattered *a)
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
static const limit LIMITS[] = {
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
enum { LIMITS_COUNT = sizeof LIMITS / sizeof LIMITS[0] };

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

int check_of_bsdf(const subjects *s, const char *effects, const char *questions, const char *answers)
{
    FILE *asked = fopen(questions, "rb"), *said = fopen(answers, "rb");
    exported_hit q;
    exported_scattered a;
    size_t count = 0, kept = 0, refused = 0, room = 1u << 16;
    double *off[LIMITS_COUNT];
    int bad = 0;
    for (int i = 0; i < LIMITS_COUNT; i++)
        if (!(off[i] = malloc(room * sizeof(double))))
            return 2;
    if (!asked || !said)
        return 2;
    while (count < room && fread(&q, sizeof q, 1, asked) == 1 && fread(&a, sizeof a, 1, said) == 1) {
        vndf_material material = material_of(s, effects, &q);
        vndf_bsdf b;
        int there = vndf_bsdf_at(&b, &material, vector(q.wi));
        exported_scattered own = answer_of(&b, &q, &a);
        for (int i = 0; i + 1 < LIMITS_COUNT; i++)
            off[i][count] = own.lobe != a.lobe && i > 0 && i < 4
                                ? 0
                                : difference(&LIMITS[i], (const float *)&a, (const float *)&own);
        off[LIMITS_COUNT - 1][count++] = a.lobe > 0 && a.lobe < 3 ? inconsistency(&b, &a) : 0;
        refused += (size_t)is_refused(&a);
        kept += there && a.lobe > 0;
    }
    printf("%s: %zu answers, %zu scattered, %zu refused\n", effects, count, kept, refused);
    for (int i = 0; count && i < LIMITS_COUNT; i++) {
        bad += judge(&LIMITS[i], off[i], count, 1);
        free(off[i]);
    }
    return !count || kept < count / 4 || bad || refused;
}
