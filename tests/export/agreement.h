/* What questions about kernels and about BSDFs share. */
#ifndef TESTS_EXPORT_AGREEMENT_H
#define TESTS_EXPORT_AGREEMENT_H

#include "cli/random.h"
#include "export/exported.h"
#include "vndf.h"

enum { SUBJECTS_MAX = 64 };

typedef struct subjects {
    const vndf_distribution *is[SUBJECTS_MAX];
    float base[SUBJECTS_MAX]; /* the first number of each */
    int count;
} subjects;

/* A direction of the whole sphere, one of eight a hard one; a surface that is turned and
 * has a mean slope. */
void put_direction(random_stream *stream, size_t index, float wi[3]);
void turn(random_stream *stream, exported_surface *surface);

/* What 99% and 99.9% of the answers may differ by: of their numbers first to last, absolutely (1), as shares of 1 + the
 * number (2), or relatively (0). */
typedef struct limit {
    const char *name;
    int first, last, is_absolute;
    double most_of, nearly_all;
} limit;

double difference(const limit *l, const float *a, const float *b);
int judge(const limit *l, double *off, size_t count, double slack);

/* Of BSDFs (agreement_bsdf.c): an exit status. */
int make_of_bsdf(const subjects *s, size_t count, const char *file, const char *effects);
int check_of_bsdf(const subjects *s, const char *effects, const char *questions, const char *answers);

#endif
