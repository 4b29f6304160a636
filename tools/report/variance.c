/* Variance against the number of samples: two integrals estimated in several ways.
 *
 * The integral is the albedo of a rough conductor seen from 60 and from 85 degrees,
 *     integral f(wi, wo) cos(theta_o) dwo = integral F(wi.wm) G2/G1(wi) Dv(wm) dwm
 * over normals that reflect upwards, with Schlick's F (0.9 at normal incidence) and height-correlated masking.
 * Ways to estimate it:
 *     visible normals from a table, weighted by true/drawn density: unbiased at any size;
 *     the same without the weight: biased by the table's error;
 *     all normals (Walter et al. 2007), D cos(theta_m): the visible normals of the largest table from straight above;
 *     directions by their cosine, which do not know D.
 * The noise at N samples is the root mean square distance of a mean to the reference, over all groups of N of the same
 * 2^17 samples. The reference comes from 2^18 points of a lattice, with the weight. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "draw/chart.h"
#include "cli/subject.h"
#include "cli/random.h"
#include "report/report.h"

enum { SAMPLES = 1 << 17, TRUTH_POINTS = 1 << 18 };

static const double pi = 3.14159265358979323846;
static const double angles[2] = {60, 85};

typedef struct scene {
    const vndf_reference *reference;
    vndf_surface exact; /* the largest table: masking, and all normals */
    vndf_vec3 wi;
    double alpha, area, g1; /* area and G1 of wi */
} scene;

static double true_area(const vndf_reference *reference, double alpha, vndf_vec3 w)
{
    double across = alpha * hypot((double)w.x, (double)w.y), up = (double)w.z;
    return hypot(across, up) * vndf_reference_area(reference, atan2(across, up));
}

static scene scene_at(const report_subject *subject, double degrees, double alpha)
{
    scene s = {subject->reference,
               {subject->table[subject->count - 1].table, (float)alpha, (float)alpha},
               direction_from(degrees, 0),
               alpha,
               0,
               0};
    s.area = true_area(s.reference, alpha, s.wi);
    s.g1 = (double)s.wi.z / s.area;
    return s;
}

static double true_ndf(const scene *s, vndf_vec3 wm)
{
    double z = (double)wm.z, across = hypot((double)wm.x, (double)wm.y);
    return z > 1e-12
               ? vndf_reference_p22(s->reference, across / (z * s->alpha)) / (s->alpha * s->alpha * z * z * z * z)
               : 0;
}

static double dot(vndf_vec3 a, vndf_vec3 b)
{
    return (double)a.x * (double)b.x + (double)a.y * (double)b.y + (double)a.z * (double)b.z;
}

/* F G2, which both kinds of estimate share; 0 for a reflection that goes down. */
static double reflected(const scene *s, vndf_vec3 wm, double cosine)
{
    vndf_vec3 wo = {(float)(2 * cosine * (double)wm.x - (double)s->wi.x),
                    (float)(2 * cosine * (double)wm.y - (double)s->wi.y),
                    (float)(2 * cosine * (double)wm.z - (double)s->wi.z)};
    if (!(wo.z > 0))
        return 0;
    double fresnel = 0.9 + 0.1 * pow(1 - fmin(cosine, 1), 5);
    return fresnel * (double)vndf_g2(&s->exact, s->wi, wo, VNDF_G2_HEIGHT_CORRELATED);
}

/* ---- the ways ------------------------------------------------------------------------------------ */

typedef enum way { WAY_WEIGHTED, WAY_UNWEIGHTED, WAY_ALL_NORMALS, WAY_COSINE } way;

typedef struct estimator {
    const scene *scene;
    way way;
    vndf_view view; /* the view that draws normals */
} estimator;

static double estimate_visible(const estimator *e, double u1, double u2)
{
    float pdf;
    vndf_vec3 wm = vndf_sample(&e->view, (float)u1, (float)u2, &pdf);
    double cosine = dot(e->scene->wi, wm), value = reflected(e->scene, wm, cosine) / e->scene->g1;
    if (value == 0 || e->way == WAY_UNWEIGHTED)
        return value;
    return value * cosine * true_ndf(e->scene, wm) / (e->scene->area * (double)pdf);
}

