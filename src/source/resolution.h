/* How closely the builder looks at a source, in the words of `vndf build`: --break R, --finest W. The provenance
 * of a table ends with these words, so that a later measurement looks as closely as the build did. */
#ifndef VNDF_SOURCE_RESOLUTION_H
#define VNDF_SOURCE_RESOLUTION_H

#include "source/words.h"
#include "vndf_build.h"

typedef struct vndf_resolution {
    const double *breaks; /* slopes, in any order */
    size_t break_count;
    double finest; /* relative width; 0: not given */
} vndf_resolution;

vndf_status vndf_resolution_check(const vndf_resolution *resolution, vndf_error *error);

/* The description of a source, then these words. The caller frees it. NULL and an error if there is no memory. */
char *vndf_resolution_describe(const vndf_resolution *resolution, const char *description, vndf_error *error);

/* How many words of a description are the source's own. */
size_t vndf_resolution_start(const vndf_words *words);

/* The other way round: reads them from the description of a table, the breaks into `room`. */
vndf_status vndf_resolution_read(const char *description, double room[VNDF_LIMIT_BREAKS],
                                 vndf_resolution *resolution, vndf_error *error);

#endif
