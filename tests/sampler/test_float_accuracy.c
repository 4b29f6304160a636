/* In float, the density of a normal, the density and the weight that come with a sample, projected area, Lambda, G1
 * and D are within 1e-5 of what a double-precision oracle makes of the same table and the same numbers, wherever that
 * is above 1e-30: for all shipped tables, smallest ones and pathological ones, at random and at hard points, climbing
 * from the worst of them, and at the worst points that were ever found (tests/corpus/float/worst.csv; the long test
 * prints such lines).
 *
 * True is what oracle_table.h says. Two things are counted and may not be more than one in 10^4: points within
 * two ulps of a jump that have the value of its other side, and points where the density changes by more than
 * 1e-5 between slopes, or cuts, that are 2^-50 apart. */
#include "oracle/oracle.h"
#include "oracle/oracle_float.h"
#include "harness/test.h"

/* clang-format off */
static const char *const subjects[] = {
    "student-t-2.5-small.vndf", "student-t-2.5.vndf", "student-t-2.5-large.vndf", "student-t-1.8.vndf",
    "student-t-6.vndf", "gtr-1.5.vndf", "epd-0.6.vndf", "hazy.vndf", "sgd-alum-bronze-r.vndf", "sgd-nickel-g.vndf",
    "sgd-blue-metallic-paint-b.vndf", "sgd-red-fabric-r.vndf", "sgd-specular-black-phenolic-g.vndf",
    "abc-two-layer-gold.vndf", "example.vndf", "disc.vndf", "exponential.vndf", "ring.vndf", "singular.vndf",
    "tail.vndf", "2048 family ggx", "2048 family beckmann", "2048 family student-t:1.6", "2048 step(1-r)",
    "2048 exp(-r)*step(r-2)", "2048 exp(-((r-1)/0.02)^2)", "2048 r^-1.5*exp(-r)", "2048 r^-1.75*exp(-r)",
    "2048 (1+r*r)^-1.55",
    "2048 exp(-r*r)+1e4*exp(-(100*r)^2)", "2048 exp(-1e9*r)", "2048 exp(-((r-1)/1e-6)^2)"};
/* clang-format on */

enum { SUBJECTS = sizeof subjects / sizeof *subjects };

static const char scratch[] = "float_accuracy.vndf";

static void check(const float_subject *subject, float_quantity quantity, const float_worst *worst)
{
    if (TEST(worst->error <= FLOAT_LIMIT && worst->missed == 0) &
        TEST((double)worst->aside <= 1 + 1e-4 * (double)worst->checked))
        return;
    fprintf(stderr, "  %lu of %lu missed, %lu at jumps; the worst:\n  ", (unsigned long)worst->missed,
            (unsigned long)worst->checked, (unsigned long)worst->aside);
    float_print(subject, quantity, worst);
}

static void test_subject(const char *name, double most[FLOAT_COUNT], size_t *points)
{
    float_subject subject;
    float_worst worst[FLOAT_COUNT] = {0};
    size_t part = test_quick() ? 20 : 1;
    if (!TEST(float_subject_open(&subject, name, scratch)))
        return;
    float_run(worst, &subject, 5000 / part, 4000 / part, 2000 / part, 20240501);
    for (int id = 0; id < FLOAT_COUNT; id++) {
        check(&subject, (float_quantity)id, &worst[id]);
        TEST(worst[id].checked > 0);
        most[id] = fmax(most[id], worst[id].error);
    }
    *points += 9000 / part;
    float_subject_close(&subject);
}

/* Every line again. When a table is made again, what was a hard point of it may become one below 1e-30, which
 * does not count: nine of ten still have to. */
static void test_worst(double *most)
{
    FILE *file = fopen(VNDF_SOURCE_DIR "/tests/corpus/float/worst.csv", "r");
    float_subject subject;
    char line[512], name[64];
    size_t lines = 0, counted = 0;
    memset(&subject, 0, sizeof subject);
    if (!TEST(file != NULL))
        return;
    while (fgets(line, sizeof line, file)) {
        float_worst worst[FLOAT_COUNT] = {0};
        float_quantity quantity;
        float_point at;
        if (line[0] == '#' || !TEST(float_scan(line, name, &quantity, &at)))
            continue;
        if (strcmp(name, subject.name) != 0) {
            float_subject_close(&subject);
            if (!TEST(float_subject_open(&subject, name, scratch)))
                break;
        }
        float_note(worst, &subject, quantity, &at);
        check(&subject, quantity, &worst[quantity]);
        *most = fmax(*most, worst[quantity].error);
        counted += worst[quantity].checked > 0;
        lines++;
    }
    float_subject_close(&subject);
    fclose(file);
    TEST(lines > 20 && counted >= lines - lines / 10);
}

int main(int arguments, char **argument)
{
    double most[FLOAT_COUNT] = {0}, again = 0;
    size_t points = 0;
    for (size_t i = 0; i < SUBJECTS; i++)
        if (oracle_wanted(arguments, argument, i, subjects[i]))
            test_subject(subjects[i], most, &points);
    if (oracle_wanted(arguments, argument, SUBJECTS, "worst"))
        test_worst(&again);
    fprintf(stderr, "%lu points, each for", (unsigned long)points);
    for (int id = 0; id < FLOAT_COUNT; id++)
        fprintf(stderr, " %s within %.2g,", float_quantity_name((float_quantity)id), most[id]);
    fprintf(stderr, " the worst ones kept within %.2g\n", again);
    return test_done();
}
