/* The density that comes with a sample is that of the normal that comes with it, vndf_pdf's, within 1e-5, wherever
 * sampling forms it in float and wherever it has to leave that to double: six million samples of tables and closed
 * forms, most of them beside the borders between the two. Directions are up to the horizon and the normal itself
 * by powers of ten, or such that what lies behind wi is next to nothing; roughnesses from 1e-5 to 1e5; uniform
 * numbers at the ends and the middle of [0, 1] by powers of ten, or such that the normal is at a right angle from
 * wi. Densities below 1e-30 do not count. With a number or a name as its argument it looks at that one. */
#include "oracle/oracle.h"
#include "harness/constants.h"
#include "harness/test.h"

/* Beside 0, by powers of ten down to 1e-least, or anywhere in [0, 1]. */
static double beside(unsigned long long *state, double least)
{
    return test_uniform(state) < 0.5f ? test_uniform_double(state) : pow(10, -least * test_uniform_double(state));
}

/* Half of them such that the stretched direction has a cotangent, where the cut behind wi is, from 1/8 to 8. */
static vndf_vec3 random_direction(const vndf_surface *surface, unsigned long long *state)
{
    double small = beside(state, 8), large = sqrt(1 - small * small), phi = 2 * PI * test_uniform_double(state);
    double scale = vndf_distribution_info(surface->distribution).scale;
    double level = exp2(6 * test_uniform_double(state) - 3);
    double x = cos(phi), y = sin(phi), z = test_uniform(state) < 0.6f ? small / large : large / small;
    if (test_uniform(state) < 0.5f) {
        x /= level * surface->alpha_x * scale;
        y /= level * surface->alpha_y * scale;
        z = 1;
    }
    double length = sqrt(x * x + y * y + z * z);
    vndf_vec3 wi = {(float)(x / length), (float)(y / length), (float)(z / length)};
    return wi;
}

/* Half of them the same along x and y. */
static vndf_surface random_surface(const vndf_distribution *d, unsigned long long *state)
{
    double x = 10 * test_uniform_double(state) - 5;
    double y = test_uniform(state) < 0.5f ? x : 10 * test_uniform_double(state) - 5;
    vndf_surface surface = {d, (float)pow(10, x), (float)pow(10, y)};
    return surface;
}

static float random_number(unsigned long long *state)
{
    double off = beside(state, 7), which = test_uniform_double(state);
    return (float)(which < 0.25 ? off : which < 0.5 ? 1 - off : which < 0.75 ? 0.5 - off / 2 : 0.5 + off / 2);
}

/* Between 1/2 and this u1, the next after it, normals lean towards wi: it is at a right angle from wi. */
static float right_angle(const vndf_view *view, float u2, int upper)
{
    float leaning = 0.5f, away = upper ? 1 : 0;
    for (int i = 0; i < 26; i++) {
        float middle = leaning + (away - leaning) / 2;
        vndf_vec3 wm = vndf_sample(view, middle, u2, NULL);
        if ((double)view->wi.x * wm.x + (double)view->wi.y * wm.y > 0)
            leaning = middle;
        else
            away = middle;
    }
    return away;
}

typedef struct findings {
    double worst;
    unsigned long count;
} findings;

static void try_sample(const vndf_surface *surface, const vndf_view *view, float u1, float u2, findings *found)
{
    float density;
    vndf_vec3 wm = vndf_sample(view, u1, u2, &density), wi = view->wi;
    double error = fabs(vndf_pdf(view, wm) / (double)density - 1);
    if (density >= 0.0f && density < 1e-30f)
        return;
    error = error < HUGE_VAL ? error : HUGE_VAL; /* a NaN would be forgotten */
    found->count++;
    if (error <= found->worst)
        return;
    found->worst = error;
    if (!(error <= 1e-5))
        fprintf(stderr, "  %.3g: alpha %.9g %.9g wi %.9g %.9g %.9g u %.9g %.9g\n", error, (double)surface->alpha_x,
                (double)surface->alpha_y, (double)wi.x, (double)wi.y, (double)wi.z, (double)u1, (double)u2);
}

/* Of a view: every other u1 is beside a right angle. */
static void try_view(const vndf_surface *surface, vndf_vec3 wi, unsigned long long *state, findings *found)
{
    vndf_view view = vndf_view_from(surface, wi);
    float side = right_angle(&view, 0.5f, test_uniform(state) < 0.5f);
    for (int i = 0; i < 16; i++) {
        float u1 = random_number(state), u2 = random_number(state), off = (float)beside(state, 7);
        float beside_side = side + (test_uniform(state) < 0.5f ? -off : off);
        try_sample(surface, &view, i % 2 ? u1 : fminf(fmaxf(beside_side, 0), 1), u2, found);
    }
}

static void test_distribution(const vndf_distribution *d, const char *name)
{
    unsigned long long state = 71;
    findings found = {0, 0};
    for (int i = 0; i < (int)test_amount(2000, 15000, 40000); i++) {
        vndf_surface surface = random_surface(d, &state);
        try_view(&surface, random_direction(&surface, &state), &state, &found);
    }
    fprintf(stderr, "%s: %lu samples, density repeated within %.2g\n", name, found.count, found.worst);
    TEST(found.worst <= 1e-5 && found.count > 10000);
}

/* A slope expression, or a closed form. */
typedef struct subject {
    const char *name;
    size_t bytes;
} subject;

/* clang-format off */
static const subject subjects[] = {
    {"ggx", 0}, {"beckmann", 0}, {"(1+r*r)^-2.5", 16384}, {"(1+r*r)^-1.55", 2048}, {"step(1-r)", 4096},
    {"exp(-r^8)", 4096}, {"exp(-((r-1)/0.1)^2)", 16384}, {"exp(-r)*(1-0.85*step(r-0.8))", 65536},
    {"r^-1.75*exp(-r)", 4096}, {"exp(-1e9*r)", 2048}};
/* clang-format on */

static void test_table(const subject *s)
{
    vndf_distribution *table = oracle_build_of(s->name, s->bytes, NULL, NULL);
    if (TEST(table != NULL))
        test_distribution(table, s->name);
    vndf_free(table);
}

int main(int arguments, char **argument)
{
    for (size_t i = 0; i < sizeof subjects / sizeof *subjects; i++) {
        if (!oracle_wanted(arguments, argument, i, subjects[i].name))
            continue;
        if (subjects[i].bytes > 0)
            test_table(&subjects[i]);
        else
            test_distribution(i == 0 ? vndf_ggx() : vndf_beckmann(), subjects[i].name);
    }
    return test_done();
}
