/* A source as the builder sees it, whatever its kind: an unnormalised P22(r), the slopes where it is not smooth,
 * and the words that made it. Each kind (formula/formula.c, csv.c, source.c)
 * embeds vndf_source as its first member and fills it. */
#ifndef VNDF_SOURCE_SOURCE_H
#define VNDF_SOURCE_SOURCE_H

#include "vndf_build.h"

/* Bounds of p22 for r in [low, high], and `stray`, a bound of what a few points may miss: the integral over log r
 * of |p22 r^2 - some cubic in log r|. Infinite where nothing is known. */
typedef struct vndf_reach {
    double low, high, stray;
} vndf_reach;

enum { VNDF_SOURCE_MANY = 16 };

struct vndf_source {
    /* At up to VNDF_SOURCE_MANY slope lengths r >= 0; any scale; may give NaN or inf. One alone gets the same bits. */
    void (*p22)(const vndf_source *self, const double *r, size_t count, double *p22);
    void (*destroy)(vndf_source *self); /* frees self and all it owns */
    char *description;                  /* arguments of `vndf build`, owned */
    char *notes;                        /* of tables made from it, owned; NULL for none */
    const double *breaks;               /* ascending slopes of rows, or NULL */
    size_t break_count;
    int rebuildable;   /* the description alone makes the same source again */
    double operations; /* what an evaluation costs (vndf_build.h, limits) */
    vndf_reach (*reach)(const vndf_source *self, double low, double high); /* 0 < low < high; NULL: only points */
};

/* Makes the source that has this description, "--slope 'exp(-a*r)' --set a=0.3". It understands --ndf, --slope, --set
 * and --family, and refuses any other (VNDF_ERROR_ARGUMENT): those of a CSV and of a callback do not hold the data. */
vndf_source *vndf_source_from_description(const char *description, vndf_error *error);

#endif
