#include "commands/parts/hard.h"

#include <math.h>
#include <stdio.h>

#include "cli/arguments.h"
#include "command.h"
#include "measure/stress.h"
#include "measure/stress_affine.h"

static const char point_form[] = "WIX,WIY,WIZ,AX,AY,U1,U2[,WOX,WOY,WOZ]";

/* Nine digits bring back every float. */
static void print_vector(vndf_vec3 w)
{
    printf("%.9g,%.9g,%.9g", (double)w.x, (double)w.y, (double)w.z);
}

static void print_point(const stress_point *at)
{
    printf("--at ");
    print_vector(at->wi);
    printf(",%.9g,%.9g,%.9g,%.9g", (double)at->alpha_x, (double)at->alpha_y, (double)at->u1, (double)at->u2);
    if (at->wo.x != 0 || at->wo.y != 0 || at->wo.z != 0) {
        putchar(',');
        print_vector(at->wo);
    }
}

static int print_finding(stress_id id, const stress_finding *found)
{
    const stress_property *property = stress_property_of(id);
    int good = found->failed == 0;
    printf("hard         %-9s worst %-9.3g of %-5.3g at %7zu points: %s ", property->name,
           found->worst > 0 ? found->worst : 0, property->limit, found->checked, property->meaning);
    if (!good)
        printf("%zu ", found->failed);
    puts(good ? "good" : "FAILED");
    if (found->worst > 0) {
        printf("             worst ");
        print_point(&found->at);
        putchar('\n');
    }
    return good;
}

static int print_result(const stress_result *result)
{
    int good = 1;
    for (int id = 0; id < STRESS_COUNT; id++)
        if (result->found[id].checked)
            good &= print_finding((stress_id)id, &result->found[id]);
    return good ? STATUS_GOOD : STATUS_NO;
}

/* As words of --lobe, so that sample and eval take the surface. */
static void print_affine_point(const stress_affine_finding *at)
{
    const vndf_affine *m = &at->surface;
    printf("             worst matrix=%.9g,%.9g,%.9g,%.9g mean=%.9g,%.9g wi ", (double)m->xx, (double)m->xy,
           (double)m->yx, (double)m->yy, (double)m->mean_x, (double)m->mean_y);
    print_vector(at->wi);
    printf(" u %.9g,%.9g\n", (double)at->u1, (double)at->u2);
}

static int print_affine_finding(stress_id id, const stress_affine_result *result)
{
    const stress_property *property = stress_property_of(id);
    const stress_affine_finding *found = &result->found[id];
    int good = found->failed == 0;
    printf("hard         affine %-9s worst %-9.3g of %-5.3g at %7zu points: %s ", property->name,
           found->worst > 0 ? found->worst : 0, property->limit, result->samples, property->meaning);
    if (!good)
        printf("%zu ", found->failed);
    puts(good ? "good" : "FAILED");
    if (found->worst > 0)
        print_affine_point(found);
    return good;
}

static int check_affine(const vndf_distribution *distribution, unsigned long long seed)
{
    enum { VIEWS = 40000 };
    stress_affine_result result = {0};
    int good = 1;
    stress_affine_run(distribution, VIEWS, seed, &result);
    printf("hard         affine: %zu samples of %zu surfaces, conditions up to 1e4, mean slopes up to 2\n",
           result.samples, result.views);
    for (int id = 0; id < STRESS_AFFINE_COUNT; id++)
        good &= print_affine_finding((stress_id)id, &result);
    return good ? STATUS_GOOD : STATUS_NO;
}

int hard_check(const vndf_distribution *distribution, unsigned long long seed)
{
    stress_result result = {0};
    stress_run(distribution, 1, seed, &result);
    printf("hard         %zu samples of %zu views", result.samples, result.views);
    if (result.outside)
        printf("; %zu roughnesses left out: alpha times the scale must be within 1e-18 and 1e18", result.outside);
    putchar('\n');
    int plain = print_result(&result), affine = check_affine(distribution, seed);
    return plain == STATUS_GOOD ? affine : plain;
}

static int read_point(const char *command, const char *numbers, stress_point *at)
{
    double n[10] = {0};
    size_t count = parse_numbers(command, "--at", numbers, -1e30, 1e30, 7, 10, n);
    if (count == 0)
        return 0;
    if (count != 7 && count != 10) {
        complain(command, "--at takes %s, 7 or 10 numbers, but '%s' has %zu", point_form, numbers, count);
        return 0;
    }
    at->wi = (vndf_vec3){(float)n[0], (float)n[1], (float)n[2]};
    at->alpha_x = (float)n[3];
    at->alpha_y = (float)n[4];
    at->u1 = (float)n[5];
    at->u2 = (float)n[6];
    at->wo = (vndf_vec3){(float)n[7], (float)n[8], (float)n[9]};
    return 1;
}

static void print_calls(const vndf_surface *surface, const vndf_view *view, const stress_point *at)
{
    float pdf, u1, u2;
    vndf_vec3 wm = vndf_sample(view, at->u1, at->u2, &pdf);
    vndf_invert(view, wm, &u1, &u2);
    printf("at           wm ");
    print_vector(wm);
    printf(" density %.9g pdf %.9g visible %.9g invert %.9g,%.9g\n", (double)pdf, (double)vndf_pdf(view, wm),
           (double)vndf_visible(view, wm), (double)u1, (double)u2);
    printf("at           area %.9g lambda %.9g g1 %.9g\n", (double)vndf_projected_area(surface, at->wi),
           (double)vndf_lambda(surface, at->wi), (double)vndf_g1(surface, at->wi));
}

/* Two directions are a step of what is monotone if the second is farther from z on the same great circle: rounding
 * leaves some 1e-7 of their triple product with z. */
static int is_step(vndf_vec3 wi, vndf_vec3 wo)
{
    double aside = (double)wi.x * (double)wo.y - (double)wi.y * (double)wo.x;
    double along = (double)wi.x * (double)wo.x + (double)wi.y * (double)wo.y;
    return fabs(aside) < 1e-6 * along && wo.z < wi.z;
}

int hard_check_at(const vndf_distribution *distribution, const char *command, const char *numbers)
{
    stress_result result = {0};
    stress_point at;
    if (!read_point(command, numbers, &at))
        return STATUS_USE;
    vndf_surface surface = {distribution, at.alpha_x, at.alpha_y};
    vndf_view view = vndf_view_from(&surface, at.wi);
    if (!view.distribution)
        return complain(command,
                        "--at %s is no view: wi must not be 0, and alpha times the scale of the "
                        "distribution must be within 1e-18 and 1e18",
                        numbers);
    print_calls(&surface, &view, &at);
    stress_measure_sample(&surface, &view, &at, &result);
    stress_measure_direction(&surface, &at, &result);
    if (is_step(at.wi, at.wo))
        stress_measure_step(&surface, &at, &result);
    return print_result(&result);
}
