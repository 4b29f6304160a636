/* Along each of u1 and u2 alone, from ten directions, every sample is unit, above the surface and faces wi, its density
 * is within [FLT_MIN, FLT_MAX], u2 never moves the slope length back nor u1 the azimuth, but for rounding, and the
 * densities that come with samples are those of vndf_pdf, as vndf.h says. With tables as arguments (long_sweep) it asks
 * all 2^24 numbers, else a part of them for two. It notices what random numbers rarely meet: an end of the range, a
 * cell found on the wrong side of its knot, masses that round to nothing. */
#include <float.h>

#include "harness/test.h"
#include "vndf.h"

enum { BLOCK = 1 << 10, NEAR_PDF = 64 };
static const double ROUNDINGS = 12 * 0x1p-24; /* of two normals, and of masses */

/* What went wrong: samples, steps back; of the densities that are asked, off by the limit, and by ten of it. */
typedef struct counts {
    long bad, back, asked, off, far;
} counts;

/* last: of the sample before, a vector whose angle is the slope length or the azimuth. */
static void check_sample(const vndf_view *view, vndf_vec3 wm, float pdf, int of_u2, double last[2], counts *c)
{
    const double x = (double)wm.x, y = (double)wm.y, z = (double)wm.z, across = sqrt(x * x + y * y);
    const double a = of_u2 ? z : x, b = of_u2 ? across : y;
    c->bad += !(fabs(sqrt(x * x + y * y + z * z) - 1) <= 4 * 0x1p-23 && z >= 0 && pdf >= FLT_MIN &&
                pdf <= FLT_MAX && x * (double)view->wi.x + z * (double)view->wi.z > 0);
    c->back += last[0] * b - last[1] * a < -ROUNDINGS * sqrt(a * a + b * b);
    last[0] = a, last[1] = b;
}

static void check_pdf(const vndf_view *view, vndf_vec3 wm, float pdf, counts *c)
{
    const double off = fabs((double)vndf_pdf(view, wm) / (double)pdf - 1), limit = view->wi.z >= 0 ? 1e-5 : 1e-4;
    c->asked++;
    c->off += !(off <= limit);
    c->far += !(off <= 10 * limit);
}

/* Numbers that are `stride` steps of 2^-24 apart. */
static void sweep(const vndf_surface *surface, double theta, int of_u2, size_t stride, counts *c)
{
    const vndf_vec3 wi = {(float)sin(theta), 0, (float)cos(theta)};
    const vndf_view view = vndf_view_from(surface, wi);
    vndf_batch batch = {.surface = {.distribution = surface->distribution, .xx = &surface->xx, .yy = &surface->yy},
                        .count = BLOCK,
                        .wi_x = &wi.x,
                        .wi_y = &wi.y};
    float u[2][BLOCK], x[BLOCK], y[BLOCK], z[BLOCK], pdf[BLOCK];
    double last[2] = {of_u2 ? 1 : -1, 0};
    batch.shared = VNDF_SHARED_SURFACE | VNDF_SHARED_WI;
    batch.wi_z = &wi.z;
    for (size_t first = 0; first < 1 << 24; first += BLOCK * stride) {
        for (size_t i = 0; i < BLOCK; i++) {
            u[of_u2][i] = (float)(first + i * stride) * 0x1p-24f;
            u[!of_u2][i] = of_u2 ? 0.37f : 0.61f;
        }
        vndf_sample_n(&batch, u[0], u[1], (vndf_normals){x, y, z}, pdf);
        for (size_t i = 0; i < BLOCK; i++) {
            const vndf_vec3 wm = {x[i], y[i], z[i]};
            check_sample(&view, wm, pdf[i], of_u2, last, c);
            if (i % NEAR_PDF == 0)
                check_pdf(&view, wm, pdf[i], c);
        }
    }
}

static void check_table(const char *path, size_t stride)
{
    static const double degrees[] = {0.01, 20, 45, 60, 75, 85, 89, 89.99, 100, 125};
    vndf_distribution *d = vndf_load(path, NULL);
    const float alpha = (float)(0.3 / vndf_distribution_info(d).scale);
    const vndf_surface surface = vndf_rough(d, alpha, alpha);
    counts c = {0};
    for (int i = 0; TEST(d != NULL) && i < 20; i++)
        sweep(&surface, degrees[i / 2] * PI / 180, i % 2, stride, &c);
    TEST(c.bad == 0 && c.back == 0);
    TEST((double)c.far <= 1e-4 * (double)c.asked + 20 && (double)c.off <= 1e-3 * (double)c.asked + 20); /* ends */
    fprintf(stderr, "%s: %ld bad, %ld back, of %ld densities %ld and %ld off\n", path, c.bad, c.back, c.asked,
            c.off, c.far);
    vndf_free(d);
}

int main(int arguments, char **argument)
{
    for (int i = 1; i < arguments; i++)
        check_table(argument[i], 1);
    for (int i = 0; arguments < 2 && i < 2; i++)
        check_table(i ? VNDF_SOURCE_DIR "/tables/student-t-2.5.vndf"
                      : VNDF_SOURCE_DIR "/tables/student-t-1.8.vndf",
                    test_amount(1 << 12, 1 << 8, 1 << 6));
    return test_done();
}
