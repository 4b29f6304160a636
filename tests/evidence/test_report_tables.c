/* The table that `vndf report` advises is the smallest that keeps its limits; where even the finest breaks one, it is
 * within a quarter of the finest there. */
#include "evidence/page/report.h"
#include "harness/test.h"
#include "oracle/oracle.h"

static void test_advice(const char *name, vndf_source *source, int is_good)
{
    static report_subject s;
    vndf_error error = {VNDF_OK, ""};
    progress p = progress_begin("", 0);
    const evidence_plan plan = {.seconds = 3600, .progress = &p};
    subject_begin(&s.of, source, name);
    if (TEST(s.of.source && report_choose(&s, &plan, &error) == VNDF_OK)) {
        const vndf_certificate finest = vndf_distribution_info(s.of.table[SIZE_FINE]).certificate,
                               chosen = vndf_distribution_info(s.of.table[s.chosen]).certificate;
        TEST(report_keeps(s.of.table[s.chosen]) == is_good);
        for (size_t i = 0; i < s.chosen; i++)
            TEST(!report_keeps(s.of.table[i]));
        TEST(s.chosen > 0);
        TEST(chosen.tv <= fmaxf(0.03f, 1.25f * finest.tv) && chosen.tv_above <= 1e-3f && chosen.max_weight <= 2);
    }
    subject_free(&s.of);
}

int main(void)
{
    test_advice("student-t:2.5", vndf_source_family("student-t:2.5", NULL), 1);
    test_advice("many rings", oracle_source("exp(-r)*(1+0.99*cos(40*r))", NULL), 0);
    return test_done();
}
