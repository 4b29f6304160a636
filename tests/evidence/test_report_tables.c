/* What `vndf report` says of a table is right: its total variation, by a lattice of the drawn normals and the
 * source itself, is near the one in the certificate, which the builder measures in another way; above the horizon it
 * falls with the moments, and with four of them with the size (below, the law is what larger tables cannot mend); and
 * the advice is the smallest table that keeps the limits. */
#include "evidence/page/report.h"
#include "harness/test.h"

/* The certificate looks at other angles, so the two may differ by some ten percent. */
static void test_errors(const report_subject *s)
{
    for (size_t i = 0; i < SIZES; i++) {
        const report_table *t = &s->table[i];
        double claimed = (double)t->info.certificate.tv, above = (double)t->info.certificate.tv_above, worst = 0;
        for (size_t a = 0; a < REPORT_ANGLES; a++)
            worst = fmax(worst, t->tv[a]);
        TEST(worst > 0.6 * claimed && worst < 1.4 * claimed);
        TEST(t->worst[REPORT_TV_BELOW] >= claimed && t->worst[REPORT_TV_ABOVE] >= above &&
             t->worst[REPORT_TV_ABOVE] < 1.4 * above);
        TEST(t->worst[REPORT_VARIANCE] >= 100 * 4 * worst * worst * 0.99); /* Cauchy-Schwarz */
        TEST(table_sizes[i].moments == 2 || i == SIZE_FINE ||
             t->worst[REPORT_TV_ABOVE] < s->table[i - 1].worst[REPORT_TV_ABOVE]);
        TEST(i < 3 || i == SIZE_FINE || table_sizes[i].moments < 4 ||
             t->worst[REPORT_TV_ABOVE] < s->table[i - 3].worst[REPORT_TV_ABOVE]);
        TEST(i < 3 || i == SIZE_FINE || t->worst[REPORT_TV_BELOW] < 1.01 * s->table[i - 3].worst[REPORT_TV_BELOW]);
    }
}

static void test_advice(const report_subject *s)
{
    TEST(report_keeps_all(&s->table[s->chosen]));
    for (size_t i = 0; i < s->chosen; i++)
        TEST(!report_keeps_all(&s->table[i]));
    TEST(s->chosen > 0 && s->chosen < SIZE_FINE);
}

int main(void)
{
    static report_subject s;
    vndf_error error = {VNDF_OK, ""};
    progress p = progress_begin("", 0);
    const evidence_plan plan = {.seconds = 3600, .progress = &p};
    vndf_source *source = vndf_source_family("student-t:2.5", &error);
    if (TEST(report_subject_begin(&s, source, "student-t:2.5", &error) == VNDF_OK) &&
        TEST(report_subject_measure(&s, &plan, &error) == VNDF_OK)) {
        test_errors(&s);
        test_advice(&s);
    }
    report_subject_free(&s);
    return test_done();
}
