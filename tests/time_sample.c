/* What one visible normal costs: view, sample and density of one sample for one direction, in nanoseconds, side by side
 * with the closed forms and with a plain sampler by spherical caps written out here (Dupuy & Benyoub 2023, with
 * its density and nothing guarded). Not a test: run it by hand, `time_sample TABLE...`. Random directions of the
 * upper hemisphere, random roughness per sample; the methods take turns, medians and quartiles are printed. */
#define _POSIX_C_SOURCE 200809L
#include <stdlib.h>
#include <time.h>

#include "test.h"
#include "vndf.h"

enum { SAMPLES = 4096, LOOPS = 20, TURNS = 31, METHODS_MAX = 16 };

typedef struct input {
    vndf_vec3 wi;
    float alpha, u1, u2;
} input;

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
    float phi = 6.28318531f * in->u1, z = (1.0f - in->u2) * (1.0f + w.z) - w.z, s = sqrtf(fmaxf(0.0f, 1.0f - z * z));
    vndf_vec3 m = unit(a * (s * cosf(phi) + w.x), a * (s * sinf(phi) + w.y), z + w.z);
    float ex = m.x / a, ey = m.y / a, q = ex * ex + ey * ey + m.z * m.z;
    float dot = in->wi.x * m.x + in->wi.y * m.y + in->wi.z * m.z;
    *pdf = 2.0f * fmaxf(0.0f, dot) / (3.14159265f * a * a * q * q * (in->wi.z + length));
    return m;
}

/* Mean time of a sample in one turn; d NULL stands for plain_caps. */
static double turn(const vndf_distribution *d, const input *inputs, float *sum)
{
    double start = now();
    for (int loop = 0; loop < LOOPS; loop++)
        for (int i = 0; i < SAMPLES; i++) {
            float pdf;
            vndf_vec3 wm;
            if (d) {
                vndf_surface surface = {d, inputs[i].alpha, inputs[i].alpha};
                vndf_view view = vndf_view_from(&surface, inputs[i].wi);
                wm = vndf_sample(&view, inputs[i].u1, inputs[i].u2, &pdf);
            } else
                wm = plain_caps(&inputs[i], &pdf);
            *sum += wm.x + pdf;
        }
    return (now() - start) / (LOOPS * SAMPLES);
}

/* Whether the results are worth timing: normals are unit and face wi, densities are positive. */
static int valid(const vndf_distribution *d, const input *inputs)
{
    for (int i = 0; i < SAMPLES; i++) {
        vndf_surface surface = {d, inputs[i].alpha, inputs[i].alpha};
        vndf_view view = vndf_view_from(&surface, inputs[i].wi);
        float pdf;
        vndf_vec3 m = vndf_sample(&view, inputs[i].u1, inputs[i].u2, &pdf);
        float dot = m.x * inputs[i].wi.x + m.y * inputs[i].wi.y + m.z * inputs[i].wi.z;
        if (fabsf(m.x * m.x + m.y * m.y + m.z * m.z - 1.0f) > 1e-6f || !(dot >= 0.0f) || !(pdf > 0.0f))
            return 0;
    }
    return 1;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

int main(int count, char **paths)
{
    static input inputs[SAMPLES];
    static double time[METHODS_MAX][TURNS];
    const vndf_distribution *d[METHODS_MAX] = {NULL, vndf_ggx(), vndf_beckmann()};
    const char *name[METHODS_MAX] = {"plain spherical caps", "vndf_ggx()", "vndf_beckmann()"};
    unsigned long long state = 20231;
    int methods = 3;
    float sum = 0.0f;
    for (int i = 0; i < SAMPLES; i++) {
        float z = test_uniform(&state), phi = 6.28318531f * test_uniform(&state), s = sqrtf(1.0f - z * z);
        inputs[i] = (input){{s * cosf(phi), s * sinf(phi), z}, 0.05f + 0.9f * test_uniform(&state), test_uniform(&state), test_uniform(&state)};
    }
    for (int i = 1; i < count && methods < METHODS_MAX; i++) {
        vndf_error error;
        name[methods] = paths[i];
        if (!(d[methods] = vndf_load(paths[i], &error)))
            return fprintf(stderr, "time_sample: %s\n", error.message), 2;
        methods++;
    }
    for (int m = 1; m < methods; m++)
        if (!valid(d[m], inputs))
            return fprintf(stderr, "time_sample: %s draws invalid normals\n", name[m]), 1;
    for (int t = 0; t < TURNS; t++)
        for (int m = 0; m < methods; m++)
            time[m][t] = turn(d[m], inputs, &sum);
    for (int m = 0; m < methods; m++)
        qsort(time[m], TURNS, sizeof time[m][0], ascending);
    printf("%-44s %8s %8s %8s %8s\n", "view + sample + density", "ns", "25%", "75%", "ratio");
    for (int m = 0; m < methods; m++)
        printf("%-44s %8.1f %8.1f %8.1f %8.2f\n", name[m], time[m][TURNS / 2], time[m][TURNS / 4], time[m][3 * TURNS / 4],
               time[m][TURNS / 2] / time[0][TURNS / 2]);
    return sum == 12345.0f; /* keeps the loops alive */
}
