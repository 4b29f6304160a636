/* What scripts ask about kernels that another program runs:
 *
 *     vndf_agreement make COUNT QUESTIONS TABLE...           writes questions, in turn about GGX, Beckmann, each table
 *     vndf_agreement check SLACK QUESTIONS ANSWERS TABLE...  judges answers, SLACK times as strictly as the exported C
 *     vndf_agreement view VIEW TABLE                         prints view 0 to 5 as a question without its numbers
 *     vndf_agreement bins VIEW SAMPLES TABLE                 reads so many normals x y z and densities from stdin:
 *                                                            chi-square, level 0.01 for six views
 *
 * Exit status: 0 good, 1 not, 2 wrong use. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "export/agreement.h"
#include "export/exported_bins.h"
#include "measure/statistics.h"

static int make(const exported_subjects *subjects, size_t count, const char *file)
{
    FILE *to = fopen(file, "wb");
    for (size_t i = 0; to && i < count; i++) {
        int subject = (int)(i % (size_t)(subjects->count + 2));
        exported_question q = agreement_question(subjects, subject, i / (size_t)(subjects->count + 2));
        if (fwrite(&q, sizeof q, 1, to) != 1)
            return 2;
    }
    return to && fclose(to) == 0 ? 0 : 2;
}

static size_t count_of(FILE *file)
{
    exported_question q;
    size_t count = 0;
    while (fread(&q, sizeof q, 1, file) == 1)
        count++;
    rewind(file);
    return count;
}

/* The answers about one subject. */
static size_t check_subject(const exported_subjects *subjects, int subject, double slack, FILE *questions,
                            FILE *answers)
{
    agreement a;
    exported_question question;
    exported_answer answer;
    size_t bad = 1, count = count_of(questions);
    rewind(answers);
    if (!agreement_begin(&a, count))
        return bad;
    for (size_t i = 0; i < count && fread(&question, sizeof question, 1, questions) == 1; i++) {
        if (fread(&answer, sizeof answer, 1, answers) != 1)
            printf("! answers are missing\n");
        else if (question.distribution == exported_subject_base(subjects, subject))
            agreement_note(&a, subjects, &question, &answer);
    }
    agreement_sort(&a);
    bad = agreement_judge(&a, exported_subject_name(subjects, subject), slack);
    bad += a.asked[AGREEMENT_ABOVE] < 100 || a.asked[AGREEMENT_BELOW] < 50;
    agreement_end(&a);
    rewind(questions);
    return bad;
}

static int check(const exported_subjects *subjects, double slack, const char *asked, const char *answered)
{
    FILE *questions = fopen(asked, "rb"), *answers = fopen(answered, "rb");
    size_t bad = 0;
    if (!questions || !answers)
        return 2;
    for (int i = 0; i < subjects->count + 2; i++)
        bad += check_subject(subjects, i, slack, questions, answers);
    fclose(questions);
    fclose(answers);
    return bad > 0;
}

static int print_view(const exported_subjects *subjects, const exported_view *view)
{
    exported_question q = exported_question_of(subjects, subjects->count + 1, view->alpha_x, view->alpha_y,
                                               exported_view_direction(view));
    printf("%.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g\n", (double)q.distribution, (double)q.xx,
           (double)q.xy, (double)q.yx, (double)q.yy, (double)q.mean_x, (double)q.mean_y, (double)q.wi[0],
           (double)q.wi[1], (double)q.wi[2]);
    return 0;
}

static int bins_of_stdin(const exported_subjects *subjects, const exported_view *view, size_t samples)
{
    static float drawn[4096][4];
    int subject = subjects->count + 1;
    exported_bins bins;
    size_t got = 0;
    if (!exported_bins_begin(&bins, exported_subject(subjects, subject), view))
        return 2;
    while ((got = fread(drawn, sizeof drawn[0], 4096, stdin)) > 0)
        exported_bins_add(&bins, (const float(*)[4])drawn, got);
    int whole = bins.samples == samples;
    double p = exported_bins_end(&bins, exported_subject_name(subjects, subject), view);
    return !(whole && p > statistics_sidak(0.01, EXPORTED_VIEWS));
}

static int run(char **argv, const exported_subjects *subjects)
{
    unsigned long view = strtoul(argv[2], NULL, 10);
    if (strcmp(argv[1], "make") == 0)
        return make(subjects, strtoul(argv[2], NULL, 10), argv[3]);
    if (strcmp(argv[1], "check") == 0)
        return check(subjects, strtod(argv[2], NULL), argv[3], argv[4]);
    if (view >= EXPORTED_VIEWS)
        return 2;
    if (strcmp(argv[1], "view") == 0)
        return print_view(subjects, &exported_views[view]);
    return bins_of_stdin(subjects, &exported_views[view], strtoul(argv[3], NULL, 10));
}

int main(int argc, char **argv)
{
    static const struct {
        const char *name;
        int words;
    } commands[] = {{"make", 4}, {"check", 5}, {"view", 3}, {"bins", 4}};
    exported_subjects subjects;
    for (size_t i = 0; i < sizeof commands / sizeof commands[0]; i++)
        if (argc > commands[i].words && strcmp(argv[1], commands[i].name) == 0) {
            int from = commands[i].words;
            if (!exported_load(&subjects, (const char *const *)argv + from, argc - from))
                return 2;
            int status = run(argv, &subjects);
            exported_free(&subjects);
            return status;
        }
    fprintf(stderr, "usage: vndf_agreement make|check|view|bins ...\n");
    return 2;
}