static double estimate_all_normals(const estimator *e, double u1, double u2)
{
    float pdf;
    vndf_vec3 wm = vndf_sample(&e->view, (float)u1, (float)u2, &pdf);
    double cosine = dot(e->scene->wi, wm);
    if (!(cosine > 0))
        return 0;
    return reflected(e->scene, wm, cosine) * cosine * true_ndf(e->scene, wm) /
           ((double)e->scene->wi.z * (double)pdf);
}

/* Draws wo by its cosine; D is evaluated at the half vector. */
static double estimate_cosine(const estimator *e, double u1, double u2)
{
    double r = sqrt(u1), x = r * cos(2 * pi * u2), y = r * sin(2 * pi * u2), z = sqrt(fmax(0, 1 - u1));
    double hx = x + (double)e->scene->wi.x, hy = y + (double)e->scene->wi.y, hz = z + (double)e->scene->wi.z;
    double length = sqrt(hx * hx + hy * hy + hz * hz);
    vndf_vec3 wm = {(float)(hx / length), (float)(hy / length), (float)(hz / length)};
    if (!(z > 0))
        return 0;
    return reflected(e->scene, wm, dot(e->scene->wi, wm)) * true_ndf(e->scene, wm) * pi /
           (4 * (double)e->scene->wi.z * z);
}

static double estimate(const estimator *e, double u1, double u2)
{
    if (e->way == WAY_COSINE)
        return estimate_cosine(e, u1, u2);
    return e->way == WAY_ALL_NORMALS ? estimate_all_normals(e, u1, u2) : estimate_visible(e, u1, u2);
}

static estimator estimator_of(const scene *s, way w, const vndf_distribution *table)
{
    vndf_surface surface = {table, s->exact.alpha_x, s->exact.alpha_y};
    vndf_vec3 above = {0, 0, 1};
    estimator e = {s, w, vndf_view_from(&surface, w == WAY_ALL_NORMALS ? above : s->wi)};
    return e;
}

/* ---- measuring ----------------------------------------------------------------------------------- */

static double integrate(const estimator *e)
{
    double sum = 0;
    for (size_t i = 0; i < TRUTH_POINTS; i++) {
        double turned = (double)i * 0.6180339887498949;
        sum += estimate(e, ((double)i + 0.5) / TRUTH_POINTS, turned - floor(turned));
    }
    return sum / TRUTH_POINTS;
}

/* A group of 4^(k+1) samples is four groups of 4^k. */
static void measure_noise(const estimator *e, double reference, double error[REPORT_COUNTS])
{
    double group[REPORT_COUNTS] = {0}, squares[REPORT_COUNTS] = {0};
    random_stream stream = random_from(7);
    for (size_t i = 1; i <= SAMPLES; i++) {
        double u1 = (double)random_float(&stream), u2 = (double)random_float(&stream);
        double value = estimate(e, u1, u2) / reference;
        size_t size = 1;
        for (int k = 0; k < REPORT_COUNTS; k++, size *= 4) {
            group[k] += value;
            if (i % size == 0) {
                double off = group[k] / (double)size - 1;
                squares[k] += off * off;
                group[k] = 0;
            }
        }
    }
    for (int k = 0; k < REPORT_COUNTS; k++)
        error[k] = sqrt(squares[k] / (SAMPLES >> 2 * k));
}

static void add_noise(report_integral *integral, const estimator *e, const char *method)
{
    report_noise *noise = &integral->noise[integral->count++];
    snprintf(noise->method, sizeof noise->method, "%s", method);
    measure_noise(e, integral->reference, noise->error);
}

static void measure_integral(const report_subject *subject, const scene *s, report_integral *integral)
{
    const report_table *first = &subject->table[0], *chosen = &subject->table[subject->chosen];
    char size[16], text[64];
    estimator e = estimator_of(s, WAY_WEIGHTED, s->exact.distribution);
    integral->reference = integrate(&e);
    integral->count = 0;
    e = estimator_of(s, WAY_COSINE, NULL);
    add_noise(integral, &e, "cosine of wo");
    e = estimator_of(s, WAY_ALL_NORMALS, s->exact.distribution);
    add_noise(integral, &e, "all normals");
    table_bytes_text(size, (double)first->info.bytes);
    e = estimator_of(s, WAY_UNWEIGHTED, first->table);
    snprintf(text, sizeof text, "%s, no weight", size);
    add_noise(integral, &e, text);
    e = estimator_of(s, WAY_WEIGHTED, first->table);
    add_noise(integral, &e, size);
    if (chosen == first)
        return;
    table_bytes_text(size, (double)chosen->info.bytes);
    e = estimator_of(s, WAY_WEIGHTED, chosen->table);
    add_noise(integral, &e, size);
}

