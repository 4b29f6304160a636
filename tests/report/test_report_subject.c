/* What `vndf report` says of a table is right: its total variation, by a lattice of the drawn normals and the
 * source itself, is near the one in the certificate, which the builder measures in another way; it falls with the
 * size; the noise of estimates falls with the root of the number of samples; and the advice is the smallest table
 * that keeps the limits. */
#include "harness/test.h"

#include "report/report.h"

static int go_on(double done, const char *what, void *user)
{
    (void)done;
    (void)what;
    (void)user;
    return 0;
}

static int stop(double done, const char *what, void *user)
{
    (void)what;
    (void)user;
    return done >= 0;
}

static vndf_status begin(report_subject *s, const char *family, vndf_error *error)
{
    return report_subject_begin(s, vndf_source_family(family, error), family, "--family", error);
}

/* The certificate looks at other angles, so the two may differ by some ten percent. */
static void test_errors(const report_subject *s)
{
    for (size_t i = 0; i < s->count; i++) {
        const report_table *t = &s->table[i];
        double claimed = (double)t->info.certificate.tv, claimed_above = (double)t->info.certificate.tv_above;
        TEST(t->worst.tv > 0.6 * claimed && t->worst.tv < 1.4 * claimed);
        TEST(t->tv_below >= claimed && t->tv_above >= claimed_above && t->tv_above < 1.4 * claimed_above);
        TEST(t->worst.variance >= 4 * t->worst.tv * t->worst.tv * 0.99); /* Cauchy-Schwarz */
        TEST(i == 0 || t->tv_above < s->table[i - 1].tv_above);
        TEST(t->time.view > 0 && t->time.sample > 0 && t->time.pdf > 0 && t->time.batch > 0);
    }
}

/* The table that is advised keeps the limit of the total variation, and the next smaller one breaks one. */
static void test_advice(const report_subject *s)
{
    const report_table *t = &s->table[s->chosen];
    TEST(t->tv_above <= 1e-3 && t->tv_below <= 3e-2 && s->chosen + 1 < s->count);
}

/* The error of a mean of 4096 samples is 1/64 of that of one; a biased one would level off. */
static void test_noise(const report_subject *s)
{
    report_integral integral[2];
    report_variance_measure(s, integral);
    for (int i = 0; i < 2; i++) {
        TEST(integral[i].reference > 0.5 && integral[i].reference < 1 && integral[i].count >= 4);
        for (size_t m = 0; m < integral[i].count; m++) {
            double fall = integral[i].noise[m].error[REPORT_COUNTS - 1] / integral[i].noise[m].error[0];
            TEST(fall > 0.5 / 64 && fall < 1.5 / 64); /* 32 groups: four times a spread of 0.125 */
        }
    }
}

static void test_interrupted(void)
{
    report_subject s;
    vndf_error error = {VNDF_OK, ""};
    const report_watch watch = {stop, NULL};
    TEST(begin(&s, "ggx", &error) == VNDF_OK);
    TEST(report_subject_build(&s, 1, &watch, &error) == VNDF_ERROR_ARGUMENT);
    TEST_HAS(error.message, "interrupted");
    report_subject_free(&s);
}

int main(void)
{
    report_subject s;
    vndf_error error = {VNDF_OK, ""};
    const report_watch watch = {go_on, NULL};
    if (TEST(begin(&s, "student-t:2.5", &error) == VNDF_OK) &&
        TEST(report_subject_build(&s, 3600, &watch, &error) == VNDF_OK) && TEST(s.count >= 3)) {
        test_errors(&s);
        test_advice(&s);
        test_noise(&s);
    }
    report_subject_free(&s);
    test_interrupted();
    return test_done();
}
