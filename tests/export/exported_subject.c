#include "export/exported_subject.h"

#include <stdio.h>
#include <string.h>

int exported_load(exported_subjects *subjects, const char *const *files, int count)
{
    size_t base = 0;
    subjects->count = 0;
    for (int i = 0; i < count && i < EXPORTED_TABLES_MAX; i++) {
        vndf_error error = {VNDF_OK, ""};
        const char *slash = strrchr(files[i], '/');
        subjects->table[i] = vndf_load(files[i], &error);
        if (!subjects->table[i]) {
            fprintf(stderr, "%s: %s\n", files[i], error.message);
            return 0;
        }
        subjects->name[i] = slash ? slash + 1 : files[i];
        subjects->base[i] = (float)base;
        base += vndf_numbers(subjects->table[i], NULL, 0);
        subjects->count++;
    }
    return 1;
}

/* CMake says which, in the order in which it exports them. */
#ifndef EXPORTED_TABLES
#  define EXPORTED_TABLES NULL
#endif

int exported_load_shipped(exported_subjects *subjects)
{
    static const char *const files[] = {EXPORTED_TABLES};
    return exported_load(subjects, files, (int)(sizeof files / sizeof files[0]));
}

void exported_free(exported_subjects *subjects)
{
    for (int i = 0; i < subjects->count; i++)
        vndf_free(subjects->table[i]);
}

const vndf_distribution *exported_subject(const exported_subjects *subjects, int i)
{
    return i == 0 ? vndf_ggx() : i == 1 ? vndf_beckmann() : subjects->table[i - 2];
}

const char *exported_subject_name(const exported_subjects *subjects, int i)
{
    return i == 0 ? "ggx" : i == 1 ? "beckmann" : subjects->name[i - 2];
}

float exported_subject_base(const exported_subjects *subjects, int i)
{
    return i < 2 ? -1.0f - (float)i : subjects->base[i - 2];
}

vndf_affine exported_surface(const exported_subjects *subjects, const exported_question *q)
{
    vndf_affine surface = {NULL, q->xx, q->xy, q->yx, q->yy, q->mean_x, q->mean_y};
    for (int i = 0; i < subjects->count + 2; i++)
        if (exported_subject_base(subjects, i) == q->distribution)
            surface.distribution = exported_subject(subjects, i);
    return surface;
}

exported_question exported_question_of(const exported_subjects *subjects, int i, float alpha_x, float alpha_y,
                                       vndf_vec3 wi)
{
    exported_question q = {.distribution = exported_subject_base(subjects, i), .xx = alpha_x, .yy = alpha_y};
    q.wi[0] = wi.x;
    q.wi[1] = wi.y;
    q.wi[2] = wi.z;
    return q;
}
