/* vndf_numbers gives the numbers that kernels of `vndf export` read: as many as it says, no more than there is room
 * for, the same each time: a head of 8, and five rows of four for each knot. What they say of the slopes is what the
 * table says: knots ascend, sums fall, and the mass is 1. */
#include <stdlib.h>
#include <string.h>

#include "harness/test.h"
#include "vndf.h"

enum { HEAD = 8, GROUPS = 5 };

static void test_table(const char *path)
{
    vndf_distribution *d = vndf_load(path, NULL);
    size_t count = vndf_numbers(d, NULL, 0), rows = vndf_distribution_info(d).cells + 1;
    float *n = calloc(count + 1, sizeof *n), *part = calloc(count + 1, sizeof *part);
    if (!TEST(d && n && part && count == HEAD + GROUPS * 4 * rows))
        return;
    n[count] = part[count / 2] = 7;
    TEST(vndf_numbers(d, n, count) == count && n[count] == 7);
    TEST(vndf_numbers(d, part, count / 2) == count && part[count / 2] == 7 &&
         memcmp(n, part, count / 2 * sizeof *n) == 0);
    TEST((size_t)n[0] + 1 == rows && n[1] >= 2 && n[1] <= 4 && n[2] >= 0 && n[2] <= 5 && n[3] > 0);
    const float *knot = n + HEAD, *law = knot + 4 * rows, *tail = knot + 3 * 4 * rows;
    TEST(knot[0] == 0 && fabsf(law[3] + tail[1] - 1) < 1e-5f); /* the first cell, and what is beyond */
    for (size_t i = 0; i + 1 < rows; i++)
        for (int j = 0; j < 4; j++)
            if (!TEST(knot[4 * i + 4] > knot[4 * i]) ||
                !TEST(tail[4 * i + 4 + (size_t)j] <= tail[4 * i + (size_t)j]))
                i = rows;
    free(n);
    free(part);
    vndf_free(d);
}

int main(void)
{
    float none = 7;
    TEST(vndf_numbers(NULL, &none, 1) == 0 && vndf_numbers(vndf_ggx(), &none, 1) == 0 &&
         vndf_numbers(vndf_beckmann(), &none, 1) == 0 && none == 7);
    test_table(VNDF_SOURCE_DIR "/tables/student-t-2.5-small.vndf");
    test_table(VNDF_SOURCE_DIR "/tables/hazy.vndf");
    return test_done();
}
