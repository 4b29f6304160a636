/* The radial search by windows finds the cell that a search of all knots finds, whatever the weights of the law
 * and the part of its mass: random ones, and those beside the borders of the ranges of u and of |k|/c. */
#include "oracle/oracle.h"
#include "sampler/tabulated/radial.h"
#include "harness/test.h"

/* Whether that cell is found. */
static int is_found(const vndf_distribution *d, float c, float k, float u, float off)
{
    float near = k > 0.0f ? k * (1.0f + 0.006f * (2.0f * off - 1.0f)) : k; /* front.h has no more when it looks */
    uint32_t code = vndf_window_of(d, c, near, u), last = d->radial_count - 1, count = 0, found;
    float total = c * d->f0_total + k * d->f1_total;
    if (k < 0.0f) {
        vndf_radial_law law = vndf_radial_law_above(d, c, k, &total);
        last = law.cut;
        for (uint32_t j = 0; j <= d->radial_count; j += VNDF_WINDOW)
            count += vndf_radial_count_above(&d->knots, j, c, k, u * total);
        found = vndf_radial_find_one(d, code, c, k, u * total, 0);
    } else {
        for (uint32_t j = 0; j <= d->radial_count; j++)
            count += c * d->knots.f0[j] + k * d->knots.f1[j] <= u * total;
        found = vndf_radial_find_one(d, code, c, k, u * total, 1);
    }
    uint32_t cell = count > 0 ? count - 1 : 0;
    return (cell < last ? cell : last) == (found < last ? found : last);
}

/* |k|/c from 1/64 to 64, or a step of float beside a power of sqrt(2), as far as bits tell. */
static float ratio(unsigned long long *state)
{
    float wide = (float)pow(2, 12 * test_uniform_double(state) - 6);
    float border = (float)pow(2, floor(24 * test_uniform_double(state) - 12) / 2);
    return test_uniform(state) < 0.5f ? wide : border * (1 + (test_uniform(state) - 0.5f) * 0.15f);
}

static float part(unsigned long long *state)
{
    float u = test_uniform(state);
    float border = floorf(u * 64) / 64, beside = border + (test_uniform(state) - 0.5f) * 1e-4f;
    return test_uniform(state) < 0.5f ? u : fminf(fmaxf(beside, 0), 1);
}

static void test_table(const vndf_distribution *d, const char *name)
{
    unsigned long long state = 11;
    size_t missed = 0, draws = test_quick() ? 100000 : 1000000;
    for (size_t i = 0; i < draws; i++) {
        float c = 1 / (1 + ratio(&state)), k = test_uniform(&state) < 0.5f ? 1 - c : c - 1, u = part(&state);
        missed += !is_found(d, c, k, u, test_uniform(&state));
    }
    if (!TEST(missed == 0))
        fprintf(stderr, "  %s: %lu of %lu cells not found\n", name, (unsigned long)missed, (unsigned long)draws);
}

int main(void)
{
    static const char *const names[] = {"student-t-2.5-small", "student-t-2.5", "student-t-2.5-large",
                                        "student-t-1.8", "example"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        vndf_distribution *table = oracle_shipped(names[i]);
        if (TEST(table != NULL))
            test_table(table, names[i]);
        vndf_free(table);
    }
    return test_done();
}
