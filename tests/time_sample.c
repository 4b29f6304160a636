/* What one visible normal costs, in nanoseconds, side by side with the closed forms and with a plain sampler by
 * spherical caps written out here (Dupuy & Benyoub 2023, with its density and nothing guarded): view, sample and
 * density for a direction each; sample and density where 64 samples share a view; vndf_pdf alone on such a view.
 * Not a test: run it by hand, `time_sample TABLE...`. Random directions of the upper hemisphere, random roughness;
 * the methods take turns, medians are printed, and quartiles of the first. */
#define _POSIX_C_SOURCE 200809L
#include <stdlib.h>
#include <time.h>

#include "test.h"
#include "vndf.h"

enum { SAMPLES = 4096, SHARED = 64, LOOPS = 20, TURNS = 31, METHODS_MAX = 24 };

typedef enum kind { WHOLE, SHARED_VIEW, PDF, KINDS } kind;

typedef struct input {
    vndf_vec3 wi;
    float alpha, u1, u2;
} input;

/* A sampler, the normals that it draws where views are shared, and its times. */
typedef struct method {
    const char *name;
    const vndf_distribution *d; /* NULL stands for plain_caps, timed as a whole alone */
    vndf_vec3 wm[SAMPLES];
    double time[KINDS][TURNS];
} method;

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e9 + (double)t.tv_nsec;
}

static vndf_vec3 unit(float x, float y, float z)
{
    float scale = 1.0f / sqrtf(x * x + y * y + z * z);
    return (vndf_vec3){x * scale, y * scale, z * scale};
}

static vndf_vec3 plain_caps(const input *in, float *pdf)
{
    float a = in->alpha, x = a * in->wi.x, y = a * in->wi.y, length = sqrtf(x * x + y * y + in->wi.z * in->wi.z);
    vndf_vec3 w = {x / length, y / length, in->wi.z / length};
    float phi = 6.28318531f * in->u1, z = (1.0f - in->u2) * (1.0f + w.z) - w.z;
    float s = sqrtf(fmaxf(0.0f, 1.0f - z * z));
    vndf_vec3 m = unit(a * (s * cosf(phi) + w.x), a * (s * sinf(phi) + w.y), z + w.z);
    float ex = m.x / a, ey = m.y / a, q = ex * ex + ey * ey + m.z * m.z;
    float dot = in->wi.x * m.x + in->wi.y * m.y + in->wi.z * m.z;
    *pdf = 2.0f * fmaxf(0.0f, dot) / (3.14159265f * a * a * q * q * (in->wi.z + length));
    return m;
}

static vndf_view view_of(const vndf_distribution *d, const input *in)
{
    vndf_surface surface = {d, in->alpha, in->alpha};
    return vndf_view_from(&surface, in->wi);
}

static float whole(const method *m, const input *inputs)
{
    float sum = 0.0f, pdf;
    for (int i = 0; i < SAMPLES; i++) {
        vndf_view view = view_of(m->d, &inputs[i]);
        sum += vndf_sample(&view, inputs[i].u1, inputs[i].u2, &pdf).x + pdf;
    }
    return sum;
}

static float plain(const input *inputs)
{
    float sum = 0.0f, pdf;
    for (int i = 0; i < SAMPLES; i++)
        sum += plain_caps(&inputs[i], &pdf).x + pdf;
    return sum;
}

static float shared_view(const method *m, const input *inputs)
{
    float sum = 0.0f, pdf;
    for (int i = 0; i < SAMPLES; i += SHARED) {
        vndf_view view = view_of(m->d, &inputs[i]);
        for (int j = i; j < i + SHARED; j++)
            sum += vndf_sample(&view, inputs[j].u1, inputs[j].u2, &pdf).x + pdf;
    }
    return sum;
}

static float pdf_alone(const method *m, const input *inputs)
{
    float sum = 0.0f;
    for (int i = 0; i < SAMPLES; i += SHARED) {
        vndf_view view = view_of(m->d, &inputs[i]);
        for (int j = i; j < i + SHARED; j++)
            sum += vndf_pdf(&view, m->wm[j]);
    }
    return sum;
}

