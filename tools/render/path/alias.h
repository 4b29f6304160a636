/* Draws one of many, each with its own probability, by one memory access: the alias method (Walker,
 * "An Efficient Method for Generating Discrete Random Variables with General Distributions", ACM TOMS 1977). */
#ifndef TOOLS_RENDER_PATH_ALIAS_H
#define TOOLS_RENDER_PATH_ALIAS_H

#include <stddef.h>
#include <stdint.h>

/* A place holds an entry and a part of another entry, which fills it up. */
typedef struct alias_place {
    uint32_t keep, other; /* the first `keep` of 2^32 numbers give the place's own entry */
    float own, others;    /* the two probabilities, or numbers that a caller derives from them */
} alias_place;

/* Makes the table of `count` >= 1 weights >= 0 whose sum is above 0. The caller frees it; NULL if there is no
 * memory. */
alias_place *alias_make(const double *weights, uint32_t count);

/* Draws an entry from 64 random bits, and its `own` number. */
static inline uint32_t alias_draw(const alias_place *table, uint32_t count, uint64_t bits, float *own)
{
    uint32_t at = (uint32_t)((bits >> 32) * count >> 32);
    const alias_place *p = &table[at];
    int stays = (uint32_t)bits < p->keep;
    *own = stays ? p->own : p->others;
    return stays ? at : p->other;
}

#endif
