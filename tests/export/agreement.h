/* Whether answers of an exported kernel agree with the library: questions, and what is measured of the answers. */
#ifndef TESTS_EXPORT_AGREEMENT_H
#define TESTS_EXPORT_AGREEMENT_H

#include <stddef.h>

#include "export/exported_subject.h"

/* Where wi is: above the horizon, down to 130 degrees while it sees 1e-10 of what grazing directions see, or deeper.
 * Apart from them, but for the deep: matrices with mean slopes, and numbers at the edges of the unit square. */
typedef enum agreement_region {
    AGREEMENT_ABOVE,
    AGREEMENT_BELOW,
    AGREEMENT_DEEP,
    AGREEMENT_TURNED,
    AGREEMENT_EDGES,
    AGREEMENT_REGIONS
} agreement_region;

/* Differences; densities are relative and of the normal that the kernel drew. */
typedef enum agreement_id {
    AGREEMENT_SAMPLED,  /* the density that comes with the normal, to vndf_pdf */
    AGREEMENT_REPEATED, /* the same, to the pdf of the kernel */
    AGREEMENT_PDF,
    AGREEMENT_VISIBLE,
    AGREEMENT_NDF,
    AGREEMENT_AREA,
    AGREEMENT_LAMBDA, /* over 1 + |Lambda| */
    AGREEMENT_G1,     /* absolute */
    AGREEMENT_G2,     /* absolute */
    AGREEMENT_NORMAL, /* distance to the library's normal of the same numbers, slopes over the larger roughness */
    AGREEMENT_MIXED,  /* the density of the normal of two lobes, to vndf_mixture_pdf */
    AGREEMENT_MIXED_REPEATED,
    AGREEMENT_MIXED_NORMAL, /* as AGREEMENT_NORMAL; where lobes meet, a rounding draws from the other */
    AGREEMENT_COUNT
} agreement_id;

const char *agreement_name(int id);
const char *agreement_region_name(int region);

typedef struct agreement {
    size_t asked[AGREEMENT_REGIONS];
    size_t refused[AGREEMENT_REGIONS]; /* density 0 or not finite, a normal not unit or turned away, below z = 0 */
    double *difference[AGREEMENT_REGIONS][AGREEMENT_COUNT]; /* ascending after agreement_sort */
    size_t capacity;
} agreement;

/* Question `index` of a sequence about a subject: roughness 0.02 to 1 on both axes; directions of the whole sphere,
 * half of them above the horizon. Of eight questions one is of a matrix that turns, with a mean slope up to 0.5 along x
 * and y, and one of numbers at an edge or next to it, or at a corner. */
exported_question agreement_question(const exported_subjects *subjects, int subject, size_t index);

/* Room for so many answers; 0 if there is no memory. */
int agreement_begin(agreement *a, size_t capacity);
void agreement_note(agreement *a, const exported_subjects *subjects, const exported_question *question,
                    const exported_answer *answer);
void agreement_sort(agreement *a);
void agreement_end(agreement *a);

/* The value that the part `part` of the differences does not exceed. */
double agreement_part(const agreement *a, int region, int id, double part);

/* After agreement_sort: prints every difference, and returns how many are above their limit, `slack` times what the
 * exported C is allowed; a refused answer is one as well. The deep are not judged, but for refused answers. */
size_t agreement_judge(const agreement *a, const char *name, double slack);

#endif
