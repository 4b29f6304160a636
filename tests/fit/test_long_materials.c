/* All 312 measured fits tabulate in 8 KiB, with a total variation of at most 1e-3 above the horizon; prints the median
 * and the worst of it and of the error of areas. */
#include <stdlib.h>

#include "source/family/family.h"
#include "cli/sort.h"
#include "harness/test.h"
#include "vndf_build.h"

enum { MATERIALS_MAX = 400 };

typedef struct figures {
    double tv[MATERIALS_MAX], area[MATERIALS_MAX];
    size_t count;
} figures;

static void measure(figures *all, const char *name)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_certificate c;
    vndf_source *source = vndf_source_family(name, &error);
    vndf_distribution *table = source ? vndf_build(source, NULL, &c, &error) : NULL;
    if (!TEST(table != NULL))
        fprintf(stderr, "  %s: %s\n", name, error.message);
    else {
        if (!TEST(c.tv_above <= 1e-3f) || !TEST(c.area_error <= 0.03f))
            fprintf(stderr, "  %s: TV %.3g, area error %.3g\n", name, (double)c.tv_above, (double)c.area_error);
        all->tv[all->count] = (double)c.tv_above;
        all->area[all->count++] = (double)c.area_error;
    }
    vndf_free(table);
    vndf_source_free(source);
}

static void print(const char *what, double *value, size_t count)
{
    sort_numbers(value, count);
    if (count)
        printf("%s: median %.3g, worst %.3g of %lu\n", what, value[count / 2], value[count - 1],
               (unsigned long)count);
}

int main(void)
{
    static figures all;
    for (size_t i = 0; vndf_family_material(i) && i < MATERIALS_MAX; i++)
        measure(&all, vndf_family_material(i));
    TEST(all.count == 312);
    print("total variation", all.tv, all.count);
    print("area error", all.area, all.count);
    return test_done();
}
