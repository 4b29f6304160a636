/* Along each of u1 and u2 alone, from ten directions, every sample is unit, above the surface and faces wi, its density
 * is within [FLT_MIN, FLT_MAX], u2 never moves the slope length back nor u1 the azimuth, but for rounding, and the
 * densities that come with samples are those of vndf_pdf, as vndf.h says. With tables as arguments (long_sweep) it asks
 * all 2^24 numbers, else a part of them for two. It notices what random numbers rarely meet: an end of the range, a
 * cell found on the wrong side of its knot, masses that round to nothing. */
#include <float.h>

#include "harness/test.h"
#include "oracle/oracle.h"
#include "vndf.h"

enum { BLOCK = 1 << 10, NEAR_PDF = 64 };
static const double ROUNDINGS = 12 * 0x1p-24; /* of two normals, and of masses */

typedef struct sweep {
    vndf_batch batch;
    vndf_view view;
    vndf_vec3 wi;
    int of_u2;
    long asked, bad, back,
        beyond[2]; /* of the densities that are asked beside vndf_pdf: off by 10 limits, by one */
    double last[2];
} sweep;

/* Whether the angle of (y, x), a slope length or an azimuth, has gone back: the sine of the step, over what rounding
 * moves where the vector is short. */
static int goes_back(sweep *s, double x, double y)
{
    const double across = s->last[0] * y - s->last[1] * x;
    s->last[0] = x;
    s->last[1] = y;
    return across < -ROUNDINGS * hypot(x, y);
}

static void check_sample(sweep *s, vndf_vec3 wm, float pdf, int near_pdf)
{
    const double x = (double)wm.x, y = (double)wm.y, z = (double)wm.z, across = sqrt(x * x + y * y);
    const double facing = x * (double)s->wi.x + z * (double)s->wi.z;
    s->bad += !(fabs(hypot(across, z) - 1) <= 4 * 0x1p-23 && z >= 0 && facing > 0);
    s->bad += !(pdf >= FLT_MIN && pdf <= FLT_MAX);
    s->back += s->of_u2 ? goes_back(s, z, across) : goes_back(s, x, y);
    if (near_pdf) {
        const double off = fabs((double)vndf_pdf(&s->view, wm) / (double)pdf - 1),
                     least = s->wi.z >= 0 ? 1e-5 : 1e-4;
        s->asked++;
        s->beyond[0] += !(off <= 10 * least);
        s->beyond[1] += !(off <= least);
    }
}

/* The numbers first, first + stride, ... of one kind; the other one is fixed. */
static void sweep_numbers(sweep *s, size_t stride, float fixed)
{
    float u[2][BLOCK], x[BLOCK], y[BLOCK], z[BLOCK], pdf[BLOCK];
    s->last[0] = s->of_u2 ? 1 : -1;
    s->last[1] = 0;
    for (size_t first = 0; first < 1 << 24; first += BLOCK * stride) {
        for (size_t i = 0; i < BLOCK; i++) {
            u[s->of_u2][i] = (float)(first + i * stride) * 0x1p-24f;
            u[!s->of_u2][i] = fixed;
        }
        vndf_sample_n(&s->batch, u[0], u[1], (vndf_normals){x, y, z}, pdf);
        for (size_t i = 0; i < BLOCK; i++)
            check_sample(s, (vndf_vec3){x[i], y[i], z[i]}, pdf[i], i % NEAR_PDF == 0);
    }
}

static void check_table(const char *path, size_t stride)
{
    static const double degrees[] = {0.01, 20, 45, 60, 75, 85, 89, 89.99, 100, 125};
    vndf_distribution *d = vndf_load(path, NULL);
    const float alpha = (float)(0.3 / vndf_distribution_info(d).scale);
    const vndf_surface surface = {d, alpha, alpha};
    sweep s = {0};
    for (int i = 0; TEST(d != NULL) && i < 20; i++) {
        const double theta = degrees[i / 2] * PI / 180;
        s.wi = (vndf_vec3){(float)sin(theta), 0, (float)cos(theta)};
        s.view = vndf_view_from(&surface, s.wi);
        s.of_u2 = i % 2;
        s.batch = (vndf_batch){d, BLOCK, VNDF_SHARED_ALPHA | VNDF_SHARED_WI, 0, &alpha, &alpha, .wi_x = &s.wi.x};
        s.batch.wi_y = &s.wi.y, s.batch.wi_z = &s.wi.z;
        sweep_numbers(&s, stride, s.of_u2 ? 0.37f : 0.61f);
    }
    const double asked = (double)s.asked; /* and an end of each of 20 lines */
    const int good = TEST(s.bad == 0) & TEST(s.back == 0) & TEST((double)s.beyond[0] <= 1e-4 * asked + 20) &
                     TEST((double)s.beyond[1] <= 1e-3 * asked + 20);
    if (!good || stride == 1)
        fprintf(stderr, "%s: %ld bad, %ld back, of %ld densities %ld and %ld off\n", path, s.bad, s.back, s.asked,
                s.beyond[1], s.beyond[0]);
    vndf_free(d);
}

int main(int arguments, char **argument)
{
    for (int i = 1; i < arguments; i++)
        check_table(argument[i], 1);
    for (int i = 0; arguments < 2 && i < 2; i++)
        check_table(i ? VNDF_SOURCE_DIR "/tables/student-t-2.5-small.vndf"
                      : VNDF_SOURCE_DIR "/tables/student-t-1.8.vndf",
                    test_amount(1 << 12, 1 << 8, 1 << 6));
    return test_done();
}
