/* A small table serves directions above the horizon first: its total variation there is at most 1e-3 at 2 KiB for a
 * smooth D and 1e-2 for jumps and rings, and a third of that at 4 KiB, by its own certificate. With `sphere` it serves
 * all directions alike and is better below the horizon; a table of 16 KiB or more is the same either way, and so is one
 * that has to reach a total variation of all directions. */
#include <stdio.h>
#include <string.h>

#include "core/checksum.h"
#include "harness/test.h"
#include "oracle/oracle.h"
#include "table/file.h"

/* The first is tried in any test, the first three in a short one. */
static const struct subject {
    const char *name;
    double aim;
} SUBJECTS[] = {
    {"epd:0.6", 1e-3},
    {"exp(-((r-1)/0.1)^2)", 1e-2},
    {"step(1-r)*step(r-0.8)", 1e-2},
    {"epd:0.3", 1e-3},
    {"beckmann", 1e-3},
    {"ggx", 1e-3},
    {"student-t:1.8", 1e-3},
    {"phong:200", 1e-3},
    {"gtr:3", 1e-3},
    {"sgd:nickel/g", 1e-3},
    {"abc:two-layer-gold", 1e-3},
    {"exp(-r)", 1e-3},
    {"exp(-((r-1)/0.03)^2)", 1e-2},
    {"step(1-r)", 1e-2},
    {"exp(-r)*step(2-r)", 1e-2},
};

static vndf_distribution *build(const char *name, size_t max_bytes, double max_tv, int sphere,
                                vndf_certificate *claim)
{
    const vndf_build_options options = {.max_bytes = max_bytes, .max_tv = max_tv, .sphere = sphere};
    vndf_source *source = oracle_source_of(name, NULL);
    vndf_distribution *table = source ? vndf_build(source, &options, claim, NULL) : NULL;
    TEST(table != NULL);
    vndf_source_free(source);
    return table;
}

static void test_aims(const struct subject *s)
{
    for (int i = 0; i < 2; i++) {
        size_t bytes = i ? 4096 : 2048;
        double aim = i ? s->aim / 3 : s->aim;
        vndf_certificate claim = {.tv_above = 1};
        vndf_distribution *table = build(s->name, bytes, 0, 0, &claim);
        TEST(table && vndf_distribution_info(table).bytes <= bytes);
        if (!TEST((double)claim.tv_above <= aim))
            fprintf(stderr, "  %s: %.3g at %g degrees in %lu bytes, %.3g is wanted\n", s->name,
                    (double)claim.tv_above, (double)claim.tv_above_theta, (unsigned long)bytes, aim);
        vndf_free(table);
    }
}

static void test_sphere(const char *name)
{
    vndf_certificate above = {0}, even = {0};
    vndf_free(build(name, 2048, 0, 0, &above));
    vndf_free(build(name, 2048, 0, 1, &even));
    if (!(TEST(above.tv_above < 0.7f * even.tv_above) & TEST(even.tv < 0.7f * above.tv)))
        fprintf(stderr, "  %s: above the horizon %.3g, with sphere %.3g; everywhere %.3g, with sphere %.3g\n",
                name, (double)above.tv_above, (double)even.tv_above, (double)above.tv, (double)even.tv);
}

/* Without the checksum at the end: with it, that of every table is the same. */
static uint32_t checksum_of(const char *name, size_t max_bytes, double max_tv, int sphere)
{
    static unsigned char bytes[1 << 16];
    vndf_distribution *table = build(name, max_bytes, max_tv, sphere, NULL);
    size_t size = table ? vndf_table_encode(table, bytes, sizeof bytes) : 0;
    vndf_free(table);
    return vndf_crc32(0, bytes, size > 4 ? size - 4 : 0);
}

int main(void)
{
    size_t few = (size_t)test_amount(1, 3, sizeof SUBJECTS / sizeof *SUBJECTS);
    for (size_t i = 0; i < few; i++)
        test_aims(&SUBJECTS[i]);
    test_sphere("beckmann");
    TEST(checksum_of("ggx", 16384, 0, 0) == checksum_of("ggx", 16384, 0, 1));
    TEST(checksum_of("ggx", 2048, 0.02, 0) == checksum_of("ggx", 2048, 0.02, 1));
    TEST(checksum_of("ggx", 2048, 0, 0) != checksum_of("ggx", 2048, 0, 1));
    return test_done();
}