/* Mean time of a sample in one turn. */
static double turn(const method *m, kind k, const input *inputs, float *sum)
{
    double start = now();
    for (int loop = 0; loop < LOOPS; loop++)
        *sum += !m->d        ? plain(inputs)
                : k == WHOLE ? whole(m, inputs)
                : k == PDF   ? pdf_alone(m, inputs)
                             : shared_view(m, inputs);
    return (now() - start) / (LOOPS * SAMPLES);
}

/* Draws the normals of pdf_alone; whether all results are worth timing: unit, facing wi, of positive density. */
static int prepare(method *m, const input *inputs)
{
    for (int i = 0; i < SAMPLES; i++) {
        const vndf_vec3 wi = inputs[i].wi;
        vndf_view view = view_of(m->d, &inputs[i]), first = view_of(m->d, &inputs[i / SHARED * SHARED]);
        float pdf;
        vndf_vec3 n = vndf_sample(&view, inputs[i].u1, inputs[i].u2, &pdf);
        if (fabsf(n.x * n.x + n.y * n.y + n.z * n.z - 1.0f) > 1e-6f ||
            !(n.x * wi.x + n.y * wi.y + n.z * wi.z >= 0.0f) || !(pdf > 0.0f))
            return 0;
        m->wm[i] = vndf_sample(&first, inputs[i].u1, inputs[i].u2, NULL);
    }
    return 1;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void print(method *m, double reference)
{
    for (int k = 0; k < (m->d ? KINDS : 1); k++)
        qsort(m->time[k], TURNS, sizeof m->time[k][0], ascending);
    const double *t = m->time[WHOLE];
    printf("%-44s %7.1f %7.1f %7.1f %7.2f", m->name, t[TURNS / 2], t[TURNS / 4], t[3 * TURNS / 4],
           t[TURNS / 2] / (reference > 0 ? reference : t[TURNS / 2]));
    if (m->d)
        printf(" %11.1f %7.1f", m->time[SHARED_VIEW][TURNS / 2], m->time[PDF][TURNS / 2]);
    printf("\n");
}

static void fill(input *inputs)
{
    unsigned long long state = 20231;
    for (int i = 0; i < SAMPLES; i++) {
        float z = test_uniform(&state), phi = 6.28318531f * test_uniform(&state), s = sqrtf(1.0f - z * z);
        float alpha = 0.05f + 0.9f * test_uniform(&state), u1 = test_uniform(&state), u2 = test_uniform(&state);
        inputs[i] = (input){{s * cosf(phi), s * sinf(phi), z}, alpha, u1, u2};
    }
}

int main(int count, char **paths)
{
    static input inputs[SAMPLES];
    static method methods[METHODS_MAX] = {{.name = "plain spherical caps"}, {.name = "vndf_ggx()"},
                                          {.name = "vndf_beckmann()"}};
    int n = 3;
    float sum = 0.0f;
    methods[1].d = vndf_ggx();
    methods[2].d = vndf_beckmann();
    fill(inputs);
    for (int i = 1; i < count && n < METHODS_MAX; i++, n++) {
        vndf_error error;
        methods[n].name = paths[i];
        if (!(methods[n].d = vndf_load(paths[i], &error)))
            return fprintf(stderr, "time_sample: %s\n", error.message), 2;
    }
    for (int m = 1; m < n; m++)
        if (!prepare(&methods[m], inputs))
            return fprintf(stderr, "time_sample: %s draws invalid normals\n", methods[m].name), 1;
    for (int t = 0; t < TURNS; t++)
        for (int m = 0; m < n; m++)
            for (int k = 0; k < (methods[m].d ? KINDS : 1); k++)
                methods[m].time[k][t] = turn(&methods[m], (kind)k, inputs, &sum);
    printf("%-44s %7s %7s %7s %7s %11s %7s\n", "view + sample + density", "ns", "25%", "75%", "ratio",
           "shared view", "pdf");
    for (int m = 0; m < n; m++)
        print(&methods[m], m ? methods[0].time[WHOLE][TURNS / 2] : 0);
    return sum == 12345.0f; /* keeps the loops alive */
}
