/* Under 64 Owen-scrambled Sobol points the error of what a table reflects is in the mean at most 1.6 times that
 * of GGX by spherical caps. And the points are what they say: every elementary interval of 64 of them holds one. */
#include "evidence/measure/stratified.h"
#include "sampler/seen.h"

/* All intervals of volume 1/64: 1 x 64, 2 x 32, ... */
static void test_net(uint32_t scramble)
{
    for (int shape = 0; shape <= 6; shape++) {
        int count[64] = {0}, wide = 1 << shape, high = 64 >> shape;
        for (uint32_t i = 0; i < 64; i++) {
            float u1, u2;
            stratified_point(i, scramble, &u1, &u2);
            count[(int)(u1 * (float)wide) * high + (int)(u2 * (float)high)]++;
        }
        for (int i = 0; i < 64; i++)
            TEST(count[i] == 1);
    }
}

static void test_subject(const subject *of, size_t index)
{
    double found = stratified_beside_caps(of->d, 0.3f, test_amount(100, 300, 4000), 5);
    if (!TEST(found <= 1.6) || test_long())
        fprintf(stderr, "  subject %lu, %s: %.2f of caps\n", (unsigned long)index, of->name, found);
}

int main(int arguments, char **argument)
{
    test_net(0);
    test_net(12345);
    return subjects_test(arguments, argument, test_subject);
}
