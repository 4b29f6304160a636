/* A mixture of two tables is the table of the mixed distribution, within what their certificates say: D by the largest
 * weights, areas and Lambda by the area errors, and the visible normals by the total variations, by quadrature over
 * the normals at angles of incidence from 0 to 120 degrees. */
#include "harness/constants.h"
#include "harness/test.h"
#include "vndf_build.h"

enum { BYTES = 8192, RADII = 400, TURNS = 96 };

static vndf_distribution *build(const char *family)
{
    const vndf_build_options options = {.max_bytes = BYTES};
    vndf_source *source = vndf_source_family(family, NULL);
    vndf_distribution *d = source ? vndf_build(source, &options, NULL, NULL) : NULL;
    vndf_source_free(source);
    TEST(d != NULL);
    return d;
}

/* Half the integral of the difference of both densities, and of both D cos. */
typedef struct distance {
    double drawn, slopes;
} distance;

static distance distance_at(const vndf_mixture *mixture, const vndf_surface *whole, vndf_vec3 wi)
{
    vndf_mixture_view lobes = vndf_mixture_view_from(mixture, wi);
    vndf_view view = vndf_view_from(whole, wi);
    distance d = {0, 0};
    for (int i = 0; i < RADII; i++)
        for (int k = 0; k < TURNS; k++) { /* even in the logarithm of the slope length, from 1e-4 to 1e5 */
            double r = 1e-4 * pow(1e9, (i + 0.5) / RADII), phi = 2 * PI * (k + 0.5) / TURNS;
            double cosine = 1 / sqrt(1 + r * r), across = r * cosine;
            double area = log(1e9) / RADII * (2 * PI / TURNS) * r * r * cosine * cosine * cosine;
            vndf_vec3 wm = {(float)(across * cos(phi)), (float)(across * sin(phi)), (float)cosine};
            d.drawn += 0.5 * area * fabs((double)vndf_mixture_pdf(&lobes, wm) - (double)vndf_pdf(&view, wm));
            d.slopes +=
                0.5 * area * cosine * fabs((double)vndf_mixture_ndf(mixture, wm) - (double)vndf_ndf(whole, wm));
        }
    return d;
}

static void test_pair(const char *first, const char *second, const char *both, float width, float weight)
{
    vndf_distribution *a = build(first), *b = build(second), *mixed = build(both);
    if (!a || !b || !mixed)
        return;
    const float alpha = 0.6f, other = alpha * width;
    const vndf_surface whole = {mixed, alpha, alpha};
    const vndf_mixture mixture = {
        .count = 2,
        .lobe = {{{a, alpha, 0, 0, alpha, 0, 0}, 1 - weight}, {{b, other, 0, 0, other, 0, 0}, weight}}};
    vndf_certificate of[3] = {vndf_distribution_info(a).certificate, vndf_distribution_info(b).certificate,
                              vndf_distribution_info(mixed).certificate};
    double above = (double)of[0].tv_above + (double)of[1].tv_above + (double)of[2].tv_above;
    double below = (double)of[0].tv + (double)of[1].tv + (double)of[2].tv;
    double error = (double)fmaxf(of[0].area_error, of[1].area_error) + (double)of[2].area_error + 2e-6;
    for (int degrees = 0; degrees <= 120; degrees += 30) {
        double theta = (degrees + 0.5) * PI / 180, tv = degrees < 90 ? above : below;
        vndf_vec3 wi = {(float)(sin(theta) * cos(1)), (float)(sin(theta) * sin(1)), (float)cos(theta)};
        distance d = distance_at(&mixture, &whole, wi);
        double area = (double)vndf_mixture_projected_area(&mixture, wi),
               want = (double)vndf_projected_area(&whole, wi);
        TEST_RELATIVE(area, want, error / fmin(1, area)); /* relative errors are certified above the horizon */
        TEST(d.drawn <= tv + 1e-5);
        TEST(d.slopes <= above + 1e-5);
        printf("%s at %d degrees: TV %.2g of drawn normals, %.2g of slopes, certified %.2g; area %.2g of %.2g\n",
               both, degrees, d.drawn, d.slopes, tv, fabs(area / want - 1), error);
    }
    vndf_free(a);
    vndf_free(b);
    vndf_free(mixed);
}

int main(void)
{
    test_pair("student-t:3", "epd:0.8", "mix:(0.7,1,student-t:3)+(0.3,0.2,epd:0.8)", 0.2f, 0.3f);
    test_pair("gtr:2.5", "student-t:2", "mix:(0.1,1,gtr:2.5)+(0.9,3,student-t:2)", 3, 0.9f);
    return test_done();
}
