/* The exported C answers as the library does, over roughness 0.02 to 1, the whole sphere of directions, matrices with
 * mean slopes and the corners of the unit square, for every shipped table, GGX and Beckmann in one file: densities,
 * visible normals, D, areas, Lambda, G1, G2, normals and mixtures of two lobes, each within the limits of agreement.c;
 * no sample is without a density, of another length, below the surface or turned away. */
#include "export/agreement.h"
#include "harness/test.h"

static void test_subject(const exported_subjects *subjects, int subject, size_t count)
{
    agreement a;
    if (!TEST(agreement_begin(&a, count)))
        return;
    for (size_t i = 0; i < count; i++) {
        exported_question question = agreement_question(subjects, subject, i);
        exported_answer answer;
        exported_answer_to(&question, &answer);
        agreement_note(&a, subjects, &question, &answer);
    }
    agreement_sort(&a);
    TEST(a.asked[AGREEMENT_ABOVE] > count / 4 && a.asked[AGREEMENT_BELOW] > count / 128);
    TEST(a.asked[AGREEMENT_TURNED] > count / 32 && a.asked[AGREEMENT_EDGES] > count / 64);
    TEST(agreement_judge(&a, exported_subject_name(subjects, subject), 1) == 0);
    agreement_end(&a);
}

int main(void)
{
    exported_subjects subjects;
    if (TEST(exported_load_shipped(&subjects)))
        for (int i = 0; i < subjects.count + 2; i++)
            test_subject(&subjects, i, test_amount(2000, 16000, 100000));
    TEST(subjects.count >= 15);
    exported_free(&subjects);
    return test_done();
}
