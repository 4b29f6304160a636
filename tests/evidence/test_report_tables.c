/* The table that `vndf report` advises is the smallest that keeps its limits; where even the finest breaks one, it is
 * within a quarter of the finest there. */
#include "evidence/page/report.h"
#include "harness/test.h"
#include "oracle/oracle.h"

static void test_advice(const char *name, vndf_source *source, int is_good)
{
    subject s;
    size_t at = 0;
    vndf_error error = {VNDF_OK, ""};
    progress p = progress_begin("", 0);
    const evidence_plan plan = {.seconds = 3600, .progress = &p};
    subject_begin(&s, source, name);
    if (TEST(s.source && report_choose(&s, &at, &plan, &error) == VNDF_OK)) {
        const vndf_certificate finest = vndf_distribution_info(s.table[SIZE_FINE]).certificate,
                               chosen = vndf_distribution_info(s.table[at]).certificate;
        TEST(report_keeps(s.table[at]) == is_good);
        for (size_t i = 0; i < at; i++)
            TEST(!report_keeps(s.table[i]));
        TEST(at > 0);
        TEST(chosen.tv <= fmaxf(0.03f, 1.25f * finest.tv) && chosen.tv_above <= 1e-3f && chosen.max_weight <= 2);
    }
    subject_free(&s);
}

int main(void)
{
    test_advice("student-t:2.5", vndf_source_family("student-t:2.5", NULL), 1);
    test_advice("many rings", oracle_source("exp(-r)*(1+0.99*cos(40*r))", NULL), 0);
    return test_done();
}
