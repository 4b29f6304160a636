/* vndf_numbers gives the numbers of an exported kernel: as many as it says, no more than there is room for, the same
 * each time. The counts and places that they begin with lead into them, and what they say of D is what the table
 * says. */
#include <stdlib.h>
#include <string.h>

#include "harness/constants.h"
#include "harness/test.h"
#include "vndf.h"

enum { KNOT = 8, CELL = 7, HEAD = 20 };

/* Sum over the cells of the mass of all normals, 2 pi (mu0 Z0 + mu1 Z1), D cos being 1 in all. */
static double mass_of(const float *n)
{
    size_t cells = (size_t)n[0], knot = (size_t)n[1], cell = (size_t)n[2];
    double sum = 0;
    for (size_t j = 0; j < cells; j++)
        sum += (double)n[cell + CELL * j + 2] * (double)n[knot + KNOT * j + 1] +
               (double)n[cell + CELL * j + 3] * (double)n[knot + KNOT * (j + 1) + 1];
    return 2 * PI * sum;
}

static void test_table(const char *path)
{
    vndf_distribution *d = vndf_load(path, NULL);
    size_t count = vndf_numbers(d, NULL, 0);
    float *n = calloc(count + 1, sizeof *n), *part = calloc(count + 1, sizeof *part);
    if (!TEST(d && n && part && count > HEAD))
        return;
    n[count] = part[count / 2] = 7;
    TEST(vndf_numbers(d, n, count) == count && n[count] == 7);
    TEST(vndf_numbers(d, part, count / 2) == count && part[count / 2] == 7);
    for (size_t i = HEAD; i < count / 2; i++) /* places further on are written when they are reached */
        if (!TEST(part[i] == n[i]))
            break;
    for (size_t i = 0; i < count; i++)
        if (!TEST(isfinite(n[i])))
            break;
    TEST((size_t)n[1] == HEAD && n[2] == n[1] + KNOT * (n[0] + 1));
    for (int wedge = 6; wedge <= 13; wedge += 7) {
        size_t cells = (size_t)n[wedge], q = (size_t)n[wedge + 3], last = (size_t)n[wedge + 6];
        TEST(n[q] == 0 && n[q + cells] == 1 && (size_t)n[wedge + 4] == q + cells + 1);
        TEST(last + 8 * (size_t)n[wedge + 2] == (wedge == 6 ? (size_t)n[13 + 3] : count));
    }
    TEST_NEAR(mass_of(n), 1, 1e-5);
    TEST_NEAR((double)n[3] * 2 * PI, 1, 1e-5);
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
    test_table(VNDF_SOURCE_DIR "/tables/sgd-nickel-g.vndf");
    return test_done();
}
