/* Over 1.5e7 random and 1.5e6 hard points (each normal that faces wi is one of a density: two of three), and
 * climbing from the worst of them, density, drawn density, area, Lambda, G1 and D in float are within 1e-5 of the
 * oracle (test_float_accuracy.c says what of), for every shipped table and those of tests/corpus/table. Prints
 * the worst of each quantity of each table as lines of tests/corpus/float/worst.csv. */
#include <stdlib.h>

#include "oracle/oracle.h"
#include "oracle/oracle_float.h"
#include "harness/test.h"

/* clang-format off */
static const char *const subjects[] = {
    "student-t-2.5-small.vndf", "student-t-2.5.vndf", "student-t-2.5-large.vndf", "student-t-1.8.vndf",
    "student-t-6.vndf", "gtr-1.5.vndf", "epd-0.6.vndf", "hazy.vndf", "sgd-alum-bronze-r.vndf", "sgd-nickel-g.vndf",
    "sgd-blue-metallic-paint-b.vndf", "sgd-red-fabric-r.vndf", "sgd-specular-black-phenolic-g.vndf",
    "abc-two-layer-gold.vndf", "example.vndf", "disc.vndf", "exponential.vndf", "ring.vndf", "singular.vndf",
    "tail.vndf"};
/* clang-format on */

enum {
    SUBJECTS = sizeof subjects / sizeof *subjects,
    RANDOM = 15000000 / SUBJECTS,
    HARD = 1500000 / SUBJECTS,
    CLIMB = 100000
};

int main(int argc, char **argv)
{
    float_worst most[FLOAT_COUNT] = {0};
    size_t part = test_quick() ? 100 : 1;
    unsigned long long seed = argc > 1 ? strtoull(argv[1], NULL, 10) : 1;
    for (int i = 0; i < SUBJECTS; i++) {
        float_subject subject;
        float_worst worst[FLOAT_COUNT] = {0};
        if (!TEST(float_subject_open(&subject, subjects[i], "")))
            continue;
        float_run(worst, &subject, RANDOM / part, HARD / part, CLIMB / part, seed * SUBJECTS + (unsigned)i);
        for (int id = 0; id < FLOAT_COUNT; id++) {
            float_print(&subject, (float_quantity)id, &worst[id]);
            TEST(worst[id].missed == 0 && worst[id].checked > RANDOM / part / 3);
            TEST((double)worst[id].aside <= 1 + 1e-4 * (double)worst[id].checked);
            most[id].checked += worst[id].checked;
            most[id].missed += worst[id].missed;
            most[id].aside += worst[id].aside;
            most[id].error = fmax(most[id].error, worst[id].error);
        }
        fflush(stdout);
        float_subject_close(&subject);
    }
    for (int id = 0; id < FLOAT_COUNT; id++)
        fprintf(stderr, "%-8s %9lu checked, %lu missed, %lu at jumps, worst %.2g\n",
                float_quantity_name((float_quantity)id), (unsigned long)most[id].checked,
                (unsigned long)most[id].missed, (unsigned long)most[id].aside, most[id].error);
    return test_done();
}
