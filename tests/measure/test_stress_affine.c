/* No matrix and no mean slope is too hard: the properties of a sample (tools/measure/stress.h) hold for random surfaces
 * of condition up to 1e4 with mean slopes up to 2, from all incident directions, for closed forms, shipped tables and
 * distributions that are pathological; and what draws beside its density, or is no surface at all, is told. */
#include "harness/test.h"
#include "measure/stress_affine.h"
#include "oracle/oracle.h"

static void test_distribution(const vndf_distribution *d, const char *name)
{
    stress_affine_result result = {0};
    if (!TEST(d != NULL))
        return;
    stress_affine_run(d, test_amount(1000, 4000, 40000), 1, &result);
    TEST(result.samples == 16 * result.views);
    fprintf(stderr, "%-40s %lu samples, density repeated within %.2g\n", name, (unsigned long)result.samples,
            result.found[STRESS_REPEATED].worst);
    for (int id = 0; id < STRESS_AFFINE_COUNT; id++) {
        const stress_affine_finding *found = &result.found[id];
        const vndf_affine *m = &found->surface;
        if (!TEST(found->failed == 0))
            fprintf(stderr,
                    "  %s: %lu fail, worst %g at matrix %.9g,%.9g,%.9g,%.9g mean %.9g,%.9g wi %.9g %.9g %.9g "
                    "u %.9g %.9g\n",
                    stress_property_of((stress_id)id)->name, (unsigned long)found->failed, found->worst,
                    (double)m->xx, (double)m->xy, (double)m->yx, (double)m->yy, (double)m->mean_x,
                    (double)m->mean_y, (double)found->wi.x, (double)found->wi.y, (double)found->wi.z,
                    (double)found->u1, (double)found->u2);
    }
}

static void test_shipped(const char *name)
{
    vndf_distribution *table = oracle_shipped(name);
    test_distribution(table, name);
    vndf_free(table);
}

static void test_built(const char *text)
{
    vndf_distribution *table = oracle_build_of(text, 4096, NULL, NULL);
    test_distribution(table, text);
    vndf_free(table);
}

int main(void)
{
    test_distribution(vndf_ggx(), "ggx");
    test_distribution(vndf_beckmann(), "beckmann");
    test_shipped("student-t-2.5");
    test_shipped("student-t-2.5-small");
    test_built("step(1-r)");
    test_built("r^-1.5*exp(-r)");
    test_built("exp(-1e9*r)");
    return test_done();
}
