/* Samples of the exported C follow the library's vndf_pdf: chi-square over 130 x 65 bins, from straight above to 130
 * degrees, isotropic, anisotropic and turned. A short run looks at one view of each of six distributions; a long one
 * is of all views of one:
 *
 *     test_exported_chi_square SUBJECT SAMPLES SUBJECTS
 *
 * SUBJECT is ggx, beckmann or the name of a shipped table's file; the level of 0.01 is for all SUBJECTS together. */
#include "export/exported_bins.h"

#include "cli/random.h"
#include "export/exported_subject.h"
#include "harness/test.h"
#include "measure/statistics.h"

enum { CHUNK = 4096 };

static void draw(exported_bins *bins, const exported_question *view, size_t samples, unsigned long long seed)
{
    static float u[CHUNK][2], drawn[CHUNK][4];
    random_stream stream = random_from(seed);
    for (size_t done = 0; done < samples; done += CHUNK) {
        for (int i = 0; i < CHUNK; i++)
            for (int j = 0; j < 2; j++)
                u[i][j] = random_float(&stream);
        exported_draw(view, (const float(*)[2])u, drawn, CHUNK);
        exported_bins_add(bins, (const float(*)[4])drawn, CHUNK);
    }
}

static void test_view(const exported_subjects *subjects, int subject, int view, size_t samples, double level)
{
    const exported_view *v = &exported_views[view];
    exported_question question =
        exported_question_of(subjects, subject, v->alpha_x, v->alpha_y, exported_view_direction(v));
    exported_bins bins;
    if (!TEST(exported_bins_begin(&bins, exported_subject(subjects, subject), v)))
        return;
    draw(&bins, &question, samples, 7000 + (unsigned long long)(subject * EXPORTED_VIEWS + view));
    TEST(exported_bins_end(&bins, exported_subject_name(subjects, subject), v) > level);
    fflush(stdout);
}

static void test_all_views(const exported_subjects *subjects, const char *name, size_t samples, size_t runs)
{
    int found = 0;
    for (int i = 0; i < subjects->count + 2; i++)
        for (int view = 0; strcmp(exported_subject_name(subjects, i), name) == 0 && view < EXPORTED_VIEWS;
             view++) {
            test_view(subjects, i, view, samples, statistics_sidak(0.01, runs * EXPORTED_VIEWS));
            found++;
        }
    TEST(found == EXPORTED_VIEWS);
}

/* One view each, all views among them. */
static void test_few_views(const exported_subjects *subjects)
{
    size_t samples = test_amount(60000, 300000, 3000000);
    for (int view = 0; view < EXPORTED_VIEWS; view++)
        test_view(subjects, view < 2 ? view : 3 * view + 1, view, samples, statistics_sidak(0.01, EXPORTED_VIEWS));
}

int main(int argc, char **argv)
{
    exported_subjects subjects;
    int loaded = TEST(exported_load_shipped(&subjects));
    if (loaded && argc == 4)
        test_all_views(&subjects, argv[1], strtoul(argv[2], NULL, 10), strtoul(argv[3], NULL, 10));
    else if (loaded)
        test_few_views(&subjects);
    exported_free(&subjects);
    return test_done();
}
