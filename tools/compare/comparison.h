/* The result of a contest, as a page with pictures and as a table on the terminal. */
#ifndef COMPARE_COMPARISON_H
#define COMPARE_COMPARISON_H

#include "compare/pictures.h"
#include "draw/page.h"

typedef struct comparison {
    contest *contest;
    const char *title, *arguments; /* of the scene; the words of the command */
    float exposure;
    const char *by;           /* what the ways differ in: "normals", "tables" */
    const char *reference_is; /* "2048 samples of visible normals" */
    int reference_read;       /* its noise is not known, and counts as noise of the ways */
    char remarks[1024];       /* of ways that the scene cannot have, of samples that were lost; "" if none */
    crop crops[CROPS];
    agreement agrees[WAYS_MAX];
    int has_common; /* ways saw the same numbers as the first: an error that they share is no noise */
    double common[WAYS_MAX], common_noise[WAYS_MAX];
} comparison;

/* A figure and its standard deviation. */
typedef struct measured {
    double value, spread;
} measured;

/* Error squared times time, of the first way over way i, after equal time: above 1 is better. */
measured efficiency(const contest *c, size_t i, int trimmed);

/* The samples that way i needs for the error that the first has with all its samples. */
measured samples_for_error(const contest *c, size_t i, int trimmed);

/* The tables, to be freed: figures of all ways, their agreement with the reference, and the error that more samples do
 * not reduce. */
text_table comparison_figures(const comparison *r);
text_table comparison_agreement(const comparison *r);
text_table comparison_common(const comparison *r);

/* The tables in Markdown; 0 if there is no memory. */
int comparison_print(FILE *file, const comparison *r);

/* The page and its files; 0 if there is no memory. */
int comparison_page(html_page *page, const comparison *r);

/* Sections of it; 0 if there is no memory. */
int comparison_pictures(html_page *page, const comparison *r);
int comparison_changes(html_page *page, const comparison *r);

#endif