/* Built-in distributions stand for shapes, at the roughness of a usual material. */
static double alpha_of(const report_subject *subject)
{
    return subject->brought ? 1 : 0.3;
}

void report_variance_measure(const report_subject *subject, report_integral integral[2])
{
    for (int i = 0; i < 2; i++) {
        scene s = scene_at(subject, angles[i], alpha_of(subject));
        snprintf(integral[i].title, sizeof integral[i].title, "albedo of a conductor from %g°", angles[i]);
        measure_integral(subject, &s, &integral[i]);
    }
}

/* ---- the section --------------------------------------------------------------------------------- */

static void draw_integral(FILE *file, const report_integral *integral, const double counts[REPORT_COUNTS])
{
    static const chart_mark marks[REPORT_METHODS] = {CHART_CROSS, CHART_TRIANGLE, CHART_RING, CHART_SQUARE,
                                                     CHART_DOT};
    static const unsigned colours[REPORT_METHODS] = {7, 1, 4, 5, 0};
    chart_series series[REPORT_METHODS];
    chart_range range = {HUGE_VAL, 0};
    for (size_t m = 0; m < integral->count; m++) {
        const report_noise *noise = &integral->noise[m];
        series[m] = (chart_series){noise->method,
                                   counts,
                                   noise->error,
                                   REPORT_COUNTS,
                                   colours[m],
                                   marks[m],
                                   m == 2 ? CHART_DASHED : CHART_SOLID,
                                   NULL};
        for (int k = 0; k < REPORT_COUNTS; k++)
            chart_widen(&range, noise->error[k]);
    }
    double low = pow(10, floor(log10(fmax(range.low, 1e-7)) * 2) / 2);
    double high = fmax(pow(10, ceil(log10(range.high) * 2) / 2), 10 * low);
    chart c = {.title = integral->title,
               .width = CHART_WIDTH,
               .height = CHART_HEIGHT,
               .right = 132,
               .x = {CHART_LOG, 1, counts[REPORT_COUNTS - 1], 0, "samples"},
               .y = {CHART_LOG, low, high, 0, "relative RMS error"},
               .series = series,
               .count = integral->count};
    fputs("<figure>\n", file);
    chart_draw(file, &c);
    fprintf(file, "<figcaption>The integral is %.5g.</figcaption></figure>\n", integral->reference);
}

static int write_data(html_page *page, const report *r, const double counts[REPORT_COUNTS])
{
    text_table data = {.rows = 0};
    for (int i = 0; i < 2; i++)
        for (size_t m = 0; m < r->integral[i].count; m++)
            for (int k = 0; k < REPORT_COUNTS; k++) {
                table_row(&data);
                table_text(&data, "integral", r->integral[i].title);
                table_text(&data, "method", r->integral[i].noise[m].method);
                table_value(&data, "samples", counts[k]);
                table_value(&data, "relative_rms_error", r->integral[i].noise[m].error[k]);
            }
    return page_data(page, "variance.csv", "error of each method at each number of samples", data);
}

int report_write_variance(html_page *page, const report *r)
{
    double counts[REPORT_COUNTS];
    char lead[512];
    for (int k = 0; k < REPORT_COUNTS; k++)
        counts[k] = (double)(1u << 2 * k);
    snprintf(lead, sizeof lead,
             "What a renderer sees of it: the noise of an integral over %s at roughness %g, "
             "reflectance 0.9 at normal incidence. Straight lines fall with the root of the number of samples; "
             "one that levels off is biased. Sizes are tables of visible normals.",
             r->subject[0].name, alpha_of(&r->subject[0]));
    page_section(page, "variance", "Variance against samples", lead);
    fputs("<div class=\"pair\">\n", page->html);
    draw_integral(page->html, &r->integral[0], counts);
    draw_integral(page->html, &r->integral[1], counts);
    fputs("</div>\n", page->html);
    int good = write_data(page, r, counts);
    page_section_end(page);
    return good;
}
