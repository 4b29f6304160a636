/* The distributions that a kernel is asked about: the closed forms, and tables in the order in which they were
 * exported. */
#ifndef TESTS_EXPORT_EXPORTED_SUBJECT_H
#define TESTS_EXPORT_EXPORTED_SUBJECT_H

#include "export/exported.h"
#include "vndf.h"

enum { EXPORTED_TABLES_MAX = 64 };

typedef struct exported_subjects {
    vndf_distribution *table[EXPORTED_TABLES_MAX];
    const char *name[EXPORTED_TABLES_MAX];
    float base[EXPORTED_TABLES_MAX]; /* the first number of each */
    int count;
} exported_subjects;

/* Loads NAME.vndf files; complains and returns 0 if one cannot be loaded. */
int exported_load(exported_subjects *subjects, const char *const *files, int count);

/* The shipped tables, which the kernel of the tests holds. */
int exported_load_shipped(exported_subjects *subjects);
void exported_free(exported_subjects *subjects);

/* Subject i of count + 2: GGX, Beckmann, then the tables. */
const vndf_distribution *exported_subject(const exported_subjects *subjects, int i);
const char *exported_subject_name(const exported_subjects *subjects, int i);
float exported_subject_base(const exported_subjects *subjects, int i);

/* The surface of a question as the library has it, and the question of a surface. */
vndf_affine exported_surface(const exported_subjects *subjects, const exported_question *question);
exported_question exported_question_of(const exported_subjects *subjects, int i, float alpha_x, float alpha_y,
                                       vndf_vec3 wi);

#endif
